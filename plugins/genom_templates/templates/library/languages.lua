-- How types, events and parameters look to the codels of a component, in the language that they are in.

return function(component)
  if component.lang == "c" then return library("c_mapping") end
  if component.lang == "c++" then return library("cxx_mapping") end
  fail("the codels of '" .. component.name .. "' are in '" .. component.lang .. "', of which this template knows nothing; c and c++ it knows")
end
