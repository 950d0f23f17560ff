#pragma once

#include <cmath>

#include "modules/types/algorithm/angle.h"
#include "modules/types/algorithm/pose.h"
#include "modules/types/algorithm/segment.h"

namespace runnel {

/// Tells whether a robot that follows a boundary has gone all the way round.
///
/// "Back at the hit point" alone is wrong twice: a robot dithering at its hit point is back there,
/// and in a narrow corridor it passes its hit point along the opposite wall. A boundary followed at
/// a distance is a closed curve that does not cross itself, and by Hopf's theorem exactly one lap
/// round such a curve turns the heading by one whole turn. So a lap is complete when the robot
/// passes the gate it started through, in the same direction, having turned once round in all (or
/// more often, should it have missed the gate). No count of calls, no length that depends on the
/// obstacle's size.
///
/// What a sensor sees of a tight place may depend on where the robot comes from, so a robot may be
/// led out of a place that it does not enter again, and its hit point with it. Therefore a second
/// gate is put up anew each time the way followed has doubled (Brent's way to find a cycle with an
/// unknown beginning): a robot that goes round and round passes it.
class Lap {
 public:
  /// At a hit point. The gate is put up `kGateDistance` further on, where the robot has turned
  /// along the boundary.
  void Start(const Pose2& pose) {
    *this = Lap{};
    hit_ = pose;
    last_ = pose;
  }

  /// The robot went straight from its last pose to this one.
  void Update(const Pose2& pose) {
    const Point2 before = Position(last_);
    length_ += Distance(before, Position(pose));
    turned_ += WrapAngle(pose.heading - last_.heading);
    last_ = pose;
    const Gate here = {pose, length_, turned_};
    if (!has_gate_) {
      has_gate_ = Distance(Position(hit_), Position(pose)) >= kGateDistance;
      gate_ = here;
      second_gate_ = here;
      return;
    }
    is_complete_ = IsPassing(gate_, before, pose);
    is_circling_ = IsPassing(second_gate_, before, pose);
    if (length_ > 2 * second_gate_.length + kShortestLap) second_gate_ = here;
  }

  /// Whether the robot is back where it hit the obstacle, all the way round.
  [[nodiscard]] bool is_complete() const { return is_complete_; }
  /// Whether the robot goes round a loop, which the place where it hit the obstacle need not be on.
  [[nodiscard]] bool is_circling() const { return is_circling_; }
  /// m followed since Start.
  [[nodiscard]] double length() const { return length_; }
  /// m from Start to the gate, at which a complete lap ends.
  [[nodiscard]] double gate_length() const { return gate_.length; }

  static constexpr double kGateDistance = 0.10;   ///< m
  static constexpr double kGateHalfWidth = 0.25;  ///< m, more than two passes differ
  static constexpr double kTurnTolerance = 1.0;   ///< rad, on the whole turn
  /// m; even round a point a robot that keeps the distance goes further. A shorter way round is a
  /// turn on the spot.
  static constexpr double kShortestLap = 1.5;

 private:
  friend struct KeptFields;  // names the members for a handover
  struct Gate {
    Pose2 pose;
    double length = 0.0;  // m since Start, there
    double turned = 0.0;  // rad since Start, not wrapped
  };

  [[nodiscard]] bool IsPassing(const Gate& gate, Point2 before, const Pose2& pose) const {
    const Point2 place = Position(gate.pose);
    const bool is_at_gate = Distance(Segment2{before, Position(pose)}, place) < kGateHalfWidth;
    const bool is_through = Dot(Position(pose) - place, UnitVector(gate.pose.heading)) >= 0.0;
    const bool is_same_way = std::abs(WrapAngle(pose.heading - gate.pose.heading)) < kTurnTolerance;
    const bool has_turned_round = std::abs(turned_ - gate.turned) > 2 * kPi - kTurnTolerance;
    const bool is_far_round = length_ - gate.length > kShortestLap;
    return is_at_gate && is_through && is_same_way && has_turned_round && is_far_round;
  }

  Pose2 hit_;
  Pose2 last_;
  Gate gate_;
  Gate second_gate_;
  bool has_gate_ = false;
  bool is_complete_ = false;
  bool is_circling_ = false;
  double length_ = 0.0;
  double turned_ = 0.0;
};

}  // namespace runnel
