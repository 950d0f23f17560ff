-- Sequences with a bound know it in `_maximum`, which codels look at: statements in C++ that say it.

local c = library("c_mapping")
local execution = library("execution")
local bounds = {}

local function has_any(type, seen)
  local final = execution.declared(type)
  if final.kind == "sequence" and has(final, "length") then return true end
  if final.kind == "array" or final.kind == "optional" then return has_any(final.type, seen) end
  if final.kind ~= "struct" or seen[final.name] then return false end
  seen[final.name] = true
  for _, member in ipairs(final.members) do
    if has_any(member.type, seen) then return true end
  end
  return false
end

-- For a value of the type, which an expression is; "" if there is nothing to say.
function bounds.statements(type, expression, indent, depth)
  depth = depth or 0
  if not has_any(type, {}) then return "" end
  local final = execution.declared(type)
  if final.kind == "struct" then
    local text = ""
    for _, member in ipairs(final.members) do
      text = text .. bounds.statements(member.type, expression .. "." .. member.name, indent, depth)
    end
    return text
  elseif final.kind == "optional" then
    return bounds.statements(final.type, expression .. "._value", indent, depth)
  end
  local elements = expression
  local text = ""
  if final.kind == "sequence" then
    text = indent .. expression .. "._maximum = " .. final.length .. ";\n"
    elements = expression .. "._buffer"
  end
  local element = "element" .. depth
  local within = bounds.statements(final.type, element, indent .. "  ", depth + 1)
  if within == "" then return text end
  return text .. indent .. "for (auto& " .. element .. " : " .. elements .. ") {\n" .. within .. indent .. "}\n"
end

return bounds
