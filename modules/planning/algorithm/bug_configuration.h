#pragma once

#include "modules/planning/algorithm/boundary_direction.h"
#include "modules/planning/algorithm/driving.h"

namespace runnel {

struct BugConfiguration {
  DrivingConfiguration driving;
  /// Where a variant alternates: at its first obstacle; where it turns the shorter way: if both are
  /// the same.
  BoundaryDirection first_direction = BoundaryDirection::kLeft;
  double goal_tolerance = 0.10;  ///< m; nearer than this is there
  /// m by which a leave point must be nearer to the goal than what it is compared with: above the
  /// noise of localisation.
  double leave_margin = 0.10;
  double step = 0.50;         ///< m; STEP of DistBug: by which it must see that it gets nearer
  double hit_range = 0.05;    ///< m; the way to the goal free for less than this is a hit
  double leave_range = 0.10;  ///< m; a leave point must be free towards the goal for this
  /// s; without getting on for so long, and for two turns and a half, there is no room to move;
  /// twice that where sensors are vague.
  double idle_limit = 15.0;
};

}  // namespace runnel
