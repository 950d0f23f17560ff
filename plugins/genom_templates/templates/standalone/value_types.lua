-- Types as tables of genom_standalone::ValueType, which say how values lie in memory.

local c = library("c_mapping")
local execution = library("execution")
local views = library("views")
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

local function array(type, name, list)
  if #list == 0 then return "{}" end
  values.definitions[#values.definitions + 1] = "const " .. type .. " " .. name .. "[] = {" .. table.concat(list, ", ") .. "};"
  return name
end

local function members_of(list, struct, number, switch)
  local taken, rows = {}, {}
  for _, member in ipairs(list) do
    for _, label in ipairs(switch and member.labels or {}) do taken[execution.label_number(switch, label)] = true end
  end
  for index, member in ipairs(list) do
    local offset = string.format("offsetof(%s, %s%s)", struct, switch and "_u." or "", member.name)
    local row = string.format('{"%s", %s, &%s', member.name, offset, values.type(member.type))
    if switch then
      local labels, first = {}, 0
      for _, label in ipairs(member.labels) do labels[#labels + 1] = tostring(execution.label_number(switch, label)) end
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
  -- What C++ makes, copies and destroys: of codels in C, their views.
  local held = (language == c and final.kind ~= "exception") and views.view(final) or in_memory
  local function entry(kind, more) return "{.kind = ValueKind::" .. kind .. ", .memory = kMemory<" .. held .. ">" .. (more or "") .. "}" end
  if kinds[final.kind] then return entry(kinds[final.kind]) end
  if final.kind == "enum" then
    local list = {}
    for _, each in ipairs(declared[final.name].enumerators) do list[#list + 1] = '"' .. each:match("([%w_]+)$") .. '"' end
    return entry("kEnum", ", .names = " .. array("char* const", "kNames" .. number, list))
  elseif final.kind == "string" then
    if has(final, "length") then return entry("kText", string.format(", .length = %d", final.length)) end
    return entry(language == c and "kOwnedText" or "kString")
  elseif final.kind == "array" or final.kind == "sequence" then
    return entry("kList", string.format(", .length = %d, .element = &%s, .list = &kListOperations<%s>, .is_array = %s",
                                        has(final, "length") and final.length or 0, values.type(final.type), held,
                                        final.kind == "array"))
  elseif final.kind == "optional" then
    return entry("kOptional", string.format(", .element = &%s, .element_offset = offsetof(%s, _value)", values.type(final.type), in_memory))
  elseif final.kind == "struct" or final.kind == "exception" then
    return entry("kStruct", ", .members = " .. members_of(declared[final.name].members, in_memory, number))
  elseif final.kind == "union" then
    local declaration = declared[final.name]
    return entry("kUnion", string.format(", .element = &%s, .members = %s", values.type(declaration.switch),
                                         members_of(declaration.members, in_memory, number, c.final(declaration.switch))))
  end
  return entry("kNative")
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
