-- Names that C++ does not take: what is generated for a component of any language is compiled as C++.

local words = {}
for each in ([[alignas alignof and and_eq asm auto bitand bitor bool break case catch char char8_t char16_t char32_t class compl
    concept const consteval constexpr constinit const_cast continue co_await co_return co_yield decltype default delete do double
    dynamic_cast else enum explicit export extern false float for friend goto if inline int long mutable namespace new noexcept
    not not_eq nullptr operator or or_eq private protected public register reinterpret_cast requires return short signed sizeof
    static static_assert static_cast struct switch template this thread_local throw true try typedef typeid typename union
    unsigned using virtual void volatile wchar_t while xor xor_eq]]):gmatch("%S+") do words[each] = true end

local function check(name, what, of)
  if not words[name] then return end
  local place = has(of, "place") and of.place
  local where = place and string.format("%s:%d:%d: ", place.file, place.line, place.column) or ""
  fail(where .. what .. " cannot be called '" .. name .. "', which is a word of C++; give it another name")
end

-- Fails with the first one, and its place.
return function(component)
  for _, type in ipairs(model.types) do
    if component.lang ~= "c" or not type.name:find("::") then check(type.name:match("([%w_]+)$"), "a " .. type.kind, type) end
    for _, each in ipairs(has(type, "members") and type.members or {}) do check(each.name, "a member of '" .. type.name .. "'", type) end
    for _, each in ipairs(has(type, "enumerators") and type.enumerators or {}) do
      if component.lang ~= "c" or not each:find("::") then check(each:match("([%w_]+)$"), "a name of '" .. type.name .. "'", type) end
    end
  end
  -- In C they all have the component's or the interface's name in front.
  for _, list in ipairs(component.lang ~= "c" and {{component}, component.ports, component.remotes} or {}) do
    local kind = list == component.ports and "a port" or list == component.remotes and "a remote" or "a component"
    for _, each in ipairs(list) do
      check(has(each, "interface") and each.interface or "", "an interface", each)
      check(each.name, kind, each)
    end
  end
  for _, owners in ipairs({component.services, component.tasks}) do
    for _, owner in ipairs(owners) do
      for _, list in ipairs({has(owner, "parameters") and owner.parameters or {}, has(owner, "variables") and owner.variables or {}}) do
        for _, each in ipairs(list) do check(each.name, "a parameter or variable of '" .. owner.name .. "'", each) end
      end
      for _, codel in ipairs(owner.codels) do
        check(codel.name, "a codel", codel)
        for _, each in ipairs(codel.parameters) do check(each.name, "a parameter of codel '" .. codel.name .. "'", each) end
        for _, event in ipairs(component.lang ~= "c" and codel.yields or {}) do check(event:match("([%w_]+)$"), "an event", codel) end
      end
    end
  end
end
