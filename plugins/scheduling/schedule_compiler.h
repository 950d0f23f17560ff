#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/element/runtime.h"
#include "plugins/scheduling/schedule.h"
#include "plugins/scheduling/thread_container.h"

namespace runnel {

/// All schedules of an application as it stands.
struct CompiledSchedules {
  struct Thread {
    std::shared_ptr<CycleRunner> runner;
    std::unique_ptr<Schedule> schedule;
  };
  std::vector<Thread> threads;  ///< in the order in which the containers were made
  /// Begins once all of them are in place; elements on their way from thread to thread wait for it.
  std::shared_ptr<Installation> installation = std::make_shared<Installation>();
  std::vector<Error> warnings;        ///< loops that were cut, modules that never run
  bool has_unassigned_tasks = false;  ///< there are tasks, but no container
};

/// Looks through the tree for tasks and thread containers, and makes a schedule for each container.
/// Keeps what outlives a schedule: the state of each element.
///
/// Threads:  all under the structure lock.
class ScheduleCompiler {
 public:
  /// Tasks that are assigned to no container go to the one called `default_thread`, or to the first
  /// if there is none of that name.
  explicit ScheduleCompiler(std::string default_thread)
      : default_thread_(std::move(default_thread)) {}

  /// Only elements that are ready are run. Ties the trigger inputs of elements to their states.
  CompiledSchedules Compile(FrameworkElement& root);

  /// The schedules of the last Compile() are in place; their installation has begun with `epoch`.
  void OnInstalled(std::uint64_t epoch);

  /// Unties the trigger inputs of all elements at or below `element`, and forgets their states; the
  /// next schedule must not contain them.
  void Release(FrameworkElement& element);

 private:
  // A runner that had the element and may still be running it.
  struct Before {
    std::shared_ptr<const CyclePresence> presence;
    std::uint64_t until = 0;  // the epoch that it has to reach; 0 while it still has the element
  };
  struct State {
    std::shared_ptr<ScheduledElement> element;
    std::shared_ptr<const CyclePresence> current;  // of the runner that has it
    std::vector<Before> before;
  };

  void HandOver(const FrameworkElement& element, const ThreadContainer& container);
  void TieToContainer(const FrameworkElement& element, const std::vector<Task>& tasks,
                      const ThreadContainer& container, std::vector<Error>& warnings);
  std::unique_ptr<Schedule> MakeSchedule(std::vector<Task> tasks, std::vector<Error>& warnings);
  State& StateOf(const FrameworkElement& element);

  const std::string default_thread_;
  std::map<std::uint64_t, State> states_;  // by serial
  std::uint64_t compilations_ = 0;
};

}  // namespace runnel
