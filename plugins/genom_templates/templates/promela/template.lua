-- A model of each component for Spin: what can happen between its threads, whatever its codels decide.
--   -s slots=N         how many activities of a task there are at once (2)
--   -s exclusion=none  without mutual exclusion, to see what it is for

for _, component in ipairs(model.components) do
  local slots = has(options, "slots") and math.tointeger(tonumber(options.slots)) or 2
  if not slots or slots < 1 or slots > 8 then fail("slots is a whole number from 1 to 8") end
  local excludes = not has(options, "exclusion") or options.exclusion
  if excludes ~= true and excludes ~= "none" then fail("exclusion is 'none', or nothing is said of it") end
  local parts = library("component_parts")(component, slots, excludes == true)
  file("component.pml.in", component.name .. ".pml", {component = component, parts = parts})
end
