#pragma once

#include "modules/planning/algorithm/bug_algorithm.h"

namespace runnel {

/// Bug1 (Lumelsky, Stepanov 1984): follows an obstacle once all round, goes the shorter way along
/// the boundary to the point of it nearest to the goal, and leaves it there. If the way to the goal
/// is not free from that point, the goal cannot be reached.
class Bug1 : public BugAlgorithm {
 public:
  using BugAlgorithm::BugAlgorithm;

 protected:
  void FindLeavePoint(BugState& state, const BugInput& input) const override;
  bool ResearchComplete(const BugState& state) const override;
  std::optional<Twist2> GoToLeavePoint(BugState& state, const BugInput& input) const override;
  void RefuseLeavePoint(BugState& state, const BugInput& input) const override;

 private:
  void SetOut(BugState& state, const BugInput& input) const;
};

}  // namespace runnel
