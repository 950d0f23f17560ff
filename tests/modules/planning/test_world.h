#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "modules/types/algorithm/angle.h"
#include "modules/types/algorithm/measurements.h"
#include "modules/types/algorithm/pose.h"
#include "modules/types/algorithm/segment.h"

namespace runnel::testing_world {

using Polygon = std::vector<Point2>;

inline Polygon Box(double x, double y, double width, double height) {
  return {{x - width / 2, y - height / 2},
          {x + width / 2, y - height / 2},
          {x + width / 2, y + height / 2},
          {x - width / 2, y + height / 2}};
}

inline Polygon Cylinder(double x, double y, double radius) {
  Polygon polygon;
  for (int i = 0; i < 24; ++i) {
    polygon.push_back(Point2{x, y} + radius * UnitVector(2 * kPi * i / 24));
  }
  return polygon;
}

/// The walls of polygons, as a robot's sensors and body meet them.
class World {
 public:
  World() = default;
  explicit World(const std::vector<Polygon>& polygons) {
    for (const Polygon& polygon : polygons) Add(polygon);
  }
  void Add(const Polygon& polygon) {
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      walls_.push_back({polygon[i], polygon[(i + 1) % polygon.size()]});
    }
  }
  [[nodiscard]] double Clearance(Point2 point) const {
    double squared = std::numeric_limits<double>::infinity();
    for (const Segment2& wall : walls_) {
      const Point2 offset = NearestPoint(wall, point) - point;
      squared = std::min(squared, Dot(offset, offset));
    }
    return std::sqrt(squared);
  }
  [[nodiscard]] Point2 NearestWallPoint(Point2 point) const {
    Point2 nearest = {1e9, 1e9};
    for (const Segment2& wall : walls_) {
      const Point2 candidate = NearestPoint(wall, point);
      const Point2 offset = candidate - point, least = nearest - point;
      if (Dot(offset, offset) < Dot(least, least)) nearest = candidate;
    }
    return nearest;
  }
  [[nodiscard]] double CastRay(Point2 from, double direction, double range) const {
    const Segment2 ray = {from, from + range * UnitVector(direction)};
    double nearest = std::numeric_limits<double>::infinity();
    for (const Segment2& wall : walls_) {
      if (const auto part = WhereItMeets(ray, wall)) nearest = std::min(nearest, *part * range);
    }
    return nearest;
  }
  [[nodiscard]] RangeScan Scan(const Pose2& pose) const {
    RangeScan scan{-kPi / 2, kPi / 180, 0.02, 4.0, {}};
    for (int i = 0; i <= 180; ++i) {
      const double direction = pose.heading + scan.start_angle + i * scan.angle_step;
      scan.ranges.push_back(static_cast<float>(CastRay(Position(pose), direction, 4.0)));
    }
    return scan;
  }
  [[nodiscard]] InfraredRanges Infrared(const Pose2& pose) const {
    const auto cone = [&](double bearing) {
      double nearest = std::numeric_limits<double>::infinity();
      for (int i = -13; i <= 13; ++i) {
        nearest = std::min(nearest, CastRay(Position(pose), pose.heading + bearing + DegreesToRadians(i), 2.0));
      }
      return nearest;
    };
    return {cone(0.0), cone(kPi / 2), cone(-kPi / 2), 2.0, DegreesToRadians(26.0)};
  }

 private:
  std::vector<Segment2> walls_;
};

/// A unicycle with limited speeds and accelerations.
class Robot {
 public:
  static constexpr double kRadius = 0.15;
  explicit Robot(const Pose2& pose) : pose_(pose) {}

  void Drive(const Twist2& wanted, double time_step) {
    constexpr int kSubsteps = 5;
    const double step = time_step / kSubsteps;
    for (int i = 0; i < kSubsteps; ++i) {
      twist_.forward = Approach(twist_.forward, std::clamp(wanted.forward, -0.5, 0.5), 1.0 * step);
      twist_.turn = Approach(twist_.turn, std::clamp(wanted.turn, -1.5, 1.5), 4.0 * step);
      const double middle = pose_.heading + twist_.turn * step / 2;
      pose_.x += twist_.forward * step * std::cos(middle);
      pose_.y += twist_.forward * step * std::sin(middle);
      pose_.heading = WrapAngle(pose_.heading + twist_.turn * step);
    }
  }
  /// The same where walls stop the body, and says what it touches.
  Contact DriveAndTouch(const Twist2& wanted, double time_step, const World& world) {
    const Pose2 before = pose_;
    Drive(wanted, time_step);
    const double clearance = world.Clearance(Position(pose_));
    if (clearance >= kRadius + kTouch) return {};
    if (clearance < kRadius && clearance < world.Clearance(Position(before))) {
      pose_.x = before.x;
      pose_.y = before.y;
      twist_.forward = 0.0;
    }
    const Point2 touched = ToBody(pose_, world.NearestWallPoint(Position(pose_)));
    return {true, Direction(touched)};
  }
  [[nodiscard]] const Pose2& pose() const { return pose_; }

 private:
  static constexpr double kTouch = 0.02;  // m, the travel of the bumper
  static double Approach(double value, double wanted, double step) {
    return value + std::clamp(wanted - value, -step, step);
  }
  Pose2 pose_;
  Twist2 twist_;
};

}  // namespace runnel::testing_world
