#include "core/module/sense_control_module.h"

#include "core/module/executable.h"
#include "core/module/port_group.h"

namespace runnel {

SenseControlModule::SenseControlModule(const Placement& placement) : Module(placement, NoTasks{}) {
  Annotate(std::make_unique<Executable>([this]() -> std::vector<Task> {
    return {{this, Phase::kSense, [this] { Sense(); }, {groups_[0].get()}, {groups_[1].get()}},
            {this, Phase::kControl, [this] { Control(); }, {groups_[2].get()}, {groups_[3].get()}}};
  }));
}

SenseControlModule::~SenseControlModule() = default;

}  // namespace runnel
