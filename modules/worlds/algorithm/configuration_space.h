#pragma once

#include <optional>
#include <vector>

#include "modules/simulation/algorithm/outline.h"
#include "modules/simulation/algorithm/world.h"

namespace runnel {

/// A piece of the boundary of the obstacles grown by a radius: straight, or round about a centre.
struct BoundaryPiece {
  Point2 from;
  Point2 to;
  /// Of a round piece, which goes counter-clockwise about it from `from` to `to`.
  std::optional<Point2> centre = {};

  [[nodiscard]] double length() const;
  [[nodiscard]] double DistanceTo(Point2 point) const;
};

/// One closed boundary of the free space, with the free space on its right.
using BoundaryLoop = std::vector<BoundaryPiece>;

/// Where the centre of a round robot can be: the world with its obstacles grown by the robot's
/// radius (and by the clearance that it keeps), exactly, with round corners. Bounds are grown
/// inwards. A centre exactly on the boundary is free.
///
/// Lozano-Pérez and Wesley (1979).
///
/// Threads: never changes after construction.
class ConfigurationSpace {
 public:
  /// How deep in a grown obstacle a point still counts as on its boundary: what rounding may do.
  static constexpr double kTolerance = 1e-7;  // m

  /// A circle of the grown boundary: about a corner, or about something round.
  struct Circle {
    Point2 centre;
    double radius = 0.0;  ///< m
    /// Where it goes in or out of other grown obstacles, and at least one: rad, rising from 0 to 2π.
    std::vector<double> cuts = {};
    std::vector<bool> is_free = {};  ///< the arc from each cut to the next; from the last, round
  };

  /// The world must be without faults. `radius` in m, more than 0.
  ConfigurationSpace(World world, double radius);

  [[nodiscard]] double radius() const { return radius_; }
  [[nodiscard]] const std::vector<Circle>& circles() const { return circles_; }

  [[nodiscard]] bool IsFree(Point2 point) const;
  /// Whether the whole segment is clear of the surfaces of all obstacles; its ends are supposed to
  /// be free.
  [[nodiscard]] bool IsFree(const Segment2& segment) const;
  /// Whether a whole arc of the circle is free: counter-clockwise from one angle to another that is
  /// greater by less than 2π.
  [[nodiscard]] bool IsFree(const Circle& circle, double from, double to) const;
  /// The free point nearest to `point`, if there is one within `reach` (m).
  [[nodiscard]] std::optional<Point2> NearestFree(Point2 point, double reach) const;

  /// All closed boundaries of the free space, the bounds' too.
  [[nodiscard]] std::vector<BoundaryLoop> Boundaries() const;

 private:
  [[nodiscard]] double SurfaceDistance(Point2 point) const;
  void CutCircle(Circle& circle) const;
  void AddPiecesOf(const Segment2& offset, std::vector<BoundaryPiece>& pieces) const;
  void AddPiecesOf(const Circle& circle, std::vector<BoundaryPiece>& pieces) const;

  World world_;
  double radius_;
  Outline outline_;
  std::vector<Segment2> offsets_;  // of the flat surfaces, on both sides, free to the right
  std::vector<Circle> circles_;
};

/// m, of the whole loop.
[[nodiscard]] double LengthOf(const BoundaryLoop& loop);
[[nodiscard]] double DistanceTo(const BoundaryLoop& loop, Point2 point);
/// How often the segment goes through the loop.
[[nodiscard]] int Crossings(const BoundaryLoop& loop, const Segment2& segment);

}  // namespace runnel
