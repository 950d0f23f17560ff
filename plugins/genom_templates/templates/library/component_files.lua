-- What a component that runs on plugins/genom_execution is made of, whoever drives it: the template's own files, {TEXT, what
-- stands behind the component's name}, what the engine knows of the component, and what its codels include. `prefix` is where
-- Runnel's own headers are found.

return function(component, prefix, own)
  library("words_of_cxx")(component)
  local variables = {component = component, prefix = prefix, language = library("languages")(component)}
  for _, each in ipairs(own) do file(each[1], component.name .. each[2], variables) end
  file("views.h.in", component.name .. "_views.h", variables)
  file("execution_tables.h.in", component.name .. "_tables.h", variables)
  file("execution_tables.cpp.in", component.name .. "_tables.cpp", variables)
  library("codel_headers")(component)
end
