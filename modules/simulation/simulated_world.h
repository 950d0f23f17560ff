#pragma once

#include <memory>
#include <optional>

#include "core/module/sense_control_module.h"
#include "core/port/input.h"
#include "core/port/output.h"
#include "modules/simulation/algorithm/physics_world.h"
#include "modules/simulation/scene.h"
#include "modules/types/drawing.h"
#include "modules/types/measurements.h"
#include "modules/types/pose.h"
#include "plugins/parameters/file_path.h"
#include "plugins/parameters/input_timeout.h"
#include "plugins/parameters/parameter.h"
#include "plugins/parameters/prepares_anywhere.h"

namespace runnel {

/// A world from a file, with a robot in it: wheel speeds go in, the truth about the robot comes
/// out. Sense() lets the time since the last cycle pass, with the wheel speeds that Control() took
/// over in the last cycle. A base whose commands fail to come, because what gives them is silent, gone or not
/// connected any more, comes to rest.
///
/// Frames:   all in the world's. Determinism: same file, parameters and cycle times, same bits.
/// Errors:   Prepare() says all that is wrong with the world file, with lines.
class SimulatedWorld final : public SenseControlModule, public PreparesAnywhere {
 public:
  explicit SimulatedWorld(const Placement& placement);
  ~SimulatedWorld() override;

  Input<WheelSpeeds> wheels{controller_inputs(), "wheels", Driving("what the wheels shall do")};
  Output<Scene> scene{sensor_outputs(), "scene", {.description = "what stands still"}};
  Output<Pose2> pose{sensor_outputs(), "pose", {.description = "where the robot really is"}};
  Output<Twist2> twist{sensor_outputs(), "twist", {.description = "how it really moves"}};
  Output<Contact> contact{sensor_outputs(), "contact", {.description = "whether it touches anything, and where"}};
  Output<Point2> goal{sensor_outputs(), "goal", {.description = "where it is to go"}};
  Output<WorldMap> map{
      sensor_outputs(),
      "map",
      {.description = "start, goal and obstacles, for those who draw", .pool = {.buffers = 4, .may_grow = false}}};

  StaticParameter<FilePath> world{
      this, "world", {.description = "the world file, or the name of one that comes with Runnel"}};
  Parameter<double> goal_x{this, "goal_x", kGoalOfFile};
  Parameter<double> goal_y{this, "goal_y", kGoalOfFile};
  /// Without newer wheel speeds for so long, the wheels come to rest.
  InputTimeout wheels_timeout{this, wheels, {.former_name = "timeout", .log = &log()}};
  StaticParameter<double> robot_radius{
      this, "robot_radius", {.default_value = 0.15, .bounds = {0.02, 2.0}, .unit = "m", .description = "of its body"}};
  StaticParameter<double> maximum_speed{
      this, "maximum_speed", {.default_value = 0.5, .bounds = {0.01, 10.0}, .unit = "m/s"}};
  StaticParameter<double> maximum_turn_rate{
      this, "maximum_turn_rate", {.default_value = 1.5, .bounds = {0.01, 20.0}, .unit = "rad/s"}};
  StaticParameter<double> step{
      this, "step", {.default_value = 0.005, .bounds = {0.0005, 0.05}, .unit = "s", .description = "of the physics"}};

 private:
  static const ParameterOptions<double> kGoalOfFile;

  Result<void> Prepare() override;
  void Sense() override;
  void Control() override;
  void PublishTruth();
  void AdvanceTo(Time end);
  void PublishMap(Point2 goal_now);

  std::shared_ptr<const World> description_;
  std::unique_ptr<PhysicsWorld> physics_;
  std::optional<Time> last_;
  Time commanded_{};  // the stamp of the wheel speeds that came last
  Scene scene_;
  WorldMap map_of_world_;
  std::optional<Point2> goal_on_map_;
};

}  // namespace runnel
