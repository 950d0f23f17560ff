-- The defaults of parameters, in Runnel's text format and as JSON; nil where the description says none.

local c = library("c_mapping")
local execution = library("execution")
local defaults = {}

local numbers = {
  octet = true, short = true, ["unsigned short"] = true, long = true, ["unsigned long"] = true, ["long long"] = true,
  ["unsigned long long"] = true, float = true, double = true, char = true,
}

local bits = {octet = 8, char = 8, short = 16, ["unsigned short"] = 16, long = 32, ["unsigned long"] = 32}

-- What is out of range, of which `runnel check` warns, is as C makes it.
local function fitting(kind, number)
  if not bits[kind] then return number end
  local range = 1 << bits[kind]
  local low = math.tointeger(number) % range
  local is_signed = kind == "short" or kind == "long" or kind == "char"
  return is_signed and low >= range // 2 and low - range or low
end

-- What is as in the beginning.
local function zero(type, is_json)
  local final = execution.declared(type)
  if numbers[final.kind] then return "0" end
  if final.kind == "boolean" then return "false" end
  if final.kind == "string" then return '""' end
  if final.kind == "enum" then return '"' .. final.enumerators[1]:match("([%w_]+)$") .. '"' end
  if final.kind == "optional" then return is_json and "null" or "[]" end
  if final.kind == "array" then
    return "[" .. string.rep(zero(final.type, is_json), math.floor(final.length), ", ") .. "]"
  end
  return final.kind == "sequence" and "[]" or "{}"
end

local value

local function members(final, parts, is_json)
  if final.kind == "union" and not is_json then return nil end  -- nobody can look inside
  local texts = {}
  for _, part in ipairs(parts) do
    for _, member in ipairs(final.members) do
      local text = has(part, "member") and part.member == member.name and value(member.type, part, is_json)
      if text then texts[#texts + 1] = (is_json and '"' .. member.name .. '": ' or member.name .. ": ") .. text end
    end
  end
  return #texts > 0 and "{" .. table.concat(texts, ", ") .. "}" or nil
end

local function elements(final, parts, is_json)
  local texts, next_index, is_any = {}, 0, false
  for _, part in ipairs(parts) do
    local at = has(part, "index") and math.floor(part.index) or next_index
    while #texts < at do texts[#texts + 1] = zero(final.type, is_json) end
    local text = value(final.type, part, is_json)
    is_any = is_any or text ~= nil
    texts[at + 1] = text or zero(final.type, is_json)
    next_index = at + 1
  end
  if not is_any then return nil end
  while final.kind == "array" and #texts < final.length do texts[#texts + 1] = zero(final.type, is_json) end
  return "[" .. table.concat(texts, ", ") .. "]"
end

function value(type, initial, is_json)
  local final = execution.declared(type)
  if final.kind == "optional" then
    local inner = value(final.type, initial, is_json)
    return inner and (is_json and inner or "[" .. inner .. "]")
  end
  if has(initial, "parts") then
    if final.kind == "array" or final.kind == "sequence" then return elements(final, initial.parts, is_json) end
    return has(final, "members") and members(final, initial.parts, is_json) or nil
  end
  if not has(initial, "value") then return nil end
  local constant = initial.value
  if math.type(constant) == "float" then return string.format("%.17g", constant) end
  if math.type(constant) then constant = fitting(final.kind, constant) end
  if math.type(constant) or constant == true or constant == false then return c.number(final, constant) end
  if final.kind == "char" then return tostring(constant:byte() or 0) end
  if final.kind == "string" and has(final, "length") and #constant > final.length then
    local length = math.floor(final.length)
    while length > 0 and constant:byte(length + 1) & 0xC0 == 0x80 do length = length - 1 end  -- whole characters of UTF-8
    constant = constant:sub(1, length)
  end
  if final.kind == "enum" then constant = constant:match("([%w_]+)$") end
  constant = constant:gsub('[\\"]', "\\%0")
  if is_json then constant = constant:gsub("%c", function(each) return string.format("\\u%04x", each:byte()) end) end
  return '"' .. constant .. '"'
end

function defaults.text(parameter) return has(parameter, "default") and value(parameter.type, parameter.default, false) or nil end
function defaults.json(parameter) return has(parameter, "default") and value(parameter.type, parameter.default, true) or nil end

return defaults
