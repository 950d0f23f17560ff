-- How the types of a description look to C++ outside of codels: types that copy what they own, laid out as those in C.

local c = library("c_mapping")
local execution = library("execution")
local types = {}

local basic = {
  boolean = "bool", octet = "std::uint8_t", char = "std::int8_t", short = "std::int16_t",
  ["unsigned short"] = "std::uint16_t", long = "std::int32_t", ["unsigned long"] = "std::uint32_t",
  ["long long"] = "std::int64_t", ["unsigned long long"] = "std::uint64_t", float = "float", double = "double",
}

-- Whose `#pragma masquerade` is meant; false: nobody's.
types.masquerades_as = false

-- What `#pragma masquerade runnel TYPE "NATIVE HEADER"` says: the type, and the header if there is one.
local function masquerade(name)
  local template = types.masquerades_as
  local all = template and has(model.masquerades, template) and model.masquerades[template] or {}
  if not name or not has(all, name) then return nil end
  local native, header = all[name]:match("^(%S+)%s+(%S+)$")
  return native or all[name], header
end
types.masquerade = masquerade

-- The type that a value of the type is to C++: the same in all components, whatever their codels are written in.
function types.view(type)
  if has(type, "name") then
    local native = masquerade(type.name)
    if native then return native end
  end
  local final = c.final(type)
  if final.kind == "native type" then return "void*" end
  if has(final, "name") then
    return masquerade(final.name) or "runnel_genom_types::" .. c.name(final.name)
  end
  if basic[final.kind] then return basic[final.kind] end
  local length = has(final, "length") and tostring(final.length) or nil
  local space = "runnel::genom_execution::"
  if final.kind == "string" then return length and space .. "BoundedText<" .. length .. ">" or space .. "OwnedText" end
  local of = types.view(final.type)
  if final.kind == "array" then return "std::array<" .. of .. ", " .. length .. ">" end
  if final.kind == "sequence" then
    return length and space .. "BoundedList<" .. of .. ", " .. length .. ">" or space .. "OwnedList<" .. of .. ">"
  end
  if final.kind == "optional" then return space .. "Presence<" .. of .. ">" end
  fail("a value of type '" .. final.kind .. "' cannot leave its component")
end

-- Whether values can be described: no natives inside.
function types.is_open(type)
  return not execution.has(type, function(each) return each.kind == "native type" end)
end

-- Natives and unions cannot be handed over to another module.
function types.is_kept(type)
  return not execution.has(type, function(each) return each.kind == "native type" or each.kind == "union" end)
end

-- A union's view is its bytes, which own nothing.
local function has_union_that_owns(type)
  return execution.has(type, function(each) return each.kind == "union" and execution.owns(each) end)
end

-- Whether codels of the component see values as the view has them. In C they do; in C++ lists are other classes.
function types.is_view(component, type)
  return component.lang == "c" or not execution.has(type, function(each)
    return each.kind == "sequence" or each.kind == "string" and not has(each, "length")
  end)
end

-- Whether there is a union within whose bytes are others than those of its view.
function types.has_union_that_is_none(component, type)
  return component.lang ~= "c" and execution.has(type, function(each) return each.kind == "union" and not types.is_view(component, each) end)
end

-- A type whose values are copied at ports and by calls.
function types.copied(component, type, what)
  if has_union_that_owns(type) then
    fail(what .. " has a union with a type without a bound within; give its sequences and strings a bound")
  end
  if types.has_union_that_is_none(component, type) then
    fail(what .. " has a union with a sequence within, which cannot leave a component in C++")
  end
  return types.view(type)
end

return types
