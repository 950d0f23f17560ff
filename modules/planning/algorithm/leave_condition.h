#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "modules/planning/algorithm/bug_view.h"

namespace runnel {

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
  [[nodiscard]] virtual double FollowedDistance(const BugView& view) const {
    return view.state.followed_distance;
  }

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
  kBestAfterLap,  ///< after one whole lap the point with the least d, by the shorter way (Bug1)
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

}  // namespace runnel
