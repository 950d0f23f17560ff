#pragma once

#include <functional>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/element/annotation.h"
#include "core/element/framework_element.h"
#include "core/module/executable.h"
#include "plugins/scheduling/cycle_runner.h"
#include "plugins/scheduling/schedule.h"
#include "plugins/scheduling/scheduled_element.h"
#include "plugins/task_order/running_order.h"

namespace runnel {
class InputBase;
class Port;
}  // namespace runnel

namespace runnel::internal {

struct ThreadSchedule;

/// One task of an element, in the order of its thread.
struct PlannedTask : OrderedTask {
  explicit PlannedTask(Task of_element) : task(std::move(of_element)) { phase = task.phase; }
  Task task;
  struct PlannedElement* element = nullptr;
  bool is_first = false;  ///< of its element's
  bool is_last = false;
};

/// What is known of one element that has tasks.
struct PlannedElement {
  FrameworkElement* element = nullptr;
  std::shared_ptr<ScheduledElement> state;
  std::shared_ptr<const CycleQuiescence> current;  ///< of the runner that has it
  std::vector<Schedule::Before> before;            ///< runners that may still be running it
  ThreadSchedule* thread = nullptr;                ///< nullptr: in no plan
  std::vector<std::unique_ptr<PlannedTask>> tasks;
};

/// One thread: what it runs, and in which order.
struct ThreadSchedule {
  explicit ThreadSchedule(std::shared_ptr<CycleRunner> cycle_runner) : runner(std::move(cycle_runner)) {}

  const std::shared_ptr<CycleRunner> runner;
  std::string name;             ///< of the container
  TraceTrack* track = nullptr;  ///< nullptr: nothing is written down
  bool is_changed = false;      ///< since the last schedule
  bool is_paused = false;       ///< the container is, with all that it runs
  RunningOrder order;
};

/// Which tasks read and write through which groups of ports.
class TasksOfGroups {
 public:
  void Add(PlannedTask& task) {
    Each(task, [&](auto& list) { list.push_back(&task); });
  }
  void Remove(PlannedTask& task) {
    Each(task, [&](auto& list) { std::erase(list, &task); });
  }
  void Clear() { groups_.clear(); }

  /// Calls `visit` with each task that publishes through `output` and each that reads `input`, of one thread.
  template <typename Visit>
  void ForEachPair(const FrameworkElement& output, const FrameworkElement& input, const Visit& visit) const {
    ForEach(output, &Tasks::writers, [&](PlannedTask& writer) {
      ForEach(input, &Tasks::readers, [&](PlannedTask& reader) {
        if (writer.element->thread == reader.element->thread) visit(writer, reader);
      });
    });
  }

 private:
  struct Tasks {
    std::vector<PlannedTask*> readers;
    std::vector<PlannedTask*> writers;
  };

  template <typename Change>
  void Each(PlannedTask& task, const Change& change) {
    for (const FrameworkElement* group : task.task.reads) Each(group, &Tasks::readers, change);
    for (const FrameworkElement* group : task.task.writes) Each(group, &Tasks::writers, change);
  }
  template <typename Change>
  void Each(const FrameworkElement* group, std::vector<PlannedTask*> Tasks::*which, const Change& change) {
    if (group == nullptr) return;
    Tasks& tasks = groups_[group];
    change(tasks.*which);
    if (tasks.readers.empty() && tasks.writers.empty()) groups_.erase(group);
  }
  template <typename Visit>
  void ForEach(const FrameworkElement& port, std::vector<PlannedTask*> Tasks::*which, const Visit& visit) const {
    for (const FrameworkElement* at = &port; at != nullptr; at = at->parent()) {
      const auto found = groups_.find(at);
      if (found == groups_.end()) continue;
      for (PlannedTask* task : found->second.*which) visit(*task);
    }
  }

  // Only looked up, never walked through: the order of addresses has no influence.
  std::unordered_map<const FrameworkElement*, Tasks> groups_;
};

/// Calls `visit` for every port below `group`, in the order of their creation; nullptr: for none.
void VisitPorts(const FrameworkElement* group, const std::function<void(Port&)>& visit);

/// Of all that the tasks read, the inputs at which new data set an element off.
[[nodiscard]] std::vector<InputBase*> TriggerInputs(const std::vector<Task>& tasks);

/// New data at `inputs`, and what else sets it off (WakeSource), set off the element, in `runner`'s thread; nullptr: they
/// set off nobody any more. Data that came before it was tied count as new. What has come by then, the runner finds when
/// a schedule with the element is installed.
void BindTriggers(const FrameworkElement& element, const std::vector<InputBase*>& inputs, ScheduledElement& state,
                  CycleRunner* runner);

/// That somebody has paused the element, or lets it run again. It goes along with the element's other annotations.
struct PauseMark final : Annotation {
  explicit PauseMark(bool is_it) : is_paused(is_it) {}
  [[nodiscard]] std::unique_ptr<Annotation> ForReplacement() const override {
    return std::make_unique<PauseMark>(is_paused);
  }
  /// Not of what is above it.
  [[nodiscard]] static bool IsAt(const FrameworkElement& element) {
    const auto* const mark = element.FindAnnotation<PauseMark>();
    return mark != nullptr && mark->is_paused;
  }

  const bool is_paused;
};

}  // namespace runnel::internal
