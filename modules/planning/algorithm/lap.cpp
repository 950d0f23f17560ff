#include "modules/planning/algorithm/lap.h"

#include <cmath>

#include "modules/types/algorithm/angle.h"
#include "modules/types/algorithm/segment.h"

namespace runnel {

void Lap::Start(const Pose2& pose) {
  *this = Lap{};
  hit_ = pose;
  last_ = pose;
}

void Lap::Update(const Pose2& pose) {
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

bool Lap::IsPassing(const Gate& gate, Point2 before, const Pose2& pose) const {
  const Point2 place = Position(gate.pose);
  const bool is_at_gate = Distance(Segment2{before, Position(pose)}, place) < kGateHalfWidth;
  const bool is_through = Dot(Position(pose) - place, UnitVector(gate.pose.heading)) >= 0.0;
  const bool is_same_way = std::abs(WrapAngle(pose.heading - gate.pose.heading)) < kTurnTolerance;
  const bool has_turned_round = std::abs(turned_ - gate.turned) > 2 * kPi - kTurnTolerance;
  const bool is_far_round = length_ - gate.length > kShortestLap;
  return is_at_gate && is_through && is_same_way && has_turned_round && is_far_round;
}

}  // namespace runnel
