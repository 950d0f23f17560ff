-- The headers that codels in C include: types, events, exceptions, ports, and the signatures of the codels.

for _, component in ipairs(model.components) do
  file("c_types.h.in", component.name .. "_c_types.h", {component = component})
  file("accomponent.h.in", "ac" .. component.name .. ".h", {component = component})
  file("genom3_c.h.in", "genom3_c.h", {})
end
