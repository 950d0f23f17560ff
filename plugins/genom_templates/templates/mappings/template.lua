-- The headers that codels include: types, events, exceptions, ports, and the signatures of the codels; in C, or in C++ for
-- components whose language that is.

for _, component in ipairs(model.components) do
  file("accomponent.h.in", "ac" .. component.name .. ".h", {component = component})
  if component.lang == "c++" then
    file("cxx_types.h.in", component.name .. "_cxx_types.h", {component = component})
    file("genom3_cxx.h.in", "genom3_cxx.h", {})
  else
    file("c_types.h.in", component.name .. "_c_types.h", {component = component})
    file("genom3_c.h.in", "genom3_c.h", {})
  end
end
