#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
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

/// Component of a Bug algorithm: which way the robot turns at a hit point. Objects have no state;
/// they outlive the algorithms made of them.
class DirectionChoice {
 public:
  virtual ~DirectionChoice() = default;
  [[nodiscard]] virtual std::string_view name() const = 0;
  /// `contact_bearing` (rad, body's frame) is that of the boundary point in the way.
  [[nodiscard]] virtual BoundaryDirection Choose(const BugView& view, double contact_bearing) const = 0;
};

enum class DirectionKind : std::uint8_t {
  kLeft,   ///< always
  kRight,  ///< always
  /// The side of the tangent node steered at last; if there was none, the side that turns least; if
  /// both are the same, the first direction configured.
  kLocal,
  /// Opposite to the one at the hit point before; the first direction configured at the first.
  kAlternate,
};
/// By kind.
[[nodiscard]] std::span<const DirectionChoice* const> AllDirections();

struct LeavePoint {
  Point2 point;  ///< m, world
  Approach approach = Approach::kNear;
};

/// Component of a Bug algorithm: where the robot may leave the boundary it follows. Objects have no
/// state; they outlive the algorithms made of them. In the comments d(x) is the distance from x to
/// the goal, H the last hit point.
class LeaveCondition {
 public:
  virtual ~LeaveCondition() = default;
  [[nodiscard]] virtual std::string_view name() const = 0;

  /// findLeavePoint: asked in each step along a boundary.
  [[nodiscard]] virtual std::optional<LeavePoint> Find(const BugView& view) const = 0;
  /// researchComplete: whether the point found is good enough; if not, the robot goes on looking.
  [[nodiscard]] virtual bool ResearchComplete(const BugView&) const { return true; }
  /// Whether the robot may go, now that it is at its leave point and looks towards the goal.
  [[nodiscard]] virtual bool MayLeave(const BugView& view) const { return IsFreeTowardsGoal(view); }
  /// m, a number that conditions about sensed boundaries keep: to be the state's followed_distance.
  [[nodiscard]] virtual double FollowedDistance(const BugView& view) const { return view.state.followed_distance; }

  // Constraints on what it may be composed with.
  [[nodiscard]] virtual bool needs_m_line() const { return false; }
  /// Whether a sensor that only feels (Surroundings::sensor_range 0) is not enough.
  [[nodiscard]] virtual bool needs_range_sensor() const { return false; }
  /// Whether a lap without a leave point proves that the goal cannot be reached.
  [[nodiscard]] virtual bool decides_after_lap() const { return true; }
  /// Whether it may find none although the robot could get on. After such a lap the robot goes to the
  /// point of the boundary nearest to the goal, as Bug1 does; if that is the hit point, it goes round the
  /// other way where its sensors are vague.
  [[nodiscard]] virtual bool MayMissPassages(const BugView&) const { return false; }
};

enum class LeaveKind : std::uint8_t {
  kBestAfterLap,        ///< after one whole lap the point with the least d, by the shorter way (Bug1)
  kMLineCloserThanHit,  ///< on the M-line, d(x) < d(H), free towards the goal (Bug2)
  /// On the M-line, d(x) < d of all points of the M-line visited so far, free (Alg1).
  kMLineClosestSoFar,
  kClosestSoFar,  ///< d(x) < d of all points visited so far, free (Alg2)
  /// With F the free range towards the goal: d(x) - F <= 0 (the goal is in view), or d(x) - F <= d_min
  /// - STEP with d_min the least d since H (DistBug). Where passages are narrower than STEP and the body
  /// together, no point may be so.
  kFreeRangeStep,
  /// d_reach < d_followed: something seen and free is nearer to the goal than all of the boundary
  /// sensed since H (TangentBug). The robot first goes there, then moves to the goal again. Works with
  /// a sensor that only feels, too, with what lies at the leave range ahead. What a vague sensor takes for
  /// boundary may be nearer to the goal than any is.
  kReachBelowFollowed,
  kCloserThanHit,  ///< d(x) < d(H), free (Class1)
  kFree,           ///< free (Com); the robot may go in circles for ever
};
/// By kind.
[[nodiscard]] std::span<const LeaveCondition* const> AllLeaveConditions();

/// Component of a Bug algorithm: what the robot does where it has been before. Objects have no
/// state; they outlive the algorithms made of them.
class Revisit {
 public:
  virtual ~Revisit() = default;
  [[nodiscard]] virtual std::string_view name() const = 0;
  /// Whether to go back to the last hit point and round the obstacle the other way. Asked in each
  /// step along a boundary, until it says so for the first time since the hit.
  [[nodiscard]] virtual bool ShallReverse(const BugView& view) const = 0;
};

enum class RevisitKind : std::uint8_t {
  kNone,
  /// Reverses where it meets an earlier hit or leave point (Alg1, Sankaranarayanan and Vidyasagar
  /// 1990). Only points of the lists in BugState are known.
  kReverseAtVisited,
};
/// By kind.
[[nodiscard]] std::span<const Revisit* const> AllRevisits();

/// A choice of one component of each kind, as data.
struct BugComposition {
  MotionKind motion = MotionKind::kStraight;
  DirectionKind direction = DirectionKind::kLeft;
  LeaveKind leave = LeaveKind::kBestAfterLap;
  RevisitKind revisit = RevisitKind::kNone;

  friend constexpr bool operator==(const BugComposition&, const BugComposition&) = default;
};

/// The components themselves, that a BugAlgorithm is made of; own ones may be among them. They must
/// outlive it.
struct BugComponents {
  const MotionToGoal* motion = nullptr;
  const DirectionChoice* direction = nullptr;
  const LeaveCondition* leave = nullptr;
  const Revisit* revisit = nullptr;

  /// Tells apart who may not simply go on with what the other has remembered, by the names of the
  /// components but the direction; never 0.
  [[nodiscard]] std::uint64_t Fingerprint() const;
};

[[nodiscard]] inline const MotionToGoal& ComponentFor(MotionKind kind) {
  return *AllMotions()[static_cast<std::size_t>(kind)];
}
[[nodiscard]] inline const DirectionChoice& ComponentFor(DirectionKind kind) {
  return *AllDirections()[static_cast<std::size_t>(kind)];
}
[[nodiscard]] inline const LeaveCondition& ComponentFor(LeaveKind kind) {
  return *AllLeaveConditions()[static_cast<std::size_t>(kind)];
}
[[nodiscard]] inline const Revisit& ComponentFor(RevisitKind kind) {
  return *AllRevisits()[static_cast<std::size_t>(kind)];
}

[[nodiscard]] BugComponents Assemble(const BugComposition& composition);

/// Why components do not fit together, and what would.
struct Misfit {
  std::string message;
  std::string hint;
};
/// Nothing if they fit. Allocates.
[[nodiscard]] std::optional<Misfit> FindMisfit(const BugComponents& components);
/// Nothing if the components can do with what the sensors tell.
[[nodiscard]] std::optional<Misfit> FindMisfit(const BugComponents& components, const Surroundings& surroundings);

}  // namespace runnel
