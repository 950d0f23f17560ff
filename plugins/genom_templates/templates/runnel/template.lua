-- A plugin of Runnel with each component as a module type, `courier/courier`; what its codels include, too.
-- `-s prefix=runnel/`: where Runnel's own headers are found.

local prefix = has(options, "prefix") and options.prefix or ""
library("views").masquerades_as = "runnel"
for _, component in ipairs(model.components) do
  library("component_files")(component, prefix, {{"module.cpp.in", "_module.cpp"}, {"types.h.in", "_types.h"}})
end
