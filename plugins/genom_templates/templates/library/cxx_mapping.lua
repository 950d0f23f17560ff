-- How types, states and codels look in C++, as codels with lang "c++" see them.

local c = library("c_mapping")
local mapping = {}

local declared = {}
for _, type in ipairs(model.types) do declared[type.name] = type end

local basic = {
  boolean = "bool", octet = "uint8_t", char = "int8_t", short = "int16_t", ["unsigned short"] = "uint16_t",
  long = "int32_t", ["unsigned long"] = "uint32_t", ["long long"] = "int64_t", ["unsigned long long"] = "uint64_t",
  float = "float", double = "double",
}

-- A type and the sizes behind what is declared with it.
local function parts(type)
  if has(type, "name") then
    if type.kind == "exception" then return mapping.detail(type.name), "" end
    return "::" .. type.name .. (type.kind == "native type" and " *" or ""), ""
  end
  if basic[type.kind] then return basic[type.kind], "" end
  if type.kind == "string" then
    if has(type, "length") then return "char", "[" .. type.length .. "]" end
    return "std::string", ""
  end
  local of, sizes = parts(type.type)
  if type.kind == "array" then return of, "[" .. type.length .. "]" .. sizes end
  if type.kind == "sequence" then
    if has(type, "length") then return "genom::bounded_sequence< " .. of .. sizes .. ", " .. type.length .. " >", "" end
    if sizes ~= "" then fail("a sequence of arrays or bounded strings needs a bound in C++") end
    return "std::vector< " .. of .. " >", ""
  end
  if type.kind == "optional" then return "genom::optional< " .. of .. sizes .. " >", "" end
  fail("a value of type '" .. type.kind .. "' is nothing for C++")
end

-- A variable, member or alias of the type.
function mapping.variable(type, name)
  local before, behind = parts(type)
  return before .. " " .. name .. behind
end

-- What "nav::pose" is called, its name as an exception, and what lies in that.
function mapping.named(name) return "::" .. name end
function mapping.exception(name) return "::" .. name .. "_id" end
function mapping.detail(name) return "decltype(::" .. name .. "::detail)" end
function mapping.header(component) return component .. "_cxx_types.h" end
mapping.context = "const runnel::genom_execution::CodelContext*"

-- A reference to a value of the type, which a function returns.
function mapping.reference(type, declared)
  local before, behind = parts(type)
  if behind == "" then return before .. " &" .. declared end
  return before .. " (&" .. declared .. ")" .. behind
end

-- What a codel is given for a parameter, for which an expression stands.
function mapping.argument(expression) return expression end

-- What a parameter of a remote stands for; arrays lose their type on the way, which value_NAME is.
function mapping.referred(parameter)
  local final = c.final(parameter.type)
  if final.kind ~= "array" and (final.kind ~= "string" or not has(final, "length")) then return parameter.name end
  local const = parameter.direction == "in" and "const " or ""
  return "*reinterpret_cast<" .. const .. "value_" .. parameter.name .. "*>(" .. parameter.name .. ")"
end

local compound = {sequence = true, optional = true, struct = true, union = true, exception = true}

-- A parameter of a codel or remote, as its signature declares it.
function mapping.parameter(component, parameter)
  for _, what in ipairs({"port", "remote"}) do
    if has(parameter, what) then return "::" .. component .. "::" .. parameter[what] .. " &" .. parameter.name end
  end
  local final = c.final(parameter.type)
  local is_array = final.kind == "array" or final.kind == "string" and has(final, "length")
  if parameter.direction ~= "in" then
    return mapping.variable(parameter.type, (is_array and "" or "&") .. parameter.name)
  end
  if compound[final.kind] or final.kind == "string" and not is_array then
    return "const " .. mapping.variable(parameter.type, "&" .. parameter.name)
  end
  if is_array or final.kind == "native type" then return "const " .. mapping.variable(parameter.type, parameter.name) end
  return mapping.variable(parameter.type, parameter.name)
end

function mapping.signature(component, codel)
  local list = {}
  for _, each in ipairs(codel.parameters) do list[#list + 1] = mapping.parameter(component, each) end
  return "genom::event\n" .. codel.name .. "(" .. (#list > 0 and table.concat(list, ",\n" .. string.rep(" ", #codel.name + 1)) or "void") .. ")"
end

-- What a codel returns for an event of its yield list.
function mapping.event(component, event) return "::" .. component .. "::" .. event end

-- "nav::limits" in namespace nav: what stands before it, its own name, what stands behind.
function mapping.scoped(name)
  local before, own = name:match("^(.*)::([^:]+)$")
  if not before then return "", name, "" end
  local open, close = "", ""
  for each in before:gmatch("[^:]+") do
    open, close = open .. "namespace " .. each .. " { ", close .. " }"
  end
  return open, own, close
end

-- The type that it is declared in, nil if it is none.
function mapping.outer(name)
  local before = name:match("^(.*)::[^:]+$")
  local type = before and rawget(declared, before)
  return type and (type.kind == "struct" or type.kind == "union" or type.kind == "exception") and before or nil
end

return mapping
