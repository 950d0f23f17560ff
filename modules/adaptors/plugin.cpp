#include "core/plugin/plugin_entry.h"
#include "modules/adaptors/sensors_to_surroundings.h"

RUNNEL_PLUGIN(adaptors, registry) {
  using namespace runnel;
  registry.Add<BumperToSurroundings>("adaptors/bumper",
                                     "what a bumper touches becomes what planners are told of the obstacles");
  registry.Add<LaserToSurroundings>("adaptors/laser", "laser scans become what planners are told of the obstacles");
  registry.Add<InfraredToSurroundings>("adaptors/infrared",
                                       "three infrared ranges become what planners are told of the obstacles");
}
