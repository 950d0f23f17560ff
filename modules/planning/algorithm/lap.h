#pragma once

#include "modules/types/algorithm/pose.h"

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
  void Start(const Pose2& pose);
  /// The robot went straight from its last pose to this one.
  void Update(const Pose2& pose);

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
  [[nodiscard]] bool IsPassing(const Gate& gate, Point2 before, const Pose2& pose) const;

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
