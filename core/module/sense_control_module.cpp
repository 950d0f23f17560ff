#include "core/module/sense_control_module.h"

#include "core/base/check.h"
#include "core/module/executable.h"
#include "core/module/group.h"
#include "core/port/cycle.h"

namespace runnel {

SenseControlModule::SenseControlModule(const Placement& placement) : Module(placement, NoTasks{}) {
  Annotate(std::make_unique<Executable>([this]() -> std::vector<Task> {
    const BoundCall sense = ListensToParameters() ? BoundCall::To<&SenseControlModule::TellAndSense>(*this)
                                                  : BoundCall::To<&SenseControlModule::SenseAndNote>(*this);
    return {{this, Phase::kSense, sense, AsTaskGroups(groups_[0]), AsTaskGroups(groups_[1])},
            {this, Phase::kControl, BoundCall::To<&SenseControlModule::AgeAndControl>(*this), AsTaskGroups(groups_[2]),
             AsTaskGroups(groups_[3])}};
  }));
}

SenseControlModule::~SenseControlModule() = default;

void SenseControlModule::TellAndSense() {
  TellOfParameters();
  SenseAndNote();
}

void SenseControlModule::SenseAndNote() {
  Sense();
  const Cycle* const cycle = CurrentCycle();
  sensed_ = cycle != nullptr ? cycle->stamp : Time::max();
}

void SenseControlModule::AgeAndControl() {
  internal::AgeCycle(sensed_);
  Control();
}

FrameworkElement& SenseControlModule::InputGroup() {
  ThrowProgrammingError("an input of a sense/control module is one of two kinds",
                        "write sensor_inputs() or controller_inputs() in place of this");
}

FrameworkElement& SenseControlModule::OutputGroup() {
  ThrowProgrammingError("an output of a sense/control module is one of two kinds",
                        "write sensor_outputs() or controller_outputs() in place of this");
}

}  // namespace runnel
