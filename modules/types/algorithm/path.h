#pragma once

#include <vector>

#include "modules/types/algorithm/point.h"

namespace runnel {

/// Where something went or is to go, from its begin to its end; m, world.
struct Path2 {
  std::vector<Point2> points;

  friend bool operator==(const Path2&, const Path2&) = default;
};

}  // namespace runnel
