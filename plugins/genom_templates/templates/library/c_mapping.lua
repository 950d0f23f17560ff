-- How types, states and codels look in C, as codels of the original see them.

local mapping = {}

local types = {}
for _, type in ipairs(model.types) do types[type.name] = type end

-- A constant that is no text. Numbers of Lua are signed: those from 2^63 on are written as what they stand for,
-- with the suffix that C wants.
function mapping.number(type, value, suffix)
  if mapping.final(type).kind ~= "unsigned long long" or math.type(value) ~= "integer" or value >= 0 then
    return tostring(value)
  end
  local tens = (value >> 1) // 5
  return tens .. (value - tens * 10) .. (suffix or "")
end

-- "nav::pose" is nav_pose.
function mapping.name(name) return (name:gsub("::", "_")) end

-- What a type is behind its other names.
function mapping.final(type)
  while has(type, "name") do
    local declared = types[type.name]
    if not declared or declared.kind ~= "typedef" then break end
    type = declared.type
  end
  return type
end

local basic = {
  boolean = "bool", octet = "uint8_t", char = "char", short = "int16_t", ["unsigned short"] = "uint16_t",
  long = "int32_t", ["unsigned long"] = "uint32_t", ["long long"] = "int64_t", ["unsigned long long"] = "uint64_t",
  float = "float", double = "double",
}

-- The name of a type, what lies in an exception being its detail; of one without a name, one that is made from what it is
-- made of, in the words of IDL.
function mapping.type(type)
  if has(type, "name") then
    local declared = types[type.name]
    return mapping.name(type.name) .. (declared and declared.kind == "exception" and "_detail" or "")
  end
  if basic[type.kind] then return basic[type.kind] end
  if type.kind == "string" then return has(type, "length") and "char" or "char *" end
  if type.kind == "array" then return mapping.type(type.type) end
  local of = mapping.type(type.type)
  if not has(type.type, "name") and basic[type.type.kind] then of = type.type.kind:gsub(" ", "_") end
  if not has(type.type, "name") and type.type.kind == "string" then
    of = "string" .. (has(type.type, "length") and tostring(type.type.length) or "")
  end
  return type.kind .. (has(type, "length") and tostring(type.length) or "") .. "_" .. of
end

-- A variable, member or alias of the type.
function mapping.variable(type, name)
  local sizes = ""
  while not has(type, "name") and type.kind == "array" do
    sizes = sizes .. "[" .. type.length .. "]"
    type = type.type
  end
  if not has(type, "name") and type.kind == "string" then
    if has(type, "length") then return "char " .. name .. sizes .. "[" .. type.length .. "]" end
    return "char *" .. name .. sizes
  end
  return mapping.type(type) .. " " .. (mapping.final(type).kind == "native type" and "*" or "") .. name .. sizes
end

-- What "nav::pose" is called, its name as an exception, and what lies in that.
mapping.named = mapping.name
function mapping.exception(name) return mapping.name(name) .. "_id" end
function mapping.detail(name) return mapping.name(name) .. "_detail" end
function mapping.header(component) return component .. "_c_types.h" end
mapping.context = "genom_context"

local function is_scalar(kind) return basic[kind] ~= nil or kind == "enum" end

-- "[2][3]".
local function sizes(type)
  local text = ""
  while type.kind == "array" do
    text = text .. "[" .. type.length .. "]"
    type = mapping.final(type.type)
  end
  return text
end

-- A parameter of a codel, as its signature declares it.
function mapping.parameter(component, parameter)
  if has(parameter, "port") then return "const " .. component .. "_" .. parameter.port .. " *" .. parameter.name end
  if has(parameter, "remote") then return "const " .. component .. "_" .. parameter.remote .. " *" .. parameter.name end
  local final = mapping.final(parameter.type)
  local name = mapping.type(parameter.type)
  local is_input = parameter.direction == "in"
  local const = is_input and "const " or ""
  if final.kind == "array" then
    -- By the name of its elements, so that sizes can be seen.
    local element = final
    while element.kind == "array" do element = mapping.final(element.type) end
    return const .. mapping.type(element) .. " " .. parameter.name .. sizes(final)
  end
  if final.kind == "string" and has(final, "length") then
    return const .. "char " .. parameter.name .. "[" .. final.length .. "]"
  end
  if final.kind == "string" then return is_input and "const char *" .. parameter.name or "char **" .. parameter.name end
  if final.kind == "native type" then return const .. name .. (is_input and " *" or " **") .. parameter.name end
  if is_input and is_scalar(final.kind) then return name .. " " .. parameter.name end
  return const .. name .. " *" .. parameter.name
end

-- What a codel is given for a parameter, for which an expression stands.
function mapping.argument(expression, parameter)
  local final = mapping.final(parameter.type)
  local is_text = final.kind == "string"
  if final.kind == "array" or is_text and has(final, "length") then return expression end
  if parameter.direction == "in" and (is_scalar(final.kind) or is_text or final.kind == "native type") then return expression end
  return "&" .. expression
end

-- What a parameter of a remote stands for; arrays lose their type on the way, which value_NAME is.
function mapping.referred(parameter)
  local final = mapping.final(parameter.type)
  local const = parameter.direction == "in" and "const " or ""
  local is_text = final.kind == "string"
  if final.kind == "array" or is_text and has(final, "length") then
    return "*reinterpret_cast<" .. const .. "value_" .. parameter.name .. "*>(" .. parameter.name .. ")"
  end
  if parameter.direction == "in" and (is_scalar(final.kind) or is_text) then return parameter.name end
  return "*" .. parameter.name
end

-- The signature of a codel, in lines that are not too long.
function mapping.signature(component, codel)
  local parts = {}
  for _, parameter in ipairs(codel.parameters) do parts[#parts + 1] = mapping.parameter(component, parameter) end
  parts[#parts + 1] = "const genom_context self"
  local lines, line = {}, codel.name .. "("
  local indent = string.rep(" ", #line)
  for index, part in ipairs(parts) do
    local piece = part .. (index < #parts and ", " or ")")
    if #line + #piece > 79 and line ~= indent then
      lines[#lines + 1] = (line:gsub("%s+$", ""))
      line = indent
    end
    line = line .. piece
  end
  lines[#lines + 1] = line
  return "genom_event\n" .. table.concat(lines, "\n")
end

-- What a codel returns for an event of its yield list.
function mapping.event(component, event)
  local paused = event:match("^pause::(.*)")
  if paused then return component .. "_pause_" .. paused end
  return component .. "_" .. event
end

-- The value of a constant as C and C++ write it. Backslashes of texts stay: the description has them as C does.
function mapping.constant(type, value)
  if value == true or value == false then return tostring(value) end
  if math.type(value) then return mapping.number(type, value, "ull") end
  if mapping.final(type).kind == "char" then return string.format("%d", (string.unpack("b", value .. "\0"))) end
  return '"' .. value:gsub('"', '\\"'):gsub("\n", "\\n") .. '"'
end

return mapping
