#pragma once

#include <string>
#include <utility>
#include <vector>

#include "modules/types/algorithm/pose.h"

namespace runnel {

enum class DrawnKind {
  kPoints,      ///< a dot at each point
  kLine,        ///< from point to point
  kClosedLine,  ///< and back to the first
  kText,        ///< at the first point
};

/// 0 .. 1 each.
struct DrawnColour {
  double red = 0, green = 0, blue = 0, alpha = 1;
  friend bool operator==(const DrawnColour&, const DrawnColour&) = default;
};

/// One thing that is drawn.
struct DrawnItem {
  DrawnKind kind = DrawnKind::kPoints;
  std::vector<Point2> points;  ///< m, in the frame of the drawing
  DrawnColour colour;
  double size = 0.05;  ///< m: how large dots are, how wide lines, how high text
  std::string text;
  friend bool operator==(const DrawnItem&, const DrawnItem&) = default;
};

/// What a module wants people to see of what it thinks: dots, lines and text on the ground.
struct Drawing {
  std::string frame;  ///< "": the world; "robot": the body, x ahead and y to the left
  std::vector<DrawnItem> items;

  void AddPoints(std::vector<Point2> points, const DrawnColour& colour, double size = 0.05) {
    items.push_back({DrawnKind::kPoints, std::move(points), colour, size, {}});
  }
  void AddLine(std::vector<Point2> points, const DrawnColour& colour, double width = 0.02) {
    items.push_back({DrawnKind::kLine, std::move(points), colour, width, {}});
  }
  void AddText(const Point2& at, std::string text, const DrawnColour& colour, double height = 0.2) {
    items.push_back({DrawnKind::kText, {at}, colour, height, std::move(text)});
  }

  friend bool operator==(const Drawing&, const Drawing&) = default;
};

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
