#pragma once

#include "modules/behaviours/algorithm/drive_to_goal.h"

namespace runnel {

struct EmergencyStopConfiguration {
  double least_way = 0.05;  ///< m; with less free way ahead it stops
};

/// Stands still before it is too late, and lets nothing pass of what is `wanted` but turning on the spot.
[[nodiscard]] Wish EmergencyStop(const EmergencyStopConfiguration& configuration, const Surroundings& surroundings,
                                 const Twist2& wanted);

}  // namespace runnel
