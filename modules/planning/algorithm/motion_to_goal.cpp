#include "modules/planning/algorithm/motion_to_goal.h"

#include <algorithm>
#include <limits>

#include "modules/planning/algorithm/m_line.h"
#include "modules/planning/algorithm/tangent_graph.h"

namespace runnel {

namespace {

constexpr double kLineLookahead = 0.40;  // m
constexpr double kLowering = 0.02;       // m by which a node must be nearer to the goal
constexpr double kNoLowering = -std::numeric_limits<double>::infinity();

}  // namespace

Waypoint StraightMotion::Target(const BugView& view) const { return {view.input.goal, {}}; }

Waypoint MLineMotion::Target(const BugView& view) const {
  const MLine line(view.state.line_start, view.input.goal);
  return {line.PointAhead(Position(view.input.pose), kLineLookahead), {}};
}

Waypoint TangentMotion::Target(const BugView& view) const {
  const Point2 goal = view.input.goal;
  const double range = ViewRange(view);
  if (FreeRangeTowardsGoal(view) >= std::min(DistanceToGoal(view), range)) return {goal, {}};
  const TangentGraph graph(view.input.surroundings, view.input.pose, PassingRadius(view), range);
  if (const auto node = graph.BestNode(goal, kLowering)) return {node->place, node->side};
  const auto node = graph.BestNode(goal, kNoLowering);
  return {goal, node ? std::optional(node->side) : std::nullopt};
}

}  // namespace runnel
