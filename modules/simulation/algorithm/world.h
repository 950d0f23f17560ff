#pragma once

#include <optional>
#include <string>
#include <vector>

#include "modules/types/algorithm/pose.h"

namespace runnel {

inline constexpr double kDefaultObstacleHeight = 1.0;  ///< m

/// A closed line: the last point is joined to the first, which is not repeated. Any order of
/// turning.
using Ring = std::vector<Point2>;

/// What lies within the outline and outside of every hole.
struct PolygonObstacle {
  Ring outline;
  std::vector<Ring> holes = {};
  double height = kDefaultObstacleHeight;  ///< m

  friend bool operator==(const PolygonObstacle&, const PolygonObstacle&) = default;
};

struct BoxObstacle {
  Pose2 pose = {};      ///< of the centre; the heading is the direction of the length
  double length = 0.0;  ///< m, along the heading
  double width = 0.0;   ///< m, across it
  double height = kDefaultObstacleHeight;

  friend bool operator==(const BoxObstacle&, const BoxObstacle&) = default;
};

struct CylinderObstacle {
  Point2 centre = {};
  double radius = 0.0;  ///< m
  double height = kDefaultObstacleHeight;

  friend bool operator==(const CylinderObstacle&, const CylinderObstacle&) = default;
};

/// All that is within half a thickness of an open line: its ends and corners are round.
struct WallObstacle {
  std::vector<Point2> points;
  double thickness = 0.0;  ///< m
  double height = kDefaultObstacleHeight;

  friend bool operator==(const WallObstacle&, const WallObstacle&) = default;
};

/// A plane with upright obstacles standing on it, and a task for a robot: from start to goal.
/// Lengths in m, angles in rad, all in one frame, the world's.
struct World {
  std::string name = {};
  Pose2 start = {};
  Point2 goal = {};
  std::vector<PolygonObstacle> polygons = {};
  std::vector<BoxObstacle> boxes = {};
  std::vector<CylinderObstacle> cylinders = {};
  std::vector<WallObstacle> walls = {};
  std::optional<Ring> bounds = {};  ///< the robot never leaves this ring

  friend bool operator==(const World&, const World&) = default;
};

/// A round robot on two driven wheels, left and right of its centre, without any sideways slip.
struct RobotOptions {
  double radius = 0.15;               ///< m
  double height = 0.3;                ///< m
  double ground_clearance = 0.05;     ///< m, of the body; what is lower cannot touch it
  double mass = 10.0;                 ///< kg
  double wheel_radius = 0.05;         ///< m
  double track = 0.25;                ///< m, from wheel to wheel
  double maximum_speed = 0.5;         ///< m/s ahead or back
  double maximum_turn_rate = 1.5;     ///< rad/s either way
  double maximum_wheel_force = 10.0;  ///< N, of each wheel along the ground; bounds acceleration
  double maximum_grip = 80.0;         ///< N, of both wheels together across the rolling direction
  double wall_friction = 0.1;         ///< Coulomb's coefficient between body and obstacle
};

}  // namespace runnel
