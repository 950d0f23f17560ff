#include "modules/behaviours/planner_status_teller.h"

#include <utility>

namespace runnel {

namespace {

// Within what the list has reserved.
void Append(std::vector<Point2>& list, Point2 point) {
  if (list.size() == list.capacity()) list.erase(list.begin());
  list.push_back(point);
}

}  // namespace

Result<void> PlannerStatusTeller::Prepare() {
  const auto reserve = [](HitAndLeavePoints& each) {
    each.hits.reserve(kMostPoints);
    each.leaves.reserve(kMostPoints);
  };
  reserve(points_);
  points.PrepareBuffers(reserve);
  return {};
}

void PlannerStatusTeller::Update() {
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

void PlannerStatusTeller::Note(bool is_round, Point2 place) {
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

}  // namespace runnel
