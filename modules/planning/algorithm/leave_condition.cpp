#include "modules/planning/algorithm/leave_condition.h"

#include <algorithm>

#include "modules/planning/algorithm/tangent_graph.h"

namespace runnel {

namespace {

constexpr double kPassNoise = 0.02;  // m by which two passes of the same point differ in d

std::optional<LeavePoint> HereIf(bool condition, const BugView& view) {
  if (!condition) return std::nullopt;
  return LeavePoint{Position(view.input.pose), Approach::kNear};
}

bool IsCloserThanHit(const BugView& view, double distance) {
  return distance < view.state.hit_distance - view.configuration.leave_margin;
}

// Where the robot crosses the M-line, if that is closer than the hit point and free.
std::optional<LeavePoint> GoodCrossing(const BugView& view) {
  const auto& crossing = view.state.crossing;
  if (!crossing || !IsCloserThanHit(view, Distance(*crossing, view.input.goal)) ||
      !IsFreeTowardsGoal(view)) {
    return std::nullopt;
  }
  return LeavePoint{*crossing, Approach::kNear};
}

// Of the straight way to `end` the first point with d < `wanted`. Precondition: d(end) < `wanted`.
Point2 FirstPointWithin(const BugView& view, Point2 end, double wanted) {
  constexpr int kHalvings = 16;
  Point2 outside = Position(view.input.pose), inside = end;
  for (int i = 0; i < kHalvings; ++i) {
    const Point2 middle = 0.5 * (outside + inside);
    (Distance(middle, view.input.goal) < wanted ? inside : outside) = middle;
  }
  return inside;
}

}  // namespace

std::optional<LeavePoint> BestAfterLap::Find(const BugView& view) const {
  return LeavePoint{view.state.closest_point, Approach::kAlongBoundary};
}

bool BestAfterLap::ResearchComplete(const BugView& view) const {
  return view.state.lap.is_complete();
}

std::optional<LeavePoint> MLineCloserThanHit::Find(const BugView& view) const {
  return GoodCrossing(view);
}

std::optional<LeavePoint> MLineClosestSoFar::Find(const BugView& view) const {
  const auto point = GoodCrossing(view);
  const double closest = view.state.least_distance_on_line + kPassNoise;
  if (!point || Distance(point->point, view.input.goal) > closest) return std::nullopt;
  return point;
}

std::optional<LeavePoint> ClosestSoFar::Find(const BugView& view) const {
  const double distance = DistanceToGoal(view);
  return HereIf(IsCloserThanHit(view, distance) &&
                    distance <= view.state.least_distance_of_all + kPassNoise &&
                    IsFreeTowardsGoal(view),
                view);
}

std::optional<LeavePoint> FreeRangeStep::Find(const BugView& view) const {
  return HereIf(MayLeave(view), view);
}

bool FreeRangeStep::MayLeave(const BugView& view) const {
  const double rest = DistanceToGoal(view) - FreeRangeTowardsGoal(view);
  return rest <= 0.0 || rest <= view.state.least_distance - view.configuration.step;
}

double ReachBelowFollowed::FollowedDistance(const BugView& view) const {
  const double contact = view.state.follower.Contact(view.input.surroundings).bearing;
  const TangentGraph graph(view.input.surroundings, view.input.pose, PassingRadius(view),
                           ViewRange(view));
  return std::min({view.state.followed_distance, view.state.least_distance,
                   graph.SectionDistance(view.input.goal, contact)});
}

std::optional<LeavePoint> ReachBelowFollowed::Find(const BugView& view) const {
  const TangentGraph graph(view.input.surroundings, view.input.pose, PassingRadius(view),
                           ViewRange(view));
  const double wanted = view.state.followed_distance - view.configuration.leave_margin;
  const Point2 nearest = graph.NearestReachable(view.input.goal);
  if (Distance(nearest, view.input.goal) >= wanted) return std::nullopt;
  return LeavePoint{FirstPointWithin(view, nearest, wanted), Approach::kAcross};
}

std::optional<LeavePoint> CloserThanHit::Find(const BugView& view) const {
  return HereIf(IsCloserThanHit(view, DistanceToGoal(view)) && IsFreeTowardsGoal(view), view);
}

std::optional<LeavePoint> FreeToGo::Find(const BugView& view) const {
  return HereIf(IsFreeTowardsGoal(view), view);
}

}  // namespace runnel
