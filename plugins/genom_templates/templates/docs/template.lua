-- A page for each component: ports, services, defaults, tasks, state machines drawn.

for _, component in ipairs(model.components) do
  file("component.md.in", component.name .. ".md", {component = component})
  local function draw(name, owner)
    if next(owner.states) ~= nil then file("states.svg.in", name .. ".svg", {owner = owner}) end
  end
  for _, task in ipairs(component.tasks) do draw(component.name .. "_" .. task.name, task) end
  for _, service in ipairs(component.services) do draw(component.name .. "_" .. service.name, service) end
end
