-- Each component as a process of its own, without modules, ports and files of Runnel: what plugins/genom_standalone needs,
-- and what the codels include.
-- `-s prefix=runnel/`: where Runnel's own headers are found.

local prefix = has(options, "prefix") and options.prefix or ""
for _, component in ipairs(model.components) do
  local variables = {component = component, prefix = prefix}
  local name = component.name
  if component.lang ~= "c" then
    fail("the codels of '" .. name .. "' are in '" .. component.lang .. "', of which this template knows nothing")
  end
  file("standalone.cpp.in", name .. "_standalone.cpp", variables)
  file("execution_tables.h.in", name .. "_tables.h", variables)
  file("execution_tables.cpp.in", name .. "_tables.cpp", variables)
  file("../mappings/c_types.h.in", name .. "_c_types.h", {component = component})
  file("../mappings/accomponent.h.in", "ac" .. name .. ".h", {component = component})
  file("../mappings/genom3_c.h.in", "genom3_c.h", {})
end
