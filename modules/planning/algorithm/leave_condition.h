#pragma once

#include <optional>
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

/// After one whole lap the point with the least d, by the shorter way round (Bug1).
class BestAfterLap final : public LeaveCondition {
 public:
  [[nodiscard]] std::string_view name() const override { return "best_after_lap"; }
  [[nodiscard]] std::optional<LeavePoint> Find(const BugView& view) const override;
  [[nodiscard]] bool ResearchComplete(const BugView& view) const override;
};

/// On the M-line, d(x) < d(H), free towards the goal (Bug2).
class MLineCloserThanHit final : public LeaveCondition {
 public:
  [[nodiscard]] std::string_view name() const override { return "m_line_closer_than_hit"; }
  [[nodiscard]] std::optional<LeavePoint> Find(const BugView& view) const override;
  [[nodiscard]] bool needs_m_line() const override { return true; }
};

/// On the M-line, d(x) < d of all points of the M-line visited so far, free (Alg1).
class MLineClosestSoFar final : public LeaveCondition {
 public:
  [[nodiscard]] std::string_view name() const override { return "m_line_closest_so_far"; }
  [[nodiscard]] std::optional<LeavePoint> Find(const BugView& view) const override;
  [[nodiscard]] bool needs_m_line() const override { return true; }
};

/// d(x) < d of all points visited so far, free (Alg2).
class ClosestSoFar final : public LeaveCondition {
 public:
  [[nodiscard]] std::string_view name() const override { return "closest_so_far"; }
  [[nodiscard]] std::optional<LeavePoint> Find(const BugView& view) const override;
};

/// With F the free range towards the goal: d(x) - F <= 0 (the goal is in view), or d(x) - F <= d_min
/// - STEP with d_min the least d since H (DistBug). Where passages are narrower than STEP and the body
/// together, no point may be so.
class FreeRangeStep final : public LeaveCondition {
 public:
  [[nodiscard]] std::string_view name() const override { return "free_range_step"; }
  [[nodiscard]] std::optional<LeavePoint> Find(const BugView& view) const override;
  [[nodiscard]] bool MayLeave(const BugView& view) const override;
  [[nodiscard]] bool needs_range_sensor() const override { return true; }
  [[nodiscard]] bool MayMissPassages(const BugView&) const override { return true; }
};

/// d_reach < d_followed: something seen and free is nearer to the goal than all of the boundary
/// sensed since H (TangentBug). The robot first goes there, then moves to the goal again. Works with
/// a sensor that only feels, too, with what lies at the leave range ahead. What a vague sensor takes for
/// boundary may be nearer to the goal than any is.
class ReachBelowFollowed final : public LeaveCondition {
 public:
  [[nodiscard]] std::string_view name() const override { return "reach_below_followed"; }
  [[nodiscard]] std::optional<LeavePoint> Find(const BugView& view) const override;
  [[nodiscard]] double FollowedDistance(const BugView& view) const override;
  [[nodiscard]] bool MayMissPassages(const BugView& view) const override {
    return view.input.surroundings.is_vague;
  }
};

/// d(x) < d(H), free (Class1).
class CloserThanHit final : public LeaveCondition {
 public:
  [[nodiscard]] std::string_view name() const override { return "closer_than_hit"; }
  [[nodiscard]] std::optional<LeavePoint> Find(const BugView& view) const override;
};

/// Free (Com). The robot may go in circles for ever.
class FreeToGo final : public LeaveCondition {
 public:
  [[nodiscard]] std::string_view name() const override { return "free"; }
  [[nodiscard]] std::optional<LeavePoint> Find(const BugView& view) const override;
  [[nodiscard]] bool decides_after_lap() const override { return false; }
};

}  // namespace runnel
