-- Whether a type of C++ that stands for one of the description (`#pragma masquerade`) is laid out like it, member by
-- member: text that does not compile otherwise, with the place in the description.

local c = library("c_mapping")
local execution = library("execution")
local masquerade = {}

local integers = {
  octet = true, char = true, short = true, ["unsigned short"] = true, long = true, ["unsigned long"] = true,
  ["long long"] = true, ["unsigned long long"] = true,
}

local function quoted(text) return execution.literal(text) end

-- `type` is declared in the description and has members or none; `native` is the type of C++, `codels` what codels have.
function masquerade.checks(type, native, codels)
  local name = c.name(type.name)
  local where = type.place and string.format("%s:%d:%d: ", type.place.file, type.place.line, type.place.column) or ""
  local stands = "'" .. native .. "' stands for '" .. type.name .. "'"
  local lines = {}
  local function check(condition, message) lines[#lines + 1] = "static_assert(" .. condition .. ",\n              " .. quoted(where .. stands .. message) .. ");" end
  if type.kind == "struct" then
    check("std::is_standard_layout_v<" .. native .. ">", ", and its members lie who knows where")
    for _, member in ipairs(type.members) do
      local own, other = codels .. "::" .. member.name, native .. "::" .. member.name
      local has_it = "HasMember_" .. name .. "_" .. member.name
      local kind = c.final(member.type).kind
      lines[#lines + 1] = "template <typename Native>\nconcept " .. has_it .. " = requires(Native value) { value." .. member.name .. "; };"
      check(has_it .. "<" .. native .. ">", ", and has no member '" .. member.name .. "'")
      check("offsetof(" .. native .. ", " .. member.name .. ") == offsetof(" .. codels .. ", " .. member.name .. ") && sizeof(" .. other ..
            ") == sizeof(" .. own .. ")", ", and its member '" .. member.name .. "' lies elsewhere or has another size")
      local like
      if kind == "float" or kind == "double" then
        like = "std::is_floating_point_v<decltype(" .. other .. ")>"
      elseif kind == "boolean" then
        like = "std::is_same_v<decltype(" .. other .. "), bool>"
      elseif integers[kind] then
        like = "std::is_integral_v<decltype(" .. other .. ")> && std::is_signed_v<decltype(" .. other .. ")> == std::is_signed_v<decltype(" .. own .. ")>"
        if kind == "char" then like = "std::is_integral_v<decltype(" .. other .. ")>" end
      elseif kind == "enum" then
        like = "std::is_enum_v<decltype(" .. other .. ")> || std::is_unsigned_v<decltype(" .. other .. ")>"
      end
      if like then check(like, ", and its member '" .. member.name .. "' is no " .. kind) end
    end
  end
  check("sizeof(" .. native .. ") == sizeof(" .. codels .. ") && alignof(" .. native .. ") == alignof(" .. codels .. ")",
        ", and has another size: it has other members")
  return table.concat(lines, "\n")
end

return masquerade
