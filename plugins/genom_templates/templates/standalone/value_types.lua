-- Types as tables of genom_standalone::ValueType, which say how values lie in memory.

local c = library("c_mapping")
local execution = library("execution")
local values = {declarations = {}, definitions = {}, count = 0}
-- values.language is that of the codels.

local declared = {}
for _, type in ipairs(model.types) do declared[type.name] = type end

local kinds = {
  boolean = "kBoolean", octet = "kOctet", char = "kCharacter", short = "kShort", ["unsigned short"] = "kUnsignedShort",
  long = "kLong", ["unsigned long"] = "kUnsignedLong", ["long long"] = "kLongLong",
  ["unsigned long long"] = "kUnsignedLongLong", float = "kFloat", double = "kDouble",
}
local names = {}

local function key(type)
  if has(type, "name") then return type.name end
  return type.kind .. (has(type, "length") and "<" .. type.length .. ">" or "") .. (has(type, "type") and key(type.type) or "")
end

-- What _d is for a label.
local function label_number(switch, label)
  if switch.kind == "enum" then
    for index, each in ipairs(declared[switch.name].enumerators) do
      if each == label or each:match("([%w_]+)$") == label then return index - 1 end
    end
  end
  if label == true then return 1 elseif label == false then return 0 end
  if math.type(label) then return math.floor(label) end
  return tostring(label):byte()
end

local function array(type, name, list)
  if #list == 0 then return "{}" end
  values.definitions[#values.definitions + 1] = "const " .. type .. " " .. name .. "[] = {" .. table.concat(list, ", ") .. "};"
  return name
end

local function members_of(list, struct, number, switch)
  local taken, rows = {}, {}
  for _, member in ipairs(list) do
    for _, label in ipairs(switch and member.labels or {}) do taken[label_number(switch, label)] = true end
  end
  for index, member in ipairs(list) do
    local offset = string.format("offsetof(%s, %s%s)", struct, switch and "_u." or "", member.name)
    local row = string.format('{"%s", %s, &%s', member.name, offset, values.type(member.type))
    if switch then
      local labels, first = {}, 0
      for _, label in ipairs(member.labels) do labels[#labels + 1] = tostring(label_number(switch, label)) end
      if member.is_default then
        while taken[first] do first = first + 1 end
        labels = {}
      else
        first = labels[1]
      end
      row = row .. ", " .. array("std::int64_t", "kLabels" .. number .. "_" .. index, labels) .. ", " .. first
    end
    rows[#rows + 1] = row .. "}"
  end
  return array("ValueMember", "kMembers" .. number, rows)
end

local function define(type, final, number)
  local language = values.language
  local in_memory = "InMemory" .. number  -- without commas, which macros dislike
  local declaration = final.kind == "exception" and language.detail(final.name) .. " " .. in_memory or language.variable(type, in_memory)
  values.declarations[#values.declarations + 1] = "typedef " .. declaration .. ";"
  local size = "sizeof(" .. in_memory .. ")"
  local kind = kinds[final.kind]
  if kind then return string.format("{.kind = ValueKind::%s, .size = %s}", kind, size) end
  if final.kind == "enum" then
    local list = {}
    for _, each in ipairs(declared[final.name].enumerators) do list[#list + 1] = '"' .. each:match("([%w_]+)$") .. '"' end
    return string.format("{.kind = ValueKind::kEnum, .size = %s, .names = %s}", size, array("char* const", "kNames" .. number, list))
  elseif final.kind == "string" then
    if has(final, "length") then return string.format("{.kind = ValueKind::kText, .size = %d, .length = %d}", final.length, final.length) end
    return "{.kind = ValueKind::" .. (language == c and "kOwnedText" or "kString") .. ", .size = " .. size .. "}"
  elseif final.kind == "array" then
    local element = values.type(final.type)
    return string.format("{.kind = ValueKind::kArray, .size = %s, .length = %d, .element = &%s}", size, final.length, element)
  elseif final.kind == "sequence" then
    local element = values.type(final.type)
    local length = has(final, "length") and final.length or nil
    if language ~= c then
      return string.format("{.kind = ValueKind::kList, .size = %s, .length = %d, .element = &%s, .list = &kListOperations<%s>}",
                           size, length or 0, element, in_memory)
    end
    if not length then
      return string.format("{.kind = ValueKind::kOwnedSequence, .size = %s, .element = &%s}", size, element)
    end
    return string.format("{.kind = ValueKind::kSequence, .size = %s, .length = %d, .element = &%s, .element_offset = offsetof(%s, _buffer)}",
                         size, length, element, in_memory)
  elseif final.kind == "optional" then
    return string.format("{.kind = ValueKind::kOptional, .size = %s, .element = &%s, .element_offset = offsetof(%s, _value)}",
                         size, values.type(final.type), in_memory)
  elseif final.kind == "struct" or final.kind == "exception" then
    return string.format("{.kind = ValueKind::kStruct, .size = %s, .members = %s}", size,
                         members_of(declared[final.name].members, in_memory, number))
  elseif final.kind == "union" then
    local declaration = declared[final.name]
    local switch = c.final(declaration.switch)
    return string.format("{.kind = ValueKind::kUnion, .size = %s, .element = &%s, .element_offset = offsetof(%s, _u), .members = %s}",
                         size, values.type(declaration.switch), in_memory, members_of(declaration.members, in_memory, number, switch))
  end
  return "{.kind = ValueKind::kNative, .size = sizeof(void*)}"
end

-- The name of the type's table, which is made if it is not there.
function values.type(type)
  local final = c.final(type)
  local found = names[key(final)]
  if found then return found end
  values.count = values.count + 1
  local number = values.count
  local name = "kType" .. number
  names[key(final)] = name
  values.declarations[#values.declarations + 1] = "extern const ValueType " .. name .. ";"
  local text = define(type, final, number)
  values.definitions[#values.definitions + 1] = "const ValueType " .. name .. " = " .. text .. ";"
  return name
end

function values.default(parameter) return execution.literal(library("defaults").json(parameter) or "") end

return values
