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
  const Segment2 way = {Position(last_), Position(pose)};
  length_ += Distance(way.from, way.to);
  turned_ += WrapAngle(pose.heading - last_.heading);
  last_ = pose;
  if (!has_gate_) {
    if (Distance(Position(hit_), Position(pose)) < kGateDistance) return;
    has_gate_ = true;
    gate_ = pose;
    gate_length_ = length_;
    turned_ = 0.0;
    return;
  }
  const bool is_at_gate = Distance(way, Position(gate_)) < kGateHalfWidth;
  const bool is_through = Dot(Position(pose) - Position(gate_), UnitVector(gate_.heading)) >= 0.0;
  const bool is_same_way = std::abs(WrapAngle(pose.heading - gate_.heading)) < kTurnTolerance;
  is_complete_ = is_at_gate && is_through && is_same_way && has_turned_round();
}

bool Lap::has_turned_round() const {
  return length_ > kShortestLap && std::abs(turned_) > 2 * kPi - kTurnTolerance;
}

}  // namespace runnel
