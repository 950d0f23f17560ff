#pragma once

#include <vector>

#include "modules/types/algorithm/point.h"

namespace runnel {

/// Where a planner of the Bug family met obstacles and where it left them, in order, since its task
/// began; m, world. hits[i] belongs to leaves[i]; while the robot is at an obstacle there is one
/// hit more.
struct HitAndLeavePoints {
  std::vector<Point2> hits;
  std::vector<Point2> leaves;

  friend bool operator==(const HitAndLeavePoints&, const HitAndLeavePoints&) = default;
};

}  // namespace runnel
