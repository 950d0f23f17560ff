#include "core/plugin/plugin_entry.h"
#include "modules/motion/command_gate.h"
#include "modules/motion/differential_drive.h"

RUNNEL_PLUGIN(motion, registry) {
  using namespace runnel;
  registry.Add<CommandGate>("motion/command_gate",
                            "stops the robot when commands fail to come or something is touched");
  registry.Add<DifferentialDriveModule>("motion/differential_drive",
                                        "turns wanted motion into wheel speeds, within limits");
}
