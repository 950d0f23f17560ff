#include "modules/simulation/simulated_world.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "modules/simulation/algorithm/outline.h"
#include "modules/simulation/algorithm/world_geometry.h"
#include "modules/simulation/world_file/world_file.h"

namespace runnel {

const ParameterOptions<double> SimulatedWorld::kGoalOfFile{.default_value = std::numeric_limits<double>::quiet_NaN(),
                                                           .unit = "m",
                                                           .description = "of the goal; nan: as the world file has it"};

SimulatedWorld::SimulatedWorld(const Placement& placement) : SenseControlModule(placement) {}
SimulatedWorld::~SimulatedWorld() = default;

Result<void> SimulatedWorld::Prepare() {
  if (world.Get().empty()) {
    return Error{.message = "no world file is named", .path = path(), .hint = "set the parameter 'world'"};
  }
  const auto file = FindWorldFile(world.Get().text);
  if (!file) return file.error().WithPath(path());
  Diagnostics diagnostics;
  auto description = ReadWorldFile(*file, diagnostics);
  if (!description) {
    return Error{.message = "the world cannot be used:\n" + diagnostics.ToString(), .path = path()};
  }
  const double room = ClearanceAt(*description, Position(description->start));
  if (room < robot_radius.Get()) {
    return Error{.message = "the robot does not fit where it starts: it is " + TextOf(room) +
                            " m from an obstacle, and its radius is " + robot_radius.ToText() + " m",
                 .path = path(),
                 .position = {world.Get().text},
                 .hint = "move <start> or the obstacle"};
  }
  PhysicsOptions options;
  options.step = step.Get();
  options.robot.radius = robot_radius.Get();
  options.robot.maximum_speed = maximum_speed.Get();
  options.robot.maximum_turn_rate = maximum_turn_rate.Get();
  description_ = std::make_shared<const World>(std::move(*description));
  physics_ = std::make_unique<PhysicsWorld>(*description_, options);
  // The robot's sensors sit on its lid.
  const double eye_height = options.robot.ground_clearance + options.robot.height;
  scene_ = {description_, std::make_shared<const RayCaster>(OutlineOf(*description_), eye_height),
            options.robot.radius};
  map_of_world_ = MapOf(*description_);
  map.PrepareBuffers([this](WorldMap& buffer) { buffer = map_of_world_; });
  return {};
}

void SimulatedWorld::Sense() {
  if (last_) AdvanceTo(now());
  last_ = now();
  PublishTruth();
}

// A base that has not run for some time has not driven on all the while: its own time-out counts, and a STOP.
void SimulatedWorld::AdvanceTo(Time end) {
  const Time stands =
      wheels.is_stopped() ? *last_ : std::max(*last_, commanded_ + FromSeconds(wheels_timeout.limit.Get()));
  if (end > stands) {
    physics_->Advance(ToSeconds(stands - *last_));
    physics_->SetWheelSpeeds({});
    last_ = stands;
  }
  physics_->Advance(ToSeconds(end - *last_));
}

// What is disconnected for less than the time-out, as in a swap that takes several steps, is not noticed.
void SimulatedWorld::Control() {
  if (const auto wanted = wheels_timeout.Read(wheels, now())) {
    commanded_ = wanted.timestamp();
    physics_->SetWheelSpeeds(*wanted);
    return;
  }
  const bool is_gone = wheels_timeout.lack() == InputLack::kNeverCame;
  if (!is_gone || now() - commanded_ > FromSeconds(wheels_timeout.limit.Get())) physics_->SetWheelSpeeds({});
}

void SimulatedWorld::PublishTruth() {
  // Once is enough: whoever is connected later gets the last value, too.
  if (scene.publications() == 0) scene.Publish(scene_);
  pose.Publish(physics_->pose());
  twist.Publish(physics_->twist());
  contact.Publish(physics_->contact());
  const double x = goal_x.Get(), y = goal_y.Get();
  const Point2 goal_now{std::isnan(x) ? description_->goal.x : x, std::isnan(y) ? description_->goal.y : y};
  goal.Publish(goal_now);
  if (goal_on_map_ != goal_now) PublishMap(goal_now);
}

// The buffers have the map already, so copying it into one allocates nothing; but for those of a
// world that this one has taken the place of.
void SimulatedWorld::PublishMap(Point2 goal_now) {
  auto loan = map.Loan();
  if (!loan) return;  // viewers hold all that there are; tried again in the next cycle
  *loan = map_of_world_;
  loan->goal = goal_now;
  map.Publish(std::move(loan));
  goal_on_map_ = goal_now;
}

}  // namespace runnel
