#include "modules/planning/algorithm/motion_to_goal.h"

#include <algorithm>
#include <array>
#include <limits>

#include "modules/planning/algorithm/m_line.h"
#include "modules/planning/algorithm/tangent_graph.h"

namespace runnel {

namespace {

constexpr double kLineLookahead = 0.40;  // m
constexpr double kLowering = 0.02;       // m by which a node must be nearer to the goal
constexpr double kNoLowering = -std::numeric_limits<double>::infinity();

class StraightMotion final : public MotionToGoal {
 public:
  [[nodiscard]] std::string_view name() const override { return "straight"; }
  [[nodiscard]] Waypoint Target(const BugView& view) const override {
    return {view.input.goal, {}};
  }
};

class MLineMotion final : public MotionToGoal {
 public:
  [[nodiscard]] std::string_view name() const override { return "m_line"; }
  [[nodiscard]] bool follows_m_line() const override { return true; }
  [[nodiscard]] Waypoint Target(const BugView& view) const override {
    const MLine line(view.state.line_start, view.input.goal);
    return {line.PointAhead(Position(view.input.pose), kLineLookahead), {}};
  }
};

class TangentMotion final : public MotionToGoal {
 public:
  [[nodiscard]] std::string_view name() const override { return "tangent"; }
  [[nodiscard]] Waypoint Target(const BugView& view) const override {
    const Point2 goal = view.input.goal;
    const double range = ViewRange(view);
    if (FreeRangeTowardsGoal(view) >= std::min(DistanceToGoal(view), range)) return {goal, {}};
    const TangentGraph graph(view.input.surroundings, view.input.pose, PassingRadius(view), range);
    if (const auto node = graph.BestNode(goal, kLowering)) return {node->place, node->side};
    const auto node = graph.BestNode(goal, kNoLowering);
    return {goal, node ? std::optional(node->side) : std::nullopt};
  }
};

}  // namespace

std::span<const MotionToGoal* const> AllMotions() {
  static const StraightMotion straight;
  static const MLineMotion m_line;
  static const TangentMotion tangent;
  static constexpr std::array<const MotionToGoal*, 3> all{&straight, &m_line, &tangent};
  return all;
}

}  // namespace runnel
