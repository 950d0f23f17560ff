#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "modules/planning/algorithm/bug_view.h"

namespace runnel {

/// Where motion to goal steers at.
struct Waypoint {
  Point2 point;  ///< m, world
  /// Of the straight way to the goal, on which a node of the tangent graph lies; nothing if it
  /// steers at no node.
  std::optional<BoundaryDirection> node_side;
};

/// Component of a Bug algorithm: the way the robot takes while nothing is in it. If the way to the
/// waypoint is blocked, that is a hit. Objects have no state; they outlive the algorithms made of
/// them.
class MotionToGoal {
 public:
  virtual ~MotionToGoal() = default;
  [[nodiscard]] virtual std::string_view name() const = 0;
  [[nodiscard]] virtual Waypoint Target(const BugView& view) const = 0;
  /// Whether hit and leave points lie on the line from the start to the goal.
  [[nodiscard]] virtual bool follows_m_line() const { return false; }
};

enum class MotionKind : std::uint8_t {
  kStraight,  ///< straight to the goal, from wherever the robot is
  kMLine,     ///< along the line from the start to the goal, and back to it after an error
  /// To the goal if the way is free as far as the sensors see; else to the node of the local tangent
  /// graph with the shortest way through it, of those nearer to the goal than the robot is. Without
  /// such a node straight on, up to the boundary that it then has to follow.
  kTangent,
};
/// By kind.
[[nodiscard]] std::span<const MotionToGoal* const> AllMotions();

}  // namespace runnel
