-- Each component as a process of its own, without modules, ports and files of Runnel: what plugins/genom_standalone needs,
-- and what the codels include.
-- `-s prefix=runnel/`: where Runnel's own headers are found.

local prefix = has(options, "prefix") and options.prefix or ""
library("views").masquerades_as = false
for _, component in ipairs(model.components) do
  library("component_files")(component, prefix, {{"standalone.cpp.in", "_standalone.cpp"}})
end
