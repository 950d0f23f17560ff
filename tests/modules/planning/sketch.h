#pragma once

#include "tests/modules/planning/test_world.h"

namespace runnel::testing_world {

/// Whether the point lies in the polygon, by the crossings of a ray.
inline bool Contains(const Polygon& polygon, Point2 point) {
  bool is_inside = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point2 a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    if ((a.y > point.y) == (b.y > point.y)) continue;
    if (point.x < a.x + (point.y - a.y) / (b.y - a.y) * (b.x - a.x)) is_inside = !is_inside;
  }
  return is_inside;
}

inline double Perimeter(const Polygon& polygon) {
  double perimeter = Distance(polygon.back(), polygon.front());
  for (std::size_t i = 1; i < polygon.size(); ++i) {
    perimeter += Distance(polygon[i - 1], polygon[i]);
  }
  return perimeter;
}

}  // namespace runnel::testing_world
