-- The headers that the codels of a component include.

return function(component)
  file("../mappings/accomponent.h.in", "ac" .. component.name .. ".h", {component = component})
  if component.lang == "c++" then
    library("words_of_cxx")(component)
    file("../mappings/cxx_types.h.in", component.name .. "_cxx_types.h", {component = component})
    file("../mappings/genom3_cxx.h.in", "genom3_cxx.h", {})
  else
    file("../mappings/c_types.h.in", component.name .. "_c_types.h", {component = component})
    file("../mappings/genom3_c.h.in", "genom3_c.h", {})
  end
end
