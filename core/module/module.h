#pragma once

#include <atomic>
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
///              Construct(): static parameters are set; make the ports that depend on them; then
///              Prepare(): open files, reserve memory, say what is wrong; then
///              OnParametersChanged() and Update(), the latter again and again; then the destructor.
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

  /// A parameter of this module has got another value: OnParametersChanged() is due. Any thread, wait-free. For
  /// those who make kinds of parameters.
  void NoteParameterChange() noexcept {
    // release: pairs with the acquire in TellOfParameters(): the new value is there.
    parameters_have_changed_.store(true, std::memory_order_release);
  }

 protected:
  virtual void Update() = 0;

  /// Called before the first cycle, and then before the cycle that follows a change of parameters, once for all
  /// that have changed since (whichever: their HasChanged()): compute here what depends on several. By the thread
  /// of the cycle and as part of it, so the rules for Update() hold. Modules without one pay nothing.
  virtual void OnParametersChanged();
  /// For module kinds that annotate their own tasks: calls OnParametersChanged() if it is due.
  void TellOfParameters();
  /// Whether there is an OnParametersChanged() to be called. Other compilers than GCC cannot tell: true.
  [[nodiscard]] bool ListensToParameters();

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
    FindOrAnnotate<KeptState>().Add(state);
  }

  struct NoTasks {};
  /// For module kinds that annotate their own tasks.
  Module(const Placement& placement, NoTasks);

 private:
  void TellAndUpdate();

  std::atomic<bool> parameters_have_changed_{true};
  Logger log_{*this};
  std::unique_ptr<PortGroup> input_group_;
  std::unique_ptr<PortGroup> output_group_;
};

}  // namespace runnel
