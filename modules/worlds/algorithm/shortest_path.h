#pragma once

#include <optional>
#include <vector>

#include "modules/worlds/algorithm/configuration_space.h"

namespace runnel {

struct ShortestPath {
  double length = 0.0;              ///< m
  std::vector<Point2> points = {};  ///< the line, its bends in steps of 0.1 rad at most
};

/// The shortest way of the robot's centre from one point to another; nothing if there is none.
///
/// A visibility graph of the configuration space: since grown corners are round, its edges are the
/// common tangents of two circles and the arcs between the points where tangents touch a circle.
/// Exact but for rounding. Searched by A* (Hart, Nilsson, Raphael 1968) with the straight distance;
/// whether an edge is free is asked only of those from nodes that the search comes to.
///
/// A `from` or `to` that is not free is replaced by the nearest point that is, if there is one
/// within `reach` (m); the way to it does not count.
[[nodiscard]] std::optional<ShortestPath> FindShortestPath(const ConfigurationSpace& space, Point2 from, Point2 to,
                                                           double reach = 0.0);

}  // namespace runnel
