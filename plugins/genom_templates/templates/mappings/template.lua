-- The headers that codels include: types, events, exceptions, ports, and the signatures of the codels; in C, or in C++ for
-- components whose language that is.

for _, component in ipairs(model.components) do library("codel_headers")(component) end
