#pragma once

#include <optional>

#include "core/module/module.h"
#include "core/port/input.h"
#include "core/port/output.h"
#include "modules/types/hit_and_leave_points.h"
#include "modules/types/planner_status.h"
#include "modules/types/pose.h"
#include "plugins/behaviours/meta_signal.h"
#include "plugins/parameters/input_timeout.h"

namespace runnel {

/// Says in the words of planners how a network gets on: there when the behaviour that drives to the goal is content, round
/// something while another is active. A network does not know whether a goal can be reached at all, and never says that it cannot.
class PlannerStatusTeller final : public Module {
 public:
  explicit PlannerStatusTeller(const Placement& placement) : Module(placement) { RegisterMetaSignals(); }

  Input<Pose2> pose{this, "pose", Measured("of the robot, world's frame")};
  Input<Point2> goal{this, "goal", {.description = "world's frame", .required = true, .ageing = Ageing::kSetOnce}};
  Input<TargetRating> content{this, "content", Measured("of the behaviour that drives to the goal")};
  Input<Activity> detour{this, "detour", {.description = "of what leads round obstacles", .ageing = Ageing::kTimesOut}};
  InputTimeout pose_timeout{this, pose, {.log = &log()}};
  InputTimeout content_timeout{this, content, {.log = &log()}};
  InputTimeout detour_timeout{this, detour, {.log = &log()}};
  Output<PlannerStatus> status{this, "status", {.description = "as planners say it"}};
  Output<HitAndLeavePoints> points{
      this,
      "points",
      {.description = "where detours began and ended, the last of them, whenever there is another one"}};

 private:
  static constexpr std::size_t kMostPoints = 256;
  Result<void> Prepare() override;
  void Note(bool is_round, Point2 place);
  void Update() override;

  PlannerStatus told_;
  std::optional<Point2> last_place_;
  std::optional<Point2> last_goal_;
  HitAndLeavePoints points_;
};

}  // namespace runnel
