-- What a component is made of, as the model has it: processes, slots of activities, states and codels by numbers, and
-- which codels conflict. That is worked out anew from what they use, so that the model checks what the description says
-- they exclude.

local function place(thing)
  local file = thing.place.file:gsub('[\\"%%]', "?")
  return file .. "\\t" .. thing.place.line .. "\\t" .. thing.place.column
end

local function is_prefix(a, b)
  for index = 1, math.min(#a, #b) do
    if a[index] ~= b[index] then return false end
  end
  return true
end

-- Uses of data, of a codel or of an attribute, whose `in` is written.
local function uses(parameters, is_attribute)
  local list = {}
  for _, each in ipairs(parameters) do
    if has(each, "port") then
      list[#list + 1] = {port = each.port, path = {}, writes = true, text = "port " .. each.port}
    elseif each.source == "ids" then
      local text = "ids"
      for _, step in ipairs(each.path) do text = text .. (math.type(step) and "[" .. step .. "]" or "." .. step) end
      list[#list + 1] = {port = "", path = each.path, text = text,
                         writes = each.direction ~= (is_attribute and "out" or "in")}
    end
  end
  return list
end

-- What both use and may not use at once, nil if there is nothing.
local function shared(a, b)
  for _, one in ipairs(a) do
    for _, other in ipairs(b) do
      if one.port == other.port and is_prefix(one.path, other.path) and (one.writes or other.writes) then
        return #one.path > #other.path and one.text or other.text
      end
    end
  end
end

-- How far each state of a machine is from the end; none: it never gets there.
local function distances(owner)
  local far = {ether = 0}
  local changed = true
  while changed do
    changed = false
    for _, codel in ipairs(owner.codels) do
      for _, event in ipairs(codel.yields) do
        local next_state = far[event:match("^pause::(.*)") or event]
        for _, state in ipairs(codel.states) do
          if next_state and (not far[state] or far[state] > next_state + 1) then
            far[state] = next_state + 1
            changed = true
          end
        end
      end
    end
  end
  return far
end

return function(component, slots_of_task, excludes)
  local parts = {tasks = {}, slots = {}, codels = {}, states = {}, services = {}, regular = {},
                 place = place(component)}
  local process_of = {}
  local state_numbers = {}
  local function number(state)
    if not state_numbers[state] then
      parts.states[#parts.states + 1] = state
      state_numbers[state] = #parts.states
    end
    return state_numbers[state]
  end

  -- Codels, and attributes, which are as exclusive while they copy.
  local function add(codel)
    codel.id = #parts.codels + 1
    parts.codels[codel.id] = codel
    return codel
  end
  local function key_of(name, task, service) return name .. "/" .. (task or "") .. "/" .. (service or "") end
  local function add_codel(each, process, owner, service)
    return add({name = each.name, process = process, owner = owner, key = key_of(each.name, each.task, service), place = place(each),
                kind = each.kind, uses = uses(each.parameters, false), excludes = each.excludes_codels,
                excludes_services = each.excludes_services})
  end

  local function machine(owner)
    local far = distances(owner)
    local list = {}
    for _, each in ipairs(owner.codels) do
      if each.kind == "state machine" then
        local codel = add_codel(each, process_of[owner], owner.shown, owner.key)
        codel.states, codel.yields = {}, {}
        local nearest
        for _, event in ipairs(each.yields) do
          local distance = far[event:match("^pause::(.*)") or event]
          if distance and (not nearest or distance < nearest) then nearest = distance end
        end
        for _, state in ipairs(each.states) do codel.states[#codel.states + 1] = number(state) end
        for _, event in ipairs(each.yields) do
          local state = event:match("^pause::(.*)") or event
          codel.yields[#codel.yields + 1] = {name = event, state = state ~= "ether" and number(state) or 0,
                                             pauses = state ~= event, is_detour = nearest ~= nil and far[state] ~= nearest}
        end
        list[#list + 1] = codel
      end
    end
    return list
  end
  local function count(states)
    local total = 0
    for _ in pairs(states) do total = total + 1 end
    return total
  end
  local function add_machine(owner, key, shown, process)
    local copy = {codels = owner.codels, key = key, shown = shown}
    process_of[copy] = process
    return {name = owner.name, key = key, shown = shown, codels = machine(copy), has_stop = has(owner.states, "stop"),
            detours = count(owner.states), is_remembered = false, throws = #owner.throws > 0, place = place(owner), process = process}
  end

  number("start")
  number("stop")
  for index, task in ipairs(component.tasks) do
    local permanent = add_machine(task, false, "task " .. task.name, index)
    permanent.has_start = has(task.states, "start")
    parts.tasks[index] = {name = task.name, index = index, bit = 1 << (index - 1), is_periodic = task.period ~= false,
                          permanent = permanent, slots = {}}
    process_of[task.name] = index
  end
  for index, service in ipairs(component.services) do
    local made
    if service.task then
      made = add_machine(service, service.name, service.kind .. " " .. service.name, process_of[service.task])
    else
      made = {name = service.name, shown = service.kind .. " " .. service.name, throws = #service.throws > 0, place = place(service)}
    end
    made.index, made.kind = index, service.kind
    made.before, made.after, made.interrupts = service.before, service.after, {}
    for _, name in ipairs(service.interrupts) do made.interrupts[name] = true end
    made.validates, made.simple = {}, {}
    for _, each in ipairs(service.codels) do
      if each.kind ~= "state machine" then
        local list = each.kind == "validate" and made.validates or made.simple
        list[#list + 1] = add_codel(each, 0, made.shown, service.name)
      end
    end
    if service.kind == "attribute" then
      made.copy = add({name = service.name, process = 0, owner = made.shown, key = "=" .. service.name, kind = "attribute",
                       place = place(service), uses = uses(service.parameters, true), excludes = {}, excludes_services = {}})
    end
    parts.services[index] = made
    made.is_remembered = false
  end

  for _, service in ipairs(parts.services) do
    for _, list in ipairs({service.before, service.after}) do
      for _, name in ipairs(list) do
        for _, each in ipairs(parts.services) do
          each.is_remembered = each.is_remembered or name == "all" or name == each.name
        end
      end
    end
  end

  -- Who excludes whom: both, if one of them says so.
  local by_key = {}
  for _, codel in ipairs(parts.codels) do
    codel.not_with, codel.conflicts = {}, {}
    by_key[codel.key] = by_key[codel.key] or {}
    table.insert(by_key[codel.key], codel)
  end
  local function note(a, key)
    for _, b in ipairs(by_key[key] or {}) do
      a.not_with[b.id], b.not_with[a.id] = true, true
    end
  end
  if excludes then
    for _, codel in ipairs(parts.codels) do
      for _, each in ipairs(codel.excludes) do note(codel, key_of(each.codel, each.task, each.service)) end
      for _, each in ipairs(codel.excludes_services) do note(codel, "=" .. each) end
    end
  end
  for _, a in ipairs(parts.codels) do
    for _, b in ipairs(parts.codels) do
      if a.process ~= b.process then a.conflicts[b.id] = shared(a.uses, b.uses) end
    end
    a.is_exclusive = next(a.not_with) ~= nil or next(a.conflicts) ~= nil
  end

  -- Slots: of permanent activities, then of others.
  for _, task in ipairs(parts.tasks) do
    if #task.permanent.codels > 0 then
      task.permanent.slot = #parts.slots
      parts.slots[#parts.slots + 1] = {index = #parts.slots, task = task, is_permanent = true}
      table.insert(task.slots, parts.slots[#parts.slots])
    end
  end
  for _, task in ipairs(parts.tasks) do
    task.services = {}
    for _, service in ipairs(parts.services) do
      if service.process == task.index then table.insert(task.services, service) end
    end
    for index = 1, #task.services > 0 and slots_of_task or 0 do
      parts.slots[#parts.slots + 1] = {index = #parts.slots, task = task, is_permanent = false}
      table.insert(task.slots, parts.slots[#parts.slots])
      table.insert(parts.regular, parts.slots[#parts.slots])
    end
  end
  return parts
end
