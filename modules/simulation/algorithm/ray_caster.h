#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "modules/simulation/algorithm/outline.h"

namespace runnel {

/// Says how far it is from a point to the nearest surface in a direction, exactly.
///
/// Bullet can cast rays too, but walks its trees in three dimensions and finds round surfaces by
/// iteration, to micrometres. A world of upright surfaces is a plane problem, which this solves in
/// closed form over a uniform grid: to the last digits, and three times as fast where all is flat,
/// ten times where something is round. The surfaces are sorted into the square cells of the grid, so that
/// a ray asks only those in the cells it passes, nearest first (Amanatides and Woo, "A Fast Voxel
/// Traversal Algorithm for Ray Tracing", 1987).
///
/// Threads: never changes after construction; any thread may ask.
/// Allocation: in the constructor only.
class RayCaster {
 public:
  /// Sees what is higher than `eye_height` (m).
  RayCaster(const Outline& outline, double eye_height);

  /// The distance in m, +infinity if it is more than `range` (m, finite). `direction` in rad in the
  /// world's frame. An origin that is no number sees nothing.
  [[nodiscard]] double Cast(Point2 origin, double direction, double range) const;

  /// A fan: ray i has the direction `directions[i]` in the frame of a body that heads for `ahead`, both of length 1:
  /// who keeps the directions turns them by two products each, instead of a sine and a cosine.
  /// Precondition: as many distances as directions.
  void CastFan(Point2 origin, Point2 ahead, std::span<const Point2> directions, double range,
               std::span<float> distances) const;

 private:
  // One axis of a ray's way through the cells. Distances count along the ray.
  struct AxisWalk {
    std::ptrdiff_t cell = 0;
    std::ptrdiff_t step = 0;       // -1, 0, +1
    double next_border = 0.0;      // distance at which the ray leaves the cell along this axis
    double border_distance = 0.0;  // from border to border
  };

  // `direction` has length 1; `inverse_direction` of an axis is 1 / direction.
  [[nodiscard]] double CastAlong(Point2 origin, Point2 direction, double range) const;
  void MeasureExtent();
  void FillCells();
  void AddToCells(std::uint32_t surface, Point2 low, Point2 high);
  [[nodiscard]] bool IsNear(std::uint32_t surface, Point2 point, double distance) const;
  [[nodiscard]] double DistanceTo(std::uint32_t surface, Point2 origin, Point2 direction) const;
  [[nodiscard]] AxisWalk StartWalk(double origin, double direction, double inverse_direction, double low, double entry,
                                   std::ptrdiff_t count) const;
  [[nodiscard]] double NearestInCell(std::size_t cell, Point2 origin, Point2 direction, double nearest) const;

  std::vector<Segment2> flats_;
  std::vector<Outline::Round> rounds_;  // surface numbers go on after those of flats_
  Point2 low_, high_;
  double cell_size_ = 1.0;
  double cells_per_metre_ = 1.0;
  std::ptrdiff_t columns_ = 0, rows_ = 0;
  std::vector<std::vector<std::uint32_t>> buckets_;  // only while filling
  std::vector<std::uint32_t> first_;                 // of each cell, in surfaces_; one more at the end
  std::vector<std::uint32_t> surfaces_;              // cell after cell
};

}  // namespace runnel
