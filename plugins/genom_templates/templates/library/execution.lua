-- What plugins/genom_execution wants to know of a component: who has which codels, states and conflicts, and how a codel
-- is called. For templates whose components run on that engine.

local c = library("c_mapping")
local execution = {}

local declared = {}
for _, type in ipairs(model.types) do declared[type.name] = type end

-- What is declared under the name of a type, behind its other names; the type itself if it has no name.
function execution.declared(type)
  local final = c.final(type)
  return has(final, "name") and declared[final.name] or final
end

-- Whether values have, within, what the predicate says of a type without other names.
function execution.has(type, predicate, seen)
  local final = execution.declared(type)
  if predicate(final) then return true end
  if final.kind == "array" or final.kind == "sequence" or final.kind == "optional" then
    return execution.has(final.type, predicate, seen)
  end
  if final.kind ~= "struct" and final.kind ~= "union" and final.kind ~= "exception" then return false end
  seen = seen or {}
  if seen[final.name] then return false end
  seen[final.name] = true
  for _, member in ipairs(final.members) do
    if execution.has(member.type, predicate, seen) then return true end
  end
  return false
end

-- Whether values own memory.
function execution.owns(type)
  return execution.has(type, function(each) return (each.kind == "string" or each.kind == "sequence") and not has(each, "length") end)
end

-- What _d is for a label.
function execution.label_number(switch, label)
  if switch.kind == "enum" then
    for index, each in ipairs(declared[switch.name].enumerators) do
      if each == label or each:match("([%w_]+)$") == label then return index - 1 end
    end
  end
  if label == true then return 1 elseif label == false then return 0 end
  if math.type(label) then return math.floor(label) end
  return tostring(label):byte()
end

-- Codels by their owners, numbered as in the tables; each with what it is called in them.
function execution.codels(component)
  local all, index = {}, {}
  local function add(kind, owner)
    for _, codel in ipairs(owner.codels) do
      local entry = {number = #all, codel = codel, owner = owner, kind = kind}
      all[#all + 1] = entry
      index[kind .. "/" .. owner.name .. "/" .. codel.name] = entry
    end
  end
  for _, task in ipairs(component.tasks) do add("task", task) end
  for _, service in ipairs(component.services) do add("service", service) end
  return all, index
end

-- The numbers of services by their names.
function execution.services(component)
  local numbers = {}
  for index, service in ipairs(component.services) do numbers[service.name] = index - 1 end
  return numbers
end

-- Pairs of units that must not run at the same time, the smaller number first.
function execution.conflicts(component)
  local all, index = execution.codels(component)
  local services, seen, pairs_of = execution.services(component), {}, {}
  local function add(a, b)
    if a > b then a, b = b, a end
    if seen[a .. "/" .. b] then return end
    seen[a .. "/" .. b] = true
    pairs_of[#pairs_of + 1] = {a, b}
  end
  for _, entry in ipairs(all) do
    for _, other in ipairs(entry.codel.excludes_codels) do
      local key = (other.service and "service/" .. other.service or "task/" .. other.task) .. "/" .. other.codel
      if index[key] then add(entry.number, index[key].number) end
    end
    for _, name in ipairs(entry.codel.excludes_services) do add(entry.number, #all + services[name]) end
  end
  return pairs_of
end

-- The states of a task's or an activity's machine in the order of the tables, each with the number of its codel and its
-- transitions; and the numbers of start and stop, or false.
function execution.machine(component, kind, owner)
  local _, index = execution.codels(component)
  local language = library("languages")(component)
  local names = {}
  for name in pairs(owner.states) do names[#names + 1] = name end
  local function rank(name) return name == "start" and 1 or name == "stop" and 2 or 3 end
  table.sort(names, function(a, b)
    if rank(a) ~= rank(b) then return rank(a) < rank(b) end
    return a < b
  end)
  local number = {}
  for at, name in ipairs(names) do number[name] = at - 1 end
  local states = {}
  for _, name in ipairs(names) do
    local entry = index[kind .. "/" .. owner.name .. "/" .. owner.states[name]]
    local transitions = {}
    for _, event in ipairs(entry.codel.yields) do
      local paused = event:match("^pause::(.*)")
      local to = paused or event
      transitions[#transitions + 1] = {event = language.event(component.name, event), pauses = paused ~= nil,
                                       state = to == "ether" and "kEther" or tostring(number[to])}
    end
    states[#states + 1] = {name = name, codel = entry.number, transitions = transitions}
  end
  return states, number.start or false, number.stop or false
end

-- Values whose parts may not be there when a codel is to be given them, and nobody could tell it.
local may_lack = setmetatable({optional = "may be absent", sequence = "may have no such element", union = "may have another member"},
                              {__index = function() return false end})

local function refuse_part(parameter, at, lack)
  local whole = parameter.path[1]
  for i = 2, at - 1 do
    local step = parameter.path[i]
    whole = whole .. (math.type(step) and "[" .. step .. "]" or "." .. step)
  end
  local place = has(parameter, "place") and parameter.place
  local where = place and string.format("%s:%d:%d: ", place.file, place.line, place.column) or ""
  fail(where .. "'" .. parameter.name .. "' is a part of '" .. whole .. "', which " .. lack .. "; take '" .. whole ..
       "' as a whole, and let the codel look")
end

-- Where a parameter of a codel lies: an expression in C++, with `ids` and `data` as pointers; and its type.
local function place(component, owner, parameter)
  local path, expression, type = parameter.path, nil, nil
  local from = 1
  if parameter.source == "ids" then
    expression, type = "(*ids)", component.ids
  else
    expression = "data->" .. path[1]
    from = 2
    for _, list in ipairs({owner.parameters, owner.variables}) do
      for _, each in ipairs(list) do
        if each.name == path[1] then type = each.type end
      end
    end
  end
  for at = from, #path do
    local step = path[at]
    local final = execution.declared(type)
    if may_lack[final.kind] then refuse_part(parameter, at, may_lack[final.kind]) end
    if math.type(step) then
      expression, type = expression .. "[" .. step .. "]", final.type
    else
      for _, member in ipairs(final.members) do
        if member.name == step then type = member.type end
      end
      expression = expression .. "." .. step
    end
  end
  return expression, type
end
execution.place = place

-- What a codel is given for a parameter.
function execution.argument(component, owner, parameter)
  for _, what in ipairs({"port", "remote"}) do
    if has(parameter, what) then
      local name = component.name .. "_" .. what .. "_" .. parameter[what]
      return component.lang == "c" and "&" .. name or what .. "_" .. parameter[what]
    end
  end
  return library("languages")(component).argument(place(component, owner, parameter), parameter)
end

-- The addresses of the names of exceptions. Each codel may raise those of every component, too.
function execution.events(component, names)
  local language = library("languages")(component)
  local list = {language.exception("genom::unkex"), language.exception("genom::syserr"), "kMiddlewareError"}
  for _, name in ipairs(names) do list[#list + 1] = language.exception(name) end
  return table.concat(list, ", ")
end

-- A text as a literal in C++.
function execution.literal(text)
  return '"' .. text:gsub("\\", "\\\\"):gsub('"', '\\"'):gsub("\n", "\\n") .. '"'
end

return execution
