#include "modules/planning/algorithm/revisit.h"

#include <array>

namespace runnel {

namespace {

// m; less than half of what two grown boundaries are apart that a robot passes between (0.30 m
// with gaps of its diameter and two safe distances), more than two passes of the same one.
constexpr double kMeeting = 0.15;

class NoRevisit final : public Revisit {
 public:
  [[nodiscard]] std::string_view name() const override { return "none"; }
  [[nodiscard]] bool ShallReverse(const BugView&) const override { return false; }
};

class ReverseAtVisited final : public Revisit {
 public:
  [[nodiscard]] std::string_view name() const override { return "reverse_at_visited"; }
  [[nodiscard]] bool ShallReverse(const BugView& view) const override {
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
};

}  // namespace

std::span<const Revisit* const> AllRevisits() {
  static const NoRevisit none;
  static const ReverseAtVisited reverse_at_visited;
  static constexpr std::array<const Revisit*, 2> all{&none, &reverse_at_visited};
  return all;
}

}  // namespace runnel
