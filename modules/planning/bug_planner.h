#pragma once

#include <optional>

#include "core/module/module.h"
#include "core/port/input.h"
#include "core/port/output.h"
#include "modules/planning/algorithm/bug_algorithm.h"
#include "modules/types/hit_and_leave_points.h"
#include "modules/types/planner_status.h"
#include "modules/types/pose.h"
#include "modules/types/surroundings.h"
#include "plugins/parameters/parameter.h"

namespace runnel {

inline void Describe(TypeBuilder<BoundaryDirection>& type) {
  type.Name("BoundaryDirection")
      .Value("left", BoundaryDirection::kLeft)
      .Value("right", BoundaryDirection::kRight);
}

/// What all planners of the Bug family have in common: the ports, the parameters, the state. A
/// variant is a class of its own (BugPlannerOf<Algorithm>), so that it is chosen by its name in an
/// application file.
///
/// One step for each new view of the surroundings; without one, or without a pose of about the same
/// time, the planner is silent, so that whoever guards the drive notices. The task begins where the
/// robot is when the goal comes, and anew with every other goal.
class BugPlanner : public Module {
 public:
  explicit BugPlanner(const Placement& placement) : Module(placement) {}

  Input<Surroundings> surroundings{
      this,
      "surroundings",
      {.description = "what a sensor adaptor knows of the obstacles", .required = true}};
  Input<Pose2> pose{this, "pose", {.description = "of the robot, world's frame", .required = true}};
  Input<Point2> goal{this, "goal", {.description = "world's frame", .required = true}};
  Output<Twist2> twist{this, "twist", {.description = "how the robot shall move"}};
  Output<PlannerStatus> status{this, "status", {.description = "mode, distance, hit points …"}};
  Output<HitAndLeavePoints> points{
      this,
      "points",
      {.description = "all hit and leave points so far, whenever there is another one"}};

  Parameter<BoundaryDirection> first_direction{
      this,
      "first_direction",
      {.default_value = kDefaults.first_direction,
       .description = "which way it turns where it meets an obstacle"}};
  Parameter<double> goal_tolerance{this,
                                   "goal_tolerance",
                                   {.default_value = kDefaults.goal_tolerance,
                                    .bounds = {0.01, 10.0},
                                    .unit = "m",
                                    .description = "nearer than this is there"}};
  Parameter<double> leave_margin{this,
                                 "leave_margin",
                                 {.default_value = kDefaults.leave_margin,
                                  .bounds = {0.0, 10.0},
                                  .unit = "m",
                                  .description = "by which a leave point must be nearer to the "
                                                 "goal than what it is compared with"}};
  Parameter<double> cruise_speed{this,
                                 "cruise_speed",
                                 {.default_value = kDefaults.driving.cruise_speed,
                                  .bounds = {0.01, 10.0},
                                  .unit = "m/s",
                                  .description = "towards the goal"}};
  Parameter<double> following_speed{this,
                                    "following_speed",
                                    {.default_value = kDefaults.driving.following_speed,
                                     .bounds = {0.01, 10.0},
                                     .unit = "m/s",
                                     .description = "along a boundary"}};
  Parameter<double> turn_limit{this,
                               "turn_limit",
                               {.default_value = kDefaults.driving.turn_limit,
                                .bounds = {0.05, 20.0},
                                .unit = "rad/s",
                                .description = "how fast it turns at most"}};
  Parameter<double> pose_timeout{this,
                                 "pose_timeout",
                                 {.default_value = 0.2,
                                  .bounds = {0.0, 60.0},
                                  .unit = "s",
                                  .description = "with a pose that is older by this than the view "
                                                 "of the surroundings, it is silent"}};

 protected:
  /// One update of the variant. Does not allocate.
  virtual BugOutput Plan(const BugConfiguration& configuration, BugState& state,
                         const BugInput& input) const = 0;

 private:
  static constexpr BugConfiguration kDefaults{};

  Result<void> Prepare() override;
  void Update() override;
  void PublishPoints();
  [[nodiscard]] BugConfiguration Configuration() const;

  BugState state_;
  std::optional<Point2> start_;
  Point2 goal_;
  Time last_{};
  std::size_t published_points_ = 0;
};

/// The planner module of one variant.
template <typename Algorithm>
class BugPlannerOf final : public BugPlanner {
 public:
  using BugPlanner::BugPlanner;

 private:
  BugOutput Plan(const BugConfiguration& configuration, BugState& state,
                 const BugInput& input) const override {
    return Algorithm(configuration).Update(state, input);
  }
};

}  // namespace runnel
