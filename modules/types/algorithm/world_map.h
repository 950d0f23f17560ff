#pragma once

#include <string>
#include <vector>

#include "modules/types/algorithm/pose.h"

namespace runnel {

/// The ground plan of an obstacle, or of a hole in those that come before it. Obstacles may overlap.
struct MapOutline {
  std::vector<Point2> points;  ///< a closed line: the last point is joined to the first; m, world
  double height = 0.0;         ///< m
  bool is_hole = false;

  friend bool operator==(const MapOutline&, const MapOutline&) = default;
};

/// A world with a task in it, as one would draw it: everything is made of straight lines.
struct WorldMap {
  std::string name;
  Pose2 start = {};
  Point2 goal = {};
  std::vector<MapOutline> outlines;
  std::vector<Point2> bounds;  ///< a closed line that nobody leaves; empty if there is none

  friend bool operator==(const WorldMap&, const WorldMap&) = default;
};

}  // namespace runnel
