#include "modules/simulation/algorithm/world_checks.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "modules/simulation/algorithm/world_geometry.h"
#include "modules/types/algorithm/segment.h"

namespace runnel {

namespace {

std::string Text(Point2 point) { return fmt::format("({:g}, {:g})", point.x, point.y); }

bool AreFinite(const std::vector<Point2>& points) {
  return std::ranges::all_of(points, [](Point2 point) { return IsFinite(point); });
}

bool Meet(const Segment2& a, const Segment2& b) {
  if (WhereItMeets(a, b)) return true;
  // Parallel ones that overlap meet with an end of one on the other.
  const auto touches = [](const Segment2& s, Point2 end) { return NearestPoint(s, end) == end; };
  return touches(a, b.from) || touches(a, b.to) || touches(b, a.from) || touches(b, a.to);
}

/// Two sides that share a corner may meet there only: they must not fold back onto each other.
bool FoldsBack(const Segment2& side, const Segment2& next) {
  const Point2 a = side.to - side.from, b = next.to - next.from;
  return Cross(a, b) == 0.0 && Dot(a, b) < 0.0;
}

std::optional<std::string> SelfCrossing(const Ring& ring) {
  const std::vector<Segment2> sides = SidesOf(ring);
  for (std::size_t i = 0; i < sides.size(); ++i) {
    for (std::size_t j = i + 1; j < sides.size(); ++j) {
      const bool adjacent = j == i + 1, closing = i == 0 && j + 1 == sides.size();
      const bool wrong = adjacent  ? FoldsBack(sides[i], sides[j])
                         : closing ? FoldsBack(sides[j], sides[i])
                                   : Meet(sides[i], sides[j]);
      if (!wrong) continue;
      return "crosses or touches itself: its side from " + Text(sides[i].from) + " to " + Text(sides[i].to) +
             " meets the one from " + Text(sides[j].from) + " to " + Text(sides[j].to);
    }
  }
  return std::nullopt;
}

std::optional<std::string> RepeatedPoint(const std::vector<Point2>& points, bool closed) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool last = i + 1 == points.size();
    if (last && !closed) break;
    if (points[i] == points[last ? 0 : i + 1]) {
      return "has the point " + Text(points[i]) + " twice in a row" +
             (last ? "; a ring is closed without repeating its first point" : "");
    }
  }
  return std::nullopt;
}

/// What is wrong with a ring, worded to follow the name of the part.
std::optional<std::string> RingFault(const Ring& ring) {
  if (!AreFinite(ring)) return "has a point that is not finite";
  if (ring.size() < 3) {
    return "has " + std::to_string(ring.size()) + " point" + (ring.size() == 1 ? "" : "s") + ", but needs at least 3";
  }
  if (auto repeated = RepeatedPoint(ring, true)) return repeated;
  return SelfCrossing(ring);
}

bool RingsMeet(const Ring& a, const Ring& b) {
  const std::vector<Segment2> sides = SidesOf(b);
  return std::ranges::any_of(SidesOf(a), [&](const Segment2& side) {
    return std::ranges::any_of(sides, [&](const Segment2& other) { return Meet(side, other); });
  });
}

class Checker {
 public:
  explicit Checker(const World& world) : world_(world) {}

  std::vector<WorldFault> Check() {
    if (!IsFinite(world_.start)) Add(WorldPart::kStart, 0, "the start is not finite");
    if (!IsFinite(world_.goal)) Add(WorldPart::kGoal, 0, "the goal is not finite");
    for (std::size_t i = 0; i < world_.polygons.size(); ++i) CheckPolygon(i);
    for (std::size_t i = 0; i < world_.boxes.size(); ++i) CheckBox(i);
    for (std::size_t i = 0; i < world_.cylinders.size(); ++i) CheckCylinder(i);
    for (std::size_t i = 0; i < world_.walls.size(); ++i) CheckWall(i);
    if (world_.bounds) CheckBounds();
    return std::move(faults_);
  }

 private:
  void Add(WorldPart part, std::size_t index, std::string message, std::size_t hole = 0) {
    faults_.push_back({.part = part, .index = index, .hole = hole, .message = std::move(message)});
  }

  void CheckSize(WorldPart part, std::size_t index, const char* what, double size) {
    if (std::isfinite(size) && size > 0.0) return;
    Add(part, index, fmt::format("the {} must be more than 0 m, not {:g}", what, size));
  }

