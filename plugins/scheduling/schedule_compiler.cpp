#include "plugins/scheduling/schedule_compiler.h"

#include <algorithm>
#include <utility>

#include "core/lockfree/thread_epoch.h"
#include "core/port/input.h"
#include "plugins/scheduling/cycle_runner.h"
#include "plugins/scheduling/execution_order.h"
#include "plugins/scheduling/internal/data_flow.h"

namespace runnel {

namespace {

struct Found {
  std::vector<ThreadContainer*> containers;
  std::vector<FrameworkElement*> executables;
};

void Search(FrameworkElement& element, Found& found) {
  if (element.life_cycle() == LifeCycle::kDeleted) return;
  if (auto* const container = dynamic_cast<ThreadContainer*>(&element)) {
    found.containers.push_back(container);
  }
  if (element.life_cycle() == LifeCycle::kReady && element.FindAnnotation<Executable>()) {
    found.executables.push_back(&element);
  }
  for (FrameworkElement* child : element.children()) Search(*child, found);
}

std::vector<InputBase*> TriggerInputs(const std::vector<Task>& tasks) {
  std::vector<InputBase*> inputs;
  for (const Task& task : tasks) {
    for (const FrameworkElement* group : task.reads) {
      if (group == nullptr) continue;
      internal::VisitPorts(*group, [&](Port& port) {
        auto* const input = dynamic_cast<InputBase*>(&port);
        if (input != nullptr && input->is_trigger()) inputs.push_back(input);
      });
    }
  }
  return inputs;
}

ThreadContainer* ChooseContainer(const FrameworkElement& element, const Found& found,
                                 const std::string& default_thread) {
  const auto by = [&](auto&& is_it) -> ThreadContainer* {
    const auto at = std::ranges::find_if(found.containers, is_it);
    return at == found.containers.end() ? nullptr : *at;
  };
  const std::uint64_t assigned = AssignedThread(element);
  if (auto* chosen = by([&](auto* each) { return each->serial() == assigned; })) return chosen;
  if (auto* chosen = by([&](auto* each) { return each->name() == default_thread; })) return chosen;
  return found.containers.empty() ? nullptr : found.containers.front();
}

// Whether nobody has said which of several threads is to run it.
bool IsAChoiceMissing(const FrameworkElement& element, const Found& found,
                      const std::string& default_thread) {
  if (found.containers.size() < 2) return false;
  const std::uint64_t assigned = AssignedThread(element);
  return std::ranges::none_of(found.containers, [&](const auto* each) {
    return each->serial() == assigned || each->name() == default_thread;
  });
}

Error ChosenForIt(const FrameworkElement& element, const ThreadContainer& container) {
  return {.message = "is assigned to no thread, and there are several; " + container.path() +
                     " runs it, as it was made first",
          .path = element.path(),
          .hint = "assign it, or a group that it is in, to one of the threads"};
}

// Data that came before the element was tied count as new. What another runner has been told of and
// not run yet, this one is told of again.
void Tie(const std::vector<InputBase*>& inputs, ScheduledElement& state, CycleRunner& runner) {
  const bool was_tied = state.runner() != nullptr;
  state.set_runner(&runner);
  bool has_data = false;
  for (InputBase* input : inputs) {
    input->SetWaker(&state);
    has_data = input->LookAtValue([](const void*, Time) {}) || has_data;
  }
  if ((has_data && !was_tied) || state.is_activated()) state.Wake();
}

void Untie(const std::vector<InputBase*>& inputs) {
  for (InputBase* input : inputs) input->SetWaker(nullptr);
}

std::vector<CycleRunner*> WaitingRunners(const std::vector<ThreadContainer*>& containers) {
  std::vector<CycleRunner*> waiting;
  for (const ThreadContainer* container : containers) {
    if (container->runner()->waits_for_data()) waiting.push_back(container->runner().get());
  }
  return waiting;
}

void MarkFirstAndLast(std::vector<Schedule::Entry>& entries) {
  for (std::size_t i = 0; i < entries.size(); ++i) {
    for (std::size_t later = i + 1; later < entries.size(); ++later) {
      if (entries[i].element != entries[later].element) continue;
      entries[i].is_last = false;
      entries[later].is_first = false;
    }
  }
}

}  // namespace

CompiledSchedules ScheduleCompiler::Compile(FrameworkElement& root) {
  Found found;
  Search(root, found);
  std::ranges::sort(found.containers, {}, &FrameworkElement::serial);
  std::ranges::sort(found.executables, {}, &FrameworkElement::serial);

  CompiledSchedules result;
  ++compilations_;
  std::map<const ThreadContainer*, std::vector<Task>> tasks_of;
  for (FrameworkElement* element : found.executables) {
    ThreadContainer* const container = ChooseContainer(*element, found, default_thread_);
    if (container == nullptr) {
      result.has_unassigned_tasks = true;
      continue;
    }
    HandOver(*element, *container);
    std::vector<Task> tasks = element->FindAnnotation<Executable>()->tasks();
    TieToContainer(*element, tasks, *container, result.warnings);
    if (IsAChoiceMissing(*element, found, default_thread_)) {
      result.warnings.push_back(ChosenForIt(*element, *container));
    }
    std::ranges::move(tasks, std::back_inserter(tasks_of[container]));
  }
  const std::vector<CycleRunner*> waiting = WaitingRunners(found.containers);
  for (const ThreadContainer* container : found.containers) {
    auto schedule = MakeSchedule(std::move(tasks_of[container]), result.warnings);
    schedule->number = compilations_;
    schedule->installation = result.installation;
    schedule->waiting = waiting;
    result.threads.push_back({container->runner(), std::move(schedule)});
  }
  return result;
}

// The runner that has had the element until now may be in a cycle with it, and so may those before.
void ScheduleCompiler::HandOver(const FrameworkElement& element, const ThreadContainer& container) {
  State& state = StateOf(element);
  const std::shared_ptr<const CyclePresence> next = container.runner()->presence();
  if (state.current == next) return;
  std::erase_if(state.before, [&](const Before& each) { return each.presence == next; });
  if (state.current) state.before.push_back({state.current});
  state.current = next;
}

void ScheduleCompiler::OnInstalled(std::uint64_t epoch) {
  for (auto& [serial, state] : states_) {
    std::erase_if(state.before, [epoch](Before& each) {
      if (each.until == 0) each.until = epoch;
      return each.presence->HasLeft(each.until);
    });
  }
}

void ScheduleCompiler::TieToContainer(const FrameworkElement& element,
                                      const std::vector<Task>& tasks,
                                      const ThreadContainer& container,
                                      std::vector<Error>& warnings) {
  const std::vector<InputBase*> inputs = TriggerInputs(tasks);
  ScheduledElement& state = *StateOf(element).element;
  if (!container.runner()->waits_for_data()) {
    Untie(inputs);
    state.set_runner(nullptr);
    return;
  }
  Tie(inputs, state, *container.runner());
  if (!inputs.empty()) return;
  warnings.push_back(
      {.message = "is never run: its thread " + container.path() +
                  " waits for data, and it has no trigger input",
       .path = element.path(),
       .hint = "assign it to a periodic thread, or make an input with .trigger = true"});
}

std::unique_ptr<Schedule> ScheduleCompiler::MakeSchedule(std::vector<Task> tasks,
                                                         std::vector<Error>& warnings) {
  ExecutionOrder order = OrderTasks(std::move(tasks));
  auto schedule = std::make_unique<Schedule>();
  for (Task& task : order.tasks) {
    const State& state = StateOf(*task.element);
    schedule->entries.push_back({std::move(task.run), state.element, task.phase});
    for (const Before& each : state.before) {
      schedule->entries.back().before.push_back(each.presence);
    }
  }
  MarkFirstAndLast(schedule->entries);
  std::ranges::move(order.cuts, std::back_inserter(warnings));
  return schedule;
}

void ScheduleCompiler::Release(FrameworkElement& element) {
  element.Visit([this](FrameworkElement& each) {
    const auto* const executable = each.FindAnnotation<Executable>();
    if (executable == nullptr) return;
    Untie(TriggerInputs(executable->tasks()));
    const auto found = states_.find(each.serial());
    if (found == states_.end()) return;
    // A publisher may still be about to wake it.
    Retire([state = std::move(found->second.element)] {});
    states_.erase(found);
  });
}

ScheduleCompiler::State& ScheduleCompiler::StateOf(const FrameworkElement& element) {
  State& state = states_[element.serial()];
  if (!state.element) {
    state.element = std::make_shared<ScheduledElement>(element.path(), element.serial());
  }
  return state;
}

}  // namespace runnel
