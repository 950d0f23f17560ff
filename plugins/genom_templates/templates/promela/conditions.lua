-- Conditions in Promela, unrolled over processes, slots and services.

local conditions = {}

-- "(state[i] == 1 || state[i] == 2)", of "state[i] == @".
local function any(list, text)
  local terms = {}
  for index, each in ipairs(list) do terms[index] = (text:gsub("@", tostring(each))) end
  return #terms > 0 and "(" .. table.concat(terms, " || ") .. ")" or "false"
end
conditions.any = any

function conditions.sorted(set)
  local list = {}
  for id in pairs(set) do list[#list + 1] = id end
  table.sort(list)
  return list
end

local function indices(slots)
  local list = {}
  for index, slot in ipairs(slots) do list[index] = slot.index end
  return list
end
function conditions.any_slot(slots, text) return any(indices(slots), text) end

-- That nothing runs which a codel excludes, and that nobody waits for that who has waited longer.
function conditions.may_run(parts, codel, has_waited)
  local terms = {}
  for process = 0, #parts.tasks do
    local ids = {}
    for _, id in ipairs(conditions.sorted(codel.not_with)) do
      if parts.codels[id].process == process then ids[#ids + 1] = id end
    end
    if #ids > 0 then
      terms[#terms + 1] = "!" .. any(ids, "runs[" .. process .. "] == @")
      local ahead = has_waited and "ahead_" .. process .. "_" .. codel.process .. " && " or ""
      terms[#terms + 1] = "!(" .. ahead .. any(ids, "wants[" .. process .. "] == @") .. ")"
    end
  end
  return #terms > 0 and table.concat(terms, " && ") or "true"
end

-- Processes of which one may wait for the other.
function conditions.rivals(parts)
  local rivals, seen = {}, {}
  for _, codel in ipairs(parts.codels) do
    for _, id in ipairs(conditions.sorted(codel.not_with)) do
      local name = parts.codels[id].process .. "_" .. codel.process
      if not seen[name] then rivals[#rivals + 1] = {first = parts.codels[id].process, second = codel.process, name = name} end
      seen[name] = true
    end
  end
  return rivals
end

-- That in a slot is an activity that a service interrupts.
function conditions.is_interrupted(service, slot)
  local list = {}
  for _, each in ipairs(slot.task.services) do
    if service.interrupts[each.name] then list[#list + 1] = each.index end
  end
  return #list > 0 and any(list, "service[" .. slot.index .. "] == @")
end

-- That an activity that would start in a slot still waits for those that it has stopped; nil if it never does.
function conditions.waits(parts, service, slot)
  local terms = {}
  for _, other in ipairs(parts.regular) do
    local is_one = other ~= slot and conditions.is_interrupted(service, other)
    if is_one then
      terms[#terms + 1] = ("(phase[%d] >= asked && stopped[%d] > 0 && %s)"):format(other.index, other.index, is_one)
    end
  end
  return #terms > 0 and table.concat(terms, " || ") or nil
end

function conditions.may_start(parts, slot)
  local terms = {}
  for _, service in ipairs(slot.task.services) do
    local waits = conditions.waits(parts, service, slot)
    terms[#terms + 1] = "service[" .. slot.index .. "] == " .. service.index .. (waits and " && !(" .. waits .. ")" or "")
  end
  return "phase[" .. slot.index .. "] == pending && (" .. table.concat(terms, " || ") .. ")"
end

-- That a service may be asked for.
function conditions.is_offered(parts, service)
  local terms = {"!silent", "!may_start"}
  for _, list in ipairs({{service.before, "!succeeded_"}, {service.after, "succeeded_"}}) do
    for _, each in ipairs(parts.services) do
      for _, name in ipairs(list[1]) do
        if name == each.name or name == "all" then terms[#terms + 1] = list[2] .. each.index end
      end
    end
  end
  if service.process then
    local slots = {}
    for _, slot in ipairs(parts.tasks[service.process].slots) do
      if not slot.is_permanent then slots[#slots + 1] = slot end
    end
    terms[#terms + 1] = conditions.any_slot(slots, "phase[@] == idle")
  end
  return table.concat(terms, " && ")
end

return conditions
