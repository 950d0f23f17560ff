#pragma once

#include "modules/types/algorithm/surroundings.h"

// What tests ask of surroundings.
namespace runnel {

/// How wide the view is that "in front", "on the left" and "on the right" mean.
inline constexpr double kSideHalfWidth = DegreesToRadians(30.0);

inline double FrontDistance(const Surroundings& surroundings) {
  return NearestBoundary(surroundings, 0.0, kSideHalfWidth).distance;
}
inline double LeftDistance(const Surroundings& surroundings) {
  return NearestBoundary(surroundings, kPi / 2, kSideHalfWidth).distance;
}
inline double RightDistance(const Surroundings& surroundings) {
  return NearestBoundary(surroundings, -kPi / 2, kSideHalfWidth).distance;
}

}  // namespace runnel
