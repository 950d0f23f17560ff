#pragma once

#include <optional>
#include <utility>

#include "core/module/module.h"
#include "core/port/input.h"
#include "core/port/output.h"
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

  Result<void> Prepare() override {
    const auto reserve = [](HitAndLeavePoints& each) {
      each.hits.reserve(kMostPoints);
      each.leaves.reserve(kMostPoints);
    };
    reserve(points_);
    points.PrepareBuffers(reserve);
    return {};
  }

  // Within what the list has reserved.
  static void Append(std::vector<Point2>& list, Point2 point) {
    if (list.size() == list.capacity()) list.erase(list.begin());
    list.push_back(point);
  }

  void Note(bool is_round, Point2 place) {
    if (is_round == (told_.mode == PlannerMode::kFollowingBoundary)) return;
    if (is_round) {
      ++told_.hits;
      told_.hit_point = place;
      Append(points_.hits, place);
    } else {
      ++told_.leaves;
      told_.leave_point = place;
      Append(points_.leaves, place);
    }
    auto loan = points.Loan();
    if (!loan) return;
    *loan = points_;  // within what its lists have reserved
    points.Publish(std::move(loan));
  }

  void Update() override {
    const auto here = pose_timeout.Read(pose, now());
    const auto there = goal.Read();
    const auto rating = content_timeout.Read(content, now());
    const auto round = detour_timeout.Read(detour, now());
    if (!here || !there || !rating || (detour.is_bound() && !round)) return;
    const Point2 place = Position(*here);
    if (last_goal_ != std::optional(*there)) {
      told_ = {};
      points_.hits.clear();
      points_.leaves.clear();
      last_goal_ = *there;
      last_place_.reset();
    }
    if (const auto before = std::exchange(last_place_, place)) told_.path_length += Distance(*before, place);
    told_.distance_to_goal = Distance(place, *there);
    const bool is_round = round && round->value() > 0.0;
    Note(is_round, place);
    told_.mode = is_round                 ? PlannerMode::kFollowingBoundary
                 : rating->value() == 0.0 ? PlannerMode::kReached
                                          : PlannerMode::kMotionToGoal;
    status.Publish(told_);
  }

  PlannerStatus told_;
  std::optional<Point2> last_place_;
  std::optional<Point2> last_goal_;
  HitAndLeavePoints points_;
};

}  // namespace runnel
