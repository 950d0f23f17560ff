-- How the types of a description look in Runnel: types with a description of the same layout as those in C.

local c = library("c_mapping")
local execution = library("execution")
local types = {}

local basic = {
  boolean = "bool", octet = "std::uint8_t", char = "std::int8_t", short = "std::int16_t",
  ["unsigned short"] = "std::uint16_t", long = "std::int32_t", ["unsigned long"] = "std::uint32_t",
  ["long long"] = "std::int64_t", ["unsigned long long"] = "std::uint64_t", float = "float", double = "double",
}

-- What `#pragma masquerade runnel TYPE "NATIVE HEADER"` says: the type, and the header if there is one.
local function masquerade(name)
  local all = has(model.masquerades, "runnel") and model.masquerades.runnel or {}
  if not name or not has(all, name) then return nil end
  local native, header = all[name]:match("^(%S+)%s+(%S+)$")
  return native or all[name], header
end
types.masquerade = masquerade

-- The type that ports, services and parameters have.
function types.view(type)
  if has(type, "name") then
    local native = masquerade(type.name)
    if native then return native end
  end
  local final = c.final(type)
  if has(final, "name") then
    local native = masquerade(final.name)
    if native then return native end
    if final.kind == "enum" then return "runnel_genom_types::" .. c.name(final.name) end
    return c.name(final.name)
  end
  if basic[final.kind] then return basic[final.kind] end
  local length = has(final, "length") and tostring(final.length) or nil
  if final.kind == "string" then return length and "BoundedText<" .. length .. ">" or "OwnedText" end
  local of = types.view(final.type)
  if final.kind == "array" then return "std::array<" .. of .. ", " .. length .. ">" end
  if final.kind == "sequence" then
    return length and "BoundedList<" .. of .. ", " .. length .. ">" or "OwnedList<" .. of .. ">"
  end
  if final.kind == "optional" then return "Presence<" .. of .. ">" end
  fail("a value of type '" .. final.kind .. "' cannot leave its component")
end

-- Natives, unions and what owns memory inside cannot be handed over to another module.
function types.is_plain(type)
  local final = execution.declared(type)
  if final.kind == "native type" or final.kind == "union" or execution.owns(type) then return false end
  if has(final, "type") then return types.is_plain(final.type) end
  if final.kind == "struct" then
    for _, member in ipairs(final.members) do
      if not types.is_plain(member.type) then return false end
    end
  end
  return true
end

-- Whether values can be described: no natives inside.
function types.is_open(type)
  local final = execution.declared(type)
  if final.kind == "native type" then return false end
  if has(final, "type") then return types.is_open(final.type) end
  if final.kind == "struct" then
    for _, member in ipairs(final.members) do
      if not types.is_open(member.type) then return false end
    end
  end
  return true
end

-- A type whose values are copied at ports and by calls.
function types.copied(type, what)
  if execution.owns(type) == "within" then
    fail(what .. " has a type without a bound within; give its sequences and strings a bound")
  end
  return types.view(type)
end

-- A default of the description, in Runnel's text format.
local function text(initial)
  if has(initial, "parts") then
    local parts, at = {}, 0
    local is_list = false
    for _, part in ipairs(initial.parts) do
      if has(part, "index") then is_list = true end
    end
    if is_list then return nil end
    for _, part in ipairs(initial.parts) do
      local inner = text(part)
      if inner and has(part, "member") then parts[#parts + 1] = part.member .. ": " .. inner end
    end
    if #parts == 0 then return nil end
    return "{" .. table.concat(parts, ", ") .. "}"
  end
  if not has(initial, "value") then return nil end
  if type(initial.value) == "string" then
    local enumerator = initial.value:match("::([%w_]+)$")
    return enumerator or '"' .. initial.value .. '"'
  end
  return tostring(initial.value)
end
function types.default(parameter)
  return has(parameter, "default") and text(parameter.default) or nil
end

return types
