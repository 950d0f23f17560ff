#include "modules/behaviours/algorithm/drive_to_goal.h"

#include <algorithm>
#include <cmath>

namespace runnel {

Wish DriveToGoal(const SteeringConfiguration& steering, const DriveToGoalConfiguration& configuration,
                 const Pose2& pose, Point2 goal) {
  const Point2 to_goal = ToBody(pose, goal);
  const double distance = std::hypot(to_goal.x, to_goal.y);
  if (distance <= configuration.tolerance) return {};
  const double bearing = std::atan2(to_goal.y, to_goal.x);
  return {Steer(steering, bearing, distance), std::min(1.0, distance / configuration.far_distance)};
}

}  // namespace runnel
