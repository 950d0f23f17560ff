#pragma once

#include <string>

#include "core/module/module.h"
#include "plugins/genom_execution/component_table.h"
#include "plugins/genom_modules/wake_target.h"

namespace runnel {
class ThreadContainer;
}

namespace runnel::genom_modules {

class ComponentModule;

/// An execution task of a component that another thread runs than that of the component's module: below the module, so
/// that schedules, pauses, figures and swaps know it. What its codels throw is the module's fault.
///
/// Errors: Prepare() says if there is no such thread, or if its period does not divide the task's.
class TaskModule final : public Module {
 public:
  /// `target`: of the component, which outlives it.
  TaskModule(const Placement& placement, ComponentModule& component, std::size_t number, std::string thread,
             WakeTarget& target);

 private:
  Result<void> Prepare() override;
  void Update() override;
  [[nodiscard]] Result<void> Check(const ThreadContainer& thread) const;

  ComponentModule& component_;
  const std::size_t number_;  // of the task
  const std::string thread_;
};

/// "task 'drive' has a period …", if cycles of that period do not meet its ticks; else "".
[[nodiscard]] std::string MissedTicks(const genom_execution::TaskTable& task, Duration cycle);

}  // namespace runnel::genom_modules
