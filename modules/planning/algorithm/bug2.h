#pragma once

#include "modules/planning/algorithm/bug_algorithm.h"

namespace runnel {

/// Bug2 (Lumelsky, Stepanov 1986): drives along the M-line from start to goal; follows an obstacle
/// until it crosses the M-line nearer to the goal than the hit point was, with the way to the goal
/// free, and leaves it there. A lap without such a crossing: the goal cannot be reached.
class Bug2 : public BugAlgorithm {
 public:
  using BugAlgorithm::BugAlgorithm;

 protected:
  void FindLeavePoint(BugState& state, const BugInput& input) const override;
  bool ResearchComplete(const BugState&) const override { return true; }
  std::optional<Twist2> GoToLeavePoint(BugState& state, const BugInput& input) const override;
  void RefuseLeavePoint(BugState& state, const BugInput& input) const override;
  Point2 MotionTarget(const BugInput& input) const override;
};

}  // namespace runnel
