-- What the author of a component fills in: a file of codels for each task and one for the rest, and what builds them.
-- All of it is the author's: made anew, it keeps what was changed.

for _, component in ipairs(model.components) do
  local name = component.name
  if component.lang ~= "c" and component.lang ~= "c++" then
    fail("the codels of '" .. name .. "' are in '" .. component.lang .. "', of which this template knows nothing")
  end
  local extension = component.lang == "c" and ".c" or ".cpp"
  local files = {}
  local function add(file, title, codels)
    local seen, own = {}, {}
    for _, codel in ipairs(codels) do
      if not seen[codel.name] then
        seen[codel.name] = true
        own[#own + 1] = codel
      end
    end
    if #own == 0 then return end
    files[#files + 1] = file
    keep("codels.c.in", "codels/" .. file, {component = component, title = title, codels = own})
  end

  local control = {}
  for _, service in ipairs(component.services) do
    for _, codel in ipairs(service.codels) do
      if codel.kind ~= "state machine" then control[#control + 1] = {codel = codel, service = service} end
    end
  end
  local function all(list)
    local codels = {}
    for _, each in ipairs(list) do
      local copy = {of_service = each.service or false, of_task = each.task or false}
      for key, value in pairs(each.codel) do copy[key] = value end
      codels[#codels + 1] = copy
    end
    return codels
  end
  add(name .. "_codels" .. extension, "the control task of " .. name, all(control))
  for _, task in ipairs(component.tasks) do
    local own = {}
    for _, codel in ipairs(task.codels) do own[#own + 1] = {codel = codel, task = task} end
    for _, service in ipairs(component.services) do
      if service.task == task.name then
        for _, codel in ipairs(service.codels) do
          if codel.kind == "state machine" then own[#own + 1] = {codel = codel, service = service} end
        end
      end
    end
    add(name .. "_" .. task.name .. "_codels" .. extension, "task " .. task.name .. " of " .. name, all(own))
  end
  keep("CMakeLists.txt.in", "CMakeLists.txt",
       {component = component, files = files, description = component.place.file:match("[^/]+$")})
  keep("README.md.in", "README.md", {component = component})
end