  template <typename Obstacle>
  void CheckStart(WorldPart part, std::size_t index, const Obstacle& obstacle) {
    const bool was_good = std::ranges::none_of(faults_, [&](const WorldFault& fault) {
      return (fault.part == part && fault.index == index) || fault.part == WorldPart::kStart ||
             (fault.part == WorldPart::kHole && part == WorldPart::kPolygon && fault.index == index);
    });
    if (was_good && SignedDistance(obstacle, Position(world_.start)) < 0.0) {
      Add(part, index, "the start " + Text(Position(world_.start)) + " is inside this obstacle");
    }
  }

  void CheckPolygon(std::size_t index) {
    const PolygonObstacle& polygon = world_.polygons[index];
    CheckSize(WorldPart::kPolygon, index, "height", polygon.height);
    const auto fault = RingFault(polygon.outline);
    if (fault) Add(WorldPart::kPolygon, index, "the polygon " + *fault);
    for (std::size_t hole = 0; hole < polygon.holes.size(); ++hole) {
      if (const auto wrong = RingFault(polygon.holes[hole])) {
        Add(WorldPart::kHole, index, "the hole " + *wrong, hole);
      } else if (!fault) {
        CheckHolePlace(index, hole);
      }
    }
    CheckStart(WorldPart::kPolygon, index, polygon);
  }

  void CheckHolePlace(std::size_t index, std::size_t hole) {
    const PolygonObstacle& polygon = world_.polygons[index];
    const Ring& ring = polygon.holes[hole];
    if (RingsMeet(ring, polygon.outline) || !Contains(polygon.outline, ring.front())) {
      Add(WorldPart::kHole, index, "the hole is not within its polygon", hole);
      return;
    }
    for (std::size_t other = 0; other < hole; ++other) {
      const Ring& before = polygon.holes[other];
      if (RingFault(before)) continue;
      if (RingsMeet(ring, before) || Contains(before, ring.front()) || Contains(ring, before.front())) {
        Add(WorldPart::kHole, index, "the hole meets another hole of its polygon", hole);
      }
    }
  }

  void CheckBox(std::size_t index) {
    const BoxObstacle& box = world_.boxes[index];
    if (!IsFinite(box.pose)) Add(WorldPart::kBox, index, "the box has a place that is not finite");
    CheckSize(WorldPart::kBox, index, "length", box.length);
    CheckSize(WorldPart::kBox, index, "width", box.width);
    CheckSize(WorldPart::kBox, index, "height", box.height);
    CheckStart(WorldPart::kBox, index, box);
  }

  void CheckCylinder(std::size_t index) {
    const CylinderObstacle& cylinder = world_.cylinders[index];
    if (!IsFinite(cylinder.centre)) {
      Add(WorldPart::kCylinder, index, "the cylinder has a place that is not finite");
    }
    CheckSize(WorldPart::kCylinder, index, "radius", cylinder.radius);
    CheckSize(WorldPart::kCylinder, index, "height", cylinder.height);
    CheckStart(WorldPart::kCylinder, index, cylinder);
  }

  void CheckWall(std::size_t index) {
    const WallObstacle& wall = world_.walls[index];
    CheckSize(WorldPart::kWall, index, "thickness", wall.thickness);
    CheckSize(WorldPart::kWall, index, "height", wall.height);
    if (!AreFinite(wall.points)) {
      Add(WorldPart::kWall, index, "the wall has a point that is not finite");
    } else if (wall.points.size() < 2) {
      Add(WorldPart::kWall, index, "the wall needs at least 2 points");
    } else if (const auto repeated = RepeatedPoint(wall.points, false)) {
      Add(WorldPart::kWall, index, "the wall " + *repeated);
    }
    CheckStart(WorldPart::kWall, index, wall);
  }

  void CheckBounds() {
    if (const auto fault = RingFault(*world_.bounds)) {
      Add(WorldPart::kBounds, 0, "the ring of the bounds " + *fault);
    } else if (IsFinite(world_.start) && !Contains(*world_.bounds, Position(world_.start))) {
      Add(WorldPart::kBounds, 0, "the start " + Text(Position(world_.start)) + " is outside the bounds");
    }
  }

  const World& world_;
  std::vector<WorldFault> faults_;
};

}  // namespace

std::vector<WorldFault> FaultsOf(const World& world) { return Checker(world).Check(); }

}  // namespace runnel
