#pragma once

#include <memory>

#include "core/base/clock.h"
#include "core/element/framework_element.h"
#include "core/log/logger.h"
#include "core/module/kept_state.h"
#include "core/port/port_owner.h"

namespace runnel {

class PortGroup;

/// A component: ports and parameters as public members, and one function that is called in each
/// cycle.
///
///     class Doubler final : public runnel::Module {
///      public:
///       using Module::Module;
///       Input<double> value{this, "value"};
///       Output<double> doubled{this, "doubled"};
///
///      private:
///       void Update() override {
///         if (const auto read = value.Read(); read.is_new()) doubled.Publish(2 * *read);
///       }
///     };
///
/// Life:        constructed (no side effects, please: tools make instances just to list the ports), then
///              Prepare(): parameters are set; open files, reserve memory, say what is wrong; then
///              Update() again and again; then the destructor.
/// Threads:     Update() is called by one thread at a time. Prepare() and the destructor never run
///              at the same time as Update().
/// Errors:      an exception out of Update() stops this module alone and is reported with its path.
/// Allocation:  Update() should neither allocate, lock, nor call the system.
/// Source:      FINROC's modules.
class Module : public FrameworkElement, public PortOwner {
 public:
  explicit Module(const Placement& placement);
  ~Module() override;

  [[nodiscard]] FrameworkElement& InputGroup() override;
  [[nodiscard]] FrameworkElement& OutputGroup() override;

 protected:
  virtual void Update() = 0;

  /// The time of the current cycle; outside of one, that of the runtime's clock.
  [[nodiscard]] Time now() const noexcept;
  /// What the module says to people: `log().Warn("no echo for {} s", seconds);`
  [[nodiscard]] Logger& log() noexcept { return log_; }
  /// Planned time from cycle to cycle; 0 outside of a cycle or without a plan.
  [[nodiscard]] static Duration period() noexcept;

  /// For module kinds with other groups than "input" and "output": makes the group when first
  /// asked.
  [[nodiscard]] FrameworkElement& LazyGroup(std::unique_ptr<PortGroup>& group, const char* name);

  /// In the constructor: what a module that replaces this one, or that this one replaces, takes over if
  /// it keeps a state of the same type: a goal, a mode, what has been seen. Copied between two cycles,
  /// after Prepare(). `state` is a member of the module.
  template <typename State>
  void KeepState(State& state) {
    auto* kept = FindAnnotation<KeptState>();
    if (kept == nullptr) kept = &Annotate(std::make_unique<KeptState>());
    kept->Add(state);
  }

  struct NoTasks {};
  /// For module kinds that annotate their own tasks.
  Module(const Placement& placement, NoTasks);

 private:
  Logger log_{*this};
  std::unique_ptr<PortGroup> input_group_;
  std::unique_ptr<PortGroup> output_group_;
};

}  // namespace runnel
