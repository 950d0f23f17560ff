#include "core/module/sense_control_module.h"

#include "core/module/executable.h"
#include "core/module/port_group.h"

namespace runnel {

SenseControlModule::SenseControlModule(const Placement& placement) : Module(placement, NoTasks{}) {
  Annotate(std::make_unique<Executable>([this]() -> std::vector<Task> {
    return {{this, Phase::kSense, [this] { Sense(); }, AsTaskGroups(groups_[0]),
             AsTaskGroups(groups_[1])},
            {this, Phase::kControl, [this] { Control(); }, AsTaskGroups(groups_[2]),
             AsTaskGroups(groups_[3])}};
  }));
}

SenseControlModule::~SenseControlModule() = default;

}  // namespace runnel
