#include "modules/planning/algorithm/revisit.h"

namespace runnel {

bool ReverseAtVisited::ShallReverse(const BugView& view) const {
  const BugState& state = view.state;
  const Point2 before = Position(state.last_pose), here = Position(view.input.pose);
  // Points at the hit point itself are met at the end of the lap, not when the robot sets out.
  const auto is_met = [&](Point2 point) {
    return Distance(here, point) <= kMeeting && Distance(before, point) > kMeeting &&
           Distance(state.status.hit_point, point) > 2 * kMeeting;
  };
  for (std::size_t i = 0; i + 1 < state.hits.size(); ++i) {
    if (is_met(state.hits[i])) return true;
  }
  for (std::size_t i = 0; i < state.leaves.size(); ++i) {
    if (is_met(state.leaves[i])) return true;
  }
  return false;
}

}  // namespace runnel
