#include "core/module/module.h"

#include "core/element/runtime.h"
#include "core/module/executable.h"
#include "core/module/port_group.h"
#include "core/port/cycle.h"

namespace runnel {

Module::Module(const Placement& placement, NoTasks)
    : FrameworkElement(placement, ElementKind::kModule) {}

Module::Module(const Placement& placement) : Module(placement, NoTasks{}) {
  Annotate(std::make_unique<Executable>([this]() -> std::vector<Task> {
    return {{this, Phase::kUpdate, BoundCall::To<&Module::Update>(*this), AsTaskGroups(input_group_),
             AsTaskGroups(output_group_)}};
  }));
}

Module::~Module() = default;

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
