#include "core/module/module.h"

#include "core/element/runtime.h"
#include "core/module/executable.h"
#include "core/module/group.h"
#include "core/port/cycle.h"

namespace runnel {

Module::Module(const Placement& placement, NoTasks) : FrameworkElement(placement, ElementKind::kModule) {}

Module::Module(const Placement& placement) : Module(placement, NoTasks{}) {
  Annotate(std::make_unique<Executable>([this]() -> std::vector<Task> {
    const BoundCall run =
        ListensToParameters() ? BoundCall::To<&Module::TellAndUpdate>(*this) : BoundCall::To<&Module::Update>(*this);
    return {{this, Phase::kUpdate, run, AsTaskGroups(input_group_), AsTaskGroups(output_group_)}};
  }));
}

Module::~Module() = default;

void Module::OnParametersChanged() {}

bool Module::ListensToParameters() {
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpmf-conversions"
#pragma GCC diagnostic ignored "-Wpedantic"
  using Function = void (*)(Module*);
  return (Function)(this->*&Module::OnParametersChanged) != (Function)&Module::OnParametersChanged;
#pragma GCC diagnostic pop
#else
  return true;
#endif
}

void Module::TellOfParameters() {
  // relaxed: the exchange looks again.
  if (!parameters_have_changed_.load(std::memory_order_relaxed)) return;
  // acquire: pairs with the release in NoteParameterChange(). What is noted from here on is told anew.
  (void)parameters_have_changed_.exchange(false, std::memory_order_acquire);
  OnParametersChanged();
}

void Module::TellAndUpdate() {
  TellOfParameters();
  Update();
}

FrameworkElement& Module::InputGroup() { return LazyGroup(input_group_, "input"); }
FrameworkElement& Module::OutputGroup() { return LazyGroup(output_group_, "output"); }

FrameworkElement& Module::LazyGroup(std::unique_ptr<PortGroup>& group, const char* name) {
  if (!group) group = std::make_unique<PortGroup>(Placement{*this, name});
  return *group;
}

Time Module::now() const noexcept {
  const Cycle* cycle = CurrentCycle();
  return cycle != nullptr ? cycle->now : runtime().clock().Now();
}

Duration Module::period() noexcept {
  const Cycle* cycle = CurrentCycle();
  return cycle != nullptr ? cycle->period : Duration::zero();
}

}  // namespace runnel
