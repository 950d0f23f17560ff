#include "plugins/scheduling/execution_order.h"

#include <algorithm>
#include <deque>
#include <map>
#include <utility>

#include "plugins/scheduling/internal/cut_report.h"
#include "plugins/scheduling/internal/data_flow.h"
#include "plugins/scheduling/internal/running_order.h"

namespace runnel {

namespace {

struct InputTask : internal::OrderedTask {
  Task task;
};

// From task to task within each element, in the order of their phases.
void KeepPhases(std::deque<InputTask>& tasks, internal::RunningOrder& order) {
  std::map<std::uint64_t, std::vector<InputTask*>> of_element;
  for (InputTask& each : tasks) of_element[each.id].push_back(&each);
  for (auto& [id, own] : of_element) {
    std::ranges::sort(own, {}, [](const InputTask* each) { return each->key(); });
    for (std::size_t i = 1; i < own.size(); ++i) order.KeepPhases(*own[i - 1], *own[i]);
  }
}

}  // namespace

ExecutionOrder OrderTasks(std::vector<Task> tasks) {
  const std::vector<internal::DataEdge> edges = internal::FindDataEdges(tasks);
  std::deque<InputTask> inputs;
  internal::RunningOrder order;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    InputTask& input = inputs.emplace_back(InputTask{{}, std::move(tasks[i])});
    input.phase = input.task.phase;
    input.id = input.task.element->id();
    input.number = i;
    order.Add(input);
  }
  KeepPhases(inputs, order);
  for (const auto& edge : edges) {
    order.Connect(inputs[edge.from], inputs[edge.to], {edge.from_port, edge.to_port});
  }
  order.Sort();
  ExecutionOrder result;
  for (internal::OrderedTask* each : order.tasks()) {
    result.tasks.push_back(std::move(static_cast<InputTask*>(each)->task));
  }
  internal::ReportCuts(order, result.cuts);
  return result;
}

}  // namespace runnel
