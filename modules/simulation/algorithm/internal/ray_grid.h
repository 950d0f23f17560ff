#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "modules/simulation/algorithm/outline.h"

namespace runnel::internal {

/// The surfaces of a world sorted into the square cells of a grid, so that a ray asks only those in
/// the cells it passes, nearest first (Amanatides and Woo, "A Fast Voxel Traversal Algorithm for
/// Ray Tracing", 1987).
class RayGrid {
 public:
  RayGrid(const Outline& outline, double eye_height);

  /// `direction` has length 1.
  [[nodiscard]] double Cast(Point2 origin, Point2 direction, double range) const;

 private:
  /// One axis of a ray's way through the cells. Distances count along the ray.
  struct AxisWalk {
    std::ptrdiff_t cell = 0;
    std::ptrdiff_t step = 0;       // -1, 0, +1
    double next_border = 0.0;      // distance at which the ray leaves the cell along this axis
    double border_distance = 0.0;  // from border to border
  };

  void MeasureExtent();
  void FillCells();
  void AddToCells(std::uint32_t surface, Point2 low, Point2 high);
  [[nodiscard]] bool IsNear(std::uint32_t surface, Point2 point, double distance) const;
  [[nodiscard]] double DistanceTo(std::uint32_t surface, Point2 origin, Point2 direction) const;
  [[nodiscard]] AxisWalk StartWalk(double origin, double direction, double low, double entry,
                                   std::ptrdiff_t count) const;
  [[nodiscard]] double NearestInCell(std::size_t cell, Point2 origin, Point2 direction,
                                     double nearest) const;

  std::vector<Segment2> flats_;
  std::vector<Outline::Round> rounds_;  // surface numbers go on after those of flats_
  Point2 low_, high_;
  double cell_size_ = 1.0;
  std::ptrdiff_t columns_ = 0, rows_ = 0;
  std::vector<std::vector<std::uint32_t>> buckets_;  // only while filling
  std::vector<std::uint32_t> first_;     // of each cell, in surfaces_; one more at the end
  std::vector<std::uint32_t> surfaces_;  // cell after cell
};

}  // namespace runnel::internal
