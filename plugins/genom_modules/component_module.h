#pragma once

#include <memory>
#include <vector>

#include "core/module/module.h"
#include "core/port/output.h"
#include "plugins/genom_modules/async_worker.h"
#include "plugins/genom_modules/component_service.h"
#include "plugins/genom_modules/component_state.h"
#include "plugins/genom_modules/module_part.h"

namespace runnel::genom_modules {

/// A component as a module: what the template `runnel` makes derives from it and adds ids, ports, services and
/// parameters. All tasks run in the cycle of the module, each at its ticks, so the period of the module's thread divides
/// theirs. Asynchronous codels are run by threads of their own; on a simulated clock the cycle waits for them, unless
/// they call others, so that each run is like the one before.
///
/// Life: the `start` codels of the tasks run in the first cycles. The destructor of the derived class calls End().
/// Errors: a `start` codel that raises an exception, or a permanent activity that ends by one, is the module's fault.
class ComponentModule : public Module {
 public:
  /// `ids` is a member of the derived class.
  ComponentModule(const Placement& placement, const genom_execution::ComponentTable& component, void* ids);

  [[nodiscard]] genom_execution::Engine& engine() noexcept { return engine_; }
  void AddPart(ModulePart& part) { parts_.push_back(&part); }
  using Module::log;

 protected:
  /// Derived classes that have their own call this one.
  Result<void> Prepare() override;
  void Update() override;
  /// Activities and tasks come to their end, as far as they do without time passing. Their answers are sent.
  void End() noexcept;

 private:
  [[nodiscard]] static genom_execution::EngineOptions Options(ComponentModule& self, void* ids);
  void CheckPeriods() const;
  void RunPasses(bool is_forced);
  void PublishState();

  genom_execution::Engine engine_;
  std::vector<ModulePart*> parts_;
  std::vector<std::unique_ptr<AsyncWorker>> workers_;  // by places; none without asynchronous codels
  bool has_run_ = false;
  bool is_broken_ = false;
  bool is_simulated_ = false;

 public:
  Output<ComponentState> genom_state;
  ComponentService<void()> kill;
  ComponentService<void(std::uint32_t)> abort_activity;
};

}  // namespace runnel::genom_modules
