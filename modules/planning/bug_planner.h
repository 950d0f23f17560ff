#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "core/module/module.h"
#include "core/port/input.h"
#include "core/port/output.h"
#include "core/types/builtin_types.h"
#include "core/types/type_of.h"
#include "modules/planning/algorithm/bug_algorithm.h"
#include "modules/planning/algorithm/bug_components.h"
#include "modules/planning/algorithm/bug_state.h"
#include "modules/planning/algorithm/bug_variants.h"
#include "modules/types/drawing.h"
#include "modules/types/planner_status.h"
#include "modules/types/pose.h"
#include "modules/types/surroundings.h"
#include "plugins/parameters/input_timeout.h"
#include "plugins/parameters/parameter.h"
#include "plugins/parameters/prepares_anywhere.h"

namespace runnel {

inline void Describe(TypeBuilder<BoundaryDirection>& type) {
  type.Name("BoundaryDirection").Values<BoundaryDirection::kLeft, BoundaryDirection::kRight>();
}

/// The values of `Kind` bear the names of the components, which are in the same order.
template <typename Kind, typename Components>
void DescribeKinds(TypeBuilder<Kind>& type, const char* name, const Components& components) {
  type.Name(name);
  for (std::size_t i = 0; i < components.size(); ++i) {
    type.Value(std::string(components[i]->name()), static_cast<Kind>(i));
  }
}

inline void Describe(TypeBuilder<MotionKind>& type) { DescribeKinds(type, "MotionKind", AllMotions()); }
inline void Describe(TypeBuilder<DirectionKind>& type) { DescribeKinds(type, "DirectionKind", AllDirections()); }
inline void Describe(TypeBuilder<LeaveKind>& type) { DescribeKinds(type, "LeaveKind", AllLeaveConditions()); }
inline void Describe(TypeBuilder<RevisitKind>& type) { DescribeKinds(type, "RevisitKind", AllRevisits()); }

// What a planner remembers, field by field, so that it can go on in a library that was built anew. A field that is
// missing here is lost then.

/// Names the parts that only their classes know.
struct KeptFields {
  static void Describe(TypeBuilder<PointHistory>& type) {
    type.Name("PointHistory").Fields<&PointHistory::points_, &PointHistory::total_, &PointHistory::size_>();
  }
  static void Describe(TypeBuilder<FacedHeadings>& type) {
    type.Name("FacedHeadings")
        .Fields<&FacedHeadings::place_, &FacedHeadings::heading_, &FacedHeadings::left_, &FacedHeadings::right_>();
  }
  static void Describe(TypeBuilder<WallFollower>& type) {
    type.Name("WallFollower")
        .Fields<&WallFollower::direction_, &WallFollower::is_turning_, &WallFollower::target_heading_,
                &WallFollower::is_cautious_, &WallFollower::turning_place_, &WallFollower::turn_sign_,
                &WallFollower::is_looking_, &WallFollower::looked_round_, &WallFollower::look_to_,
                &WallFollower::last_heading_, &WallFollower::contact_bearing_>();
  }
  using Gate = Lap::Gate;
  static void Describe(TypeBuilder<Gate>& type) {
    type.Name("Lap::Gate").Fields<&Gate::pose, &Gate::length, &Gate::turned>();
  }
  static void Describe(TypeBuilder<Lap>& type) {
    type.Name("Lap")
        .Fields<&Lap::hit_, &Lap::last_, &Lap::gate_, &Lap::second_gate_, &Lap::has_gate_, &Lap::is_complete_,
                &Lap::is_circling_, &Lap::length_, &Lap::turned_>();
  }
};

template <typename T>
requires requires(TypeBuilder<T>& type) { KeptFields::Describe(type); }
void Describe(TypeBuilder<T>& type) { KeptFields::Describe(type); }

inline void Describe(TypeBuilder<Approach>& type) {
  type.Name("Approach").Values<Approach::kNear, Approach::kAlongBoundary, Approach::kAcross, Approach::kBack>();
}

inline void Describe(TypeBuilder<BugState>& type) {
  type.Name("BugState")
      .Fields<&BugState::status, &BugState::has_task, &BugState::start, &BugState::goal, &BugState::composition,
              &BugState::last_pose, &BugState::last_twist, &BugState::still_pose, &BugState::commanded,
              &BugState::earlier_turn, &BugState::turning, &BugState::response, &BugState::hits, &BugState::leaves,
              &BugState::least_distance_of_all, &BugState::line_start, &BugState::least_distance_on_line,
              &BugState::last_leave_distance, &BugState::last_direction, &BugState::node_side, &BugState::second_looks,
              &BugState::doubted_hit_distance, &BugState::faced, &BugState::look, &BugState::look_back,
              &BugState::progress_point, &BugState::idle_time, &BugState::refused_at, &BugState::follower,
              &BugState::hit_distance, &BugState::least_distance, &BugState::followed_distance, &BugState::has_reversed,
              &BugState::has_doubted, &BugState::lap, &BugState::is_other_loop, &BugState::closest_point,
              &BugState::closest_distance, &BugState::closest_length, &BugState::crossing, &BugState::leave_point,
              &BugState::approach, &BugState::is_last_chance, &BugState::way_to_leave_point,
              &BugState::is_on_last_stretch, &BugState::set_out_point, &BugState::is_off_boundary,
              &BugState::set_out_contact, &BugState::set_out_at>();
}

/// What all planners of the Bug family have in common: the ports, the parameters, the state. Which
/// components it is made of, a class derived from it says: BugPlannerOf for the published variants,
/// ComposedBugPlanner for what an application file puts together, or one of your own.
///
/// One step for each new view of the surroundings; without one, or without a pose of about the same
/// time, the planner is silent, so that whoever guards the drive notices. The task begins where the
/// robot is when the goal comes, and anew with every other goal.
///
/// All that is remembered is in one BugState, which is the same type for all variants: a planner that
/// is given the state of another one goes on where that one was.
///
/// Errors: Prepare() refuses components that do not fit together; Update() throws if they cannot do
/// with what the sensors tell (free_range_step with a bumper), which stops the planner with a fault.
class BugPlanner : public Module, public PreparesAnywhere {
 public:
  explicit BugPlanner(const Placement& placement) : Module(placement) { KeepState(state_); }

