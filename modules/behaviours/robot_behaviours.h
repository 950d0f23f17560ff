#pragma once

#include <optional>

#include "modules/behaviours/algorithm/steering.h"
#include "modules/types/pose.h"
#include "modules/types/surroundings.h"
#include "plugins/behaviours/behaviour.h"
#include "plugins/parameters/input_timeout.h"

// The behaviours of a robot that drives to a goal. Each has its own idea of the motion; a fusion makes them one.

namespace runnel {

namespace internal {
inline constexpr const char* kObstacles = "what a sensor adaptor knows of the obstacles";
/// Of a parameter of both behaviours that ask whether the robot is there, since they must agree.
inline ParameterOptions<double> GoalTolerance(double tolerance, const char* description) {
  return {.default_value = tolerance, .bounds = {0.01, 10.0}, .unit = "m", .description = description};
}
}  // namespace internal

/// The parameters that all driving behaviours have.
struct SteeringParameters {
  explicit SteeringParameters(Behaviour* behaviour)
      : speed(behaviour, "speed",
              {.default_value = SteeringConfiguration{}.speed,
               .bounds = {0.01, 10.0},
               .unit = "m/s",
               .description = "at most"}),
        turn_limit(behaviour, "turn_limit",
                   {.default_value = SteeringConfiguration{}.turn_limit,
                    .bounds = {0.05, 20.0},
                    .unit = "rad/s",
                    .description = "how fast it turns at most"}) {}

  Parameter<double> speed;
  Parameter<double> turn_limit;

  [[nodiscard]] SteeringConfiguration Get() const { return {.speed = speed.Get(), .turn_limit = turn_limit.Get()}; }
};

inline void Describe(TypeBuilder<FirstTurn>& type) {
  type.Name("FirstTurn").Values<FirstTurn::kLeft, FirstTurn::kRight>();
}

inline void Describe(TypeBuilder<EscapeState>& type) {
  type.Name("EscapeState")
      .Fields<&EscapeState::has_goal, &EscapeState::goal, &EscapeState::position, &EscapeState::least_distance,
              &EscapeState::idle_time, &EscapeState::is_escaping, &EscapeState::stuck_distance>();
}

/// Straight to the goal. Content within the tolerance; active as long as it is not.
class DriveToGoalBehaviour final : public Behaviour {
 public:
  using Behaviour::Behaviour;

  Input<Pose2> pose{this, "pose", Measured("of the robot, world's frame")};
  Input<Point2> goal{this, "goal", {.description = "world's frame", .required = true, .ageing = Ageing::kSetOnce}};
  ControlOutput<Twist2> twist{this, "twist", {.description = "how the robot shall move"}};

  SteeringParameters steering{this};
  Parameter<double> goal_tolerance{
      this, "goal_tolerance",
      internal::GoalTolerance(DriveToGoalConfiguration{}.tolerance, "nearer than this is there")};
  InputTimeout pose_timeout{this, pose, {}};

 private:
  std::optional<Outcome> Behave(double activation) override;
};

/// Away from the nearest obstacle ahead: the more active the nearer it is.
class AvoidObstaclesBehaviour final : public Behaviour {
 public:
  using Behaviour::Behaviour;

  Input<Surroundings> surroundings{this, "surroundings", Measured(internal::kObstacles)};
  ControlOutput<Twist2> twist{this, "twist", {.description = "how the robot shall move"}};

  SteeringParameters steering{this};
  Parameter<double> near_distance{this,
                                  "near_distance",
                                  {.default_value = AvoidObstaclesConfiguration{}.near_distance,
                                   .bounds = {0.1, 10.0},
                                   .unit = "m",
                                   .description = "obstacles nearer than this disturb it"}};
  InputTimeout surroundings_timeout{this, surroundings, {}};

 private:
  std::optional<Outcome> Behave(double activation) override;
};

/// Along a wall, as active as it may be.
class FollowWallBehaviour final : public Behaviour {
 public:
  using Behaviour::Behaviour;

  Input<Surroundings> surroundings{this, "surroundings", Measured(internal::kObstacles)};
  ControlOutput<Twist2> twist{this, "twist", {.description = "how the robot shall move"}};

  SteeringParameters steering{this};
  Parameter<FirstTurn> first_direction{
      this,
      "first_direction",
      {.default_value = FirstTurn::kLeft, .description = "which way it turns where it meets a wall"}};
  InputTimeout surroundings_timeout{this, surroundings, {}};

 private:
  std::optional<Outcome> Behave(double activation) override;
};

/// Notices dead ends: the robot has not come nearer to its goal for a while. Active until the goal can be reached from
/// a place that is nearer: whom it stimulates gets the robot there. It commands nothing itself.
class EscapeBehaviour final : public Behaviour {
 public:
  explicit EscapeBehaviour(const Placement& placement) : Behaviour(placement) { KeepState(state_); }

  Input<Pose2> pose{this, "pose", Measured("of the robot, world's frame")};
  Input<Point2> goal{this, "goal", {.description = "world's frame", .required = true, .ageing = Ageing::kSetOnce}};
  Input<Surroundings> surroundings{this, "surroundings", Measured(internal::kObstacles)};

  Parameter<double> patience{this,
                             "patience",
                             {.default_value = EscapeConfiguration{}.patience,
                              .bounds = {0.1, 600.0},
                              .unit = "s",
                              .description = "without coming nearer, after which it is a dead end"}};
  Parameter<double> leave_margin{this,
                                 "leave_margin",
                                 {.default_value = EscapeConfiguration{}.margin,
                                  .bounds = {0.0, 10.0},
                                  .unit = "m",
                                  .description = "by which it ends nearer to the goal than it began"}};
  Parameter<double> goal_tolerance{
      this, "goal_tolerance",
      internal::GoalTolerance(EscapeConfiguration{}.tolerance, "nearer than this is there, as drive_to_goal has it")};
  InputTimeout pose_timeout{this, pose, {}};
  InputTimeout surroundings_timeout{this, surroundings, {}};

 private:
  std::optional<Outcome> Behave(double activation) override;

  EscapeState state_;
  std::optional<Time> last_;
};

/// Lets nothing pass but turning on the spot where the way ahead ends, and nothing at all while nobody looks, or it does not know
/// what the others want. With rangers of narrow view it slows down before what none has looked at, and looks there itself; by them
/// it needs to know where the robot is, too.
class EmergencyStopBehaviour final : public Behaviour {
 public:
  using Behaviour::Behaviour;

  Input<Surroundings> surroundings{this, "surroundings", Measured(internal::kObstacles)};
  Input<Twist2> wanted{this, "wanted", Measured("how the others want to move")};
  Input<Pose2> pose{
      this, "pose", {.description = "of the robot, for rangers of narrow view", .ageing = Ageing::kTimesOut}};
  ControlOutput<Twist2> twist{this, "twist", {.description = "standstill, turning on the spot, or slower than wanted"}};

  Parameter<double> least_way{this,
                              "least_way",
                              {.default_value = EmergencyStopConfiguration{}.least_way,
                               .bounds = {0.0, 10.0},
                               .unit = "m",
                               .description = "with less way ahead that is free it stops"}};
  InputTimeout surroundings_timeout{this, surroundings, {.former_name = "timeout"}};
  InputTimeout wanted_timeout{this, wanted, {}};
  InputTimeout pose_timeout{this, pose, {}};

 private:
  std::optional<Outcome> Behave(double activation) override;

  EmergencyStopState state_;
};

}  // namespace runnel
