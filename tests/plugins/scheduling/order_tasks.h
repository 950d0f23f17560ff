#pragma once

#include <algorithm>
#include <deque>
#include <map>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "core/module/executable.h"
#include "core/port/port.h"
#include "plugins/scheduling/internal/schedule_plan.h"
#include "plugins/task_order/running_order.h"

namespace runnel::testing {

/// The order in which the tasks of one thread run, and the connections that it could not follow.
struct ExecutionOrder {
  std::vector<Task> tasks;
  std::vector<Error> cuts;
};

struct OrderedInput : internal::OrderedTask {
  Task task;
};

inline bool IsAtOrBelowOneOf(const Port& port, const std::vector<const FrameworkElement*>& groups) {
  return std::ranges::any_of(
      groups, [&](const FrameworkElement* group) { return group != nullptr && port.IsAtOrBelow(*group); });
}

/// All tasks at once, as the ScheduleCompiler does it bit by bit.
inline ExecutionOrder OrderTasks(std::vector<Task> tasks) {
  std::deque<OrderedInput> inputs;
  internal::RunningOrder order;
  std::map<std::uint64_t, std::vector<OrderedInput*>> of_element;
  for (Task& task : tasks) {
    OrderedInput& input = inputs.emplace_back(OrderedInput{{}, std::move(task)});
    input.phase = input.task.phase;
    input.id = input.task.element->id();
    input.number = inputs.size() - 1;
    order.Add(input);
    of_element[input.id].push_back(&input);
  }
  for (auto& [id, own] : of_element) {
    std::ranges::sort(own, {}, [](const OrderedInput* each) { return each->key(); });
    for (std::size_t i = 1; i < own.size(); ++i) order.KeepPhases(*own[i - 1], *own[i]);
  }
  for (OrderedInput& from : inputs) {
    for (const FrameworkElement* group : from.task.writes) {
      internal::VisitPorts(group, [&](Port& output) {
        if (output.is_proxy() || output.direction() != Port::Direction::kOutput) return;
        for (Port* input : output.Sinks()) {
          for (OrderedInput& to : inputs) {
            if (IsAtOrBelowOneOf(*input, to.task.reads)) order.Connect(from, to, {&output, input});
          }
        }
      });
    }
  }
  order.Sort();
  ExecutionOrder result;
  for (internal::OrderedTask* each : order.tasks()) {
    result.tasks.push_back(std::move(static_cast<OrderedInput*>(each)->task));
  }
  internal::ReportCuts(order, result.cuts);
  return result;
}

}  // namespace runnel::testing