  Input<Surroundings> surroundings{this, "surroundings", Measured("what a sensor adaptor knows of the obstacles")};
  Input<Pose2> pose{this, "pose", Measured("of the robot, world's frame")};
  Input<Point2> goal{this, "goal", {.description = "world's frame", .required = true, .ageing = Ageing::kSetOnce}};
  Output<Twist2> twist{this, "twist", {.description = "how the robot shall move"}};
  Output<PlannerStatus> status{this, "status", {.description = "mode, distance, hit points …"}};
  Output<HitAndLeavePoints> points{
      this, "points", {.description = "all hit and leave points so far, whenever there is another one"}};
  Output<Drawing> drawing{this, "drawing", {.description = "what it has in mind, while somebody looks"}};

  Parameter<BoundaryDirection> first_direction{
      this,
      "first_direction",
      {.default_value = kDefaults.first_direction,
       .description = "which way it turns where it meets an obstacle, or the first one"}};
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
  /// Of a pose against the view, of which it is the place.
  InputTimeout pose_timeout{this, pose, {.seconds = 0.2, .log = &log()}};
  InputTimeout surroundings_timeout{this, surroundings, {.log = &log()}};

  /// What it remembers; for the thread that runs it, or while it does not run.
  [[nodiscard]] const BugState& state() const { return state_; }
  /// Makes it go on where another planner was.
  void TakeOver(const BugState& state) { state_ = state; }

 protected:
  static constexpr BugConfiguration kDefaults{};

  /// Asked in Prepare() and before each step: does not allocate.
  [[nodiscard]] virtual BugComponents Components() const = 0;
  /// DistBug's STEP, for planners whose leave condition has one.
  void AddStep();
  Result<void> Prepare() override;

 private:
  void Update() override;
  void CheckSensors(const Surroundings& view);
  void PublishPoints();
  [[nodiscard]] BugConfiguration Configuration(double time_step) const;

  std::optional<Parameter<double>> step_;
  BugState state_;
  std::optional<Time> last_;
  std::size_t published_points_ = 0;
};

/// The planner module of a published variant, by its place in the table.
template <std::size_t variant>
class BugPlannerOf final : public BugPlanner {
 public:
  explicit BugPlannerOf(const Placement& placement) : BugPlanner(placement) {
    if constexpr (kRow.composition.leave == LeaveKind::kFreeRangeStep) AddStep();
  }

 private:
  static constexpr BugVariant kRow = kBugVariants[variant];

  [[nodiscard]] BugComponents Components() const override {
    BugComposition composition = kRow.composition;
    if (composition.direction == DirectionKind::kLeft && first_direction.Get() == BoundaryDirection::kRight) {
      composition.direction = DirectionKind::kRight;
    }
    return Assemble(composition);
  }
};

/// A planner composed in an application file, of one component of each kind.
class ComposedBugPlanner final : public BugPlanner {
 public:
  explicit ComposedBugPlanner(const Placement& placement) : BugPlanner(placement) { AddStep(); }

  StaticParameter<MotionKind> motion{
      this, "motion", {.default_value = MotionKind::kStraight, .description = "how it drives while nothing is near"}};
  StaticParameter<DirectionKind> direction{
      this, "direction", {.default_value = DirectionKind::kLeft, .description = "which way it turns at an obstacle"}};
  StaticParameter<LeaveKind> leave{
      this, "leave", {.default_value = LeaveKind::kBestAfterLap, .description = "where it leaves an obstacle"}};
  StaticParameter<RevisitKind> revisit{
      this, "revisit", {.default_value = RevisitKind::kNone, .description = "what it does where it was before"}};

 private:
  [[nodiscard]] BugComponents Components() const override {
    return Assemble({motion.Get(), direction.Get(), leave.Get(), revisit.Get()});
  }
};

}  // namespace runnel
