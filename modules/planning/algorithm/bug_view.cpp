#include "modules/planning/algorithm/bug_view.h"

#include <algorithm>

namespace runnel {

namespace {

constexpr double kClearanceNoise = 0.02;  // m, of the distance to a boundary followed

}  // namespace

double DistanceToGoal(const BugView& view) { return Distance(Position(view.input.pose), view.input.goal); }

double BearingTo(const BugInput& input, Point2 point) { return Direction(ToBody(input.pose, point)); }

double PassingRadius(const BugView& view) {
  const Surroundings& surroundings = view.input.surroundings;
  const double narrowest = TravelRadius(view.configuration.driving, surroundings);
  return std::clamp(NearestBoundary(surroundings).distance - kClearanceNoise, narrowest,
                    double{surroundings.safe_distance});
}

double ViewRange(const BugView& view) {
  return std::max(double{view.input.surroundings.sensor_range},
                  view.configuration.leave_range + view.configuration.leave_margin);
}

double FreeRangeTowardsGoal(const BugView& view) {
  const double free = FreeRange(view.input.surroundings, BearingTo(view.input, view.input.goal), PassingRadius(view));
  return std::min(free, ViewRange(view));
}

bool IsFreeTowardsGoal(const BugView& view) {
  return FreeRange(view.input.surroundings, BearingTo(view.input, view.input.goal), PassingRadius(view)) >=
         std::min(view.configuration.leave_range, DistanceToGoal(view));
}

}  // namespace runnel
