#include "core/plugin/plugin_entry.h"
#include "modules/simulation/referee.h"
#include "modules/simulation/sensors.h"
#include "modules/simulation/simulated_world.h"

RUNNEL_PLUGIN(simulation, registry) {
  using namespace runnel;
  registry.Add<SimulatedWorld>("simulation/world", "a world from a file, with a robot in it");
  registry.Add<Laser>("simulation/laser", "a laser that looks ahead");
  registry.Add<Camera>("simulation/camera", "a camera that looks ahead");
  registry.Add<Infrared>("simulation/infrared", "infrared rangers ahead, to the left and right");
  registry.Add<Localisation>("simulation/localisation", "tells the robot where it is");
  registry.Add<Bumper>("simulation/bumper", "tells the robot that it touches something");
  registry.Add<Referee>("simulation/referee", "judges the run and draws the path");
}
