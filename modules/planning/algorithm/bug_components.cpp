#include "modules/planning/algorithm/bug_components.h"

#include <algorithm>
#include <array>
#include <cmath>
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
  [[nodiscard]] Waypoint Target(const BugView& view) const override { return {view.input.goal, {}}; }
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

constexpr double kHeadOn = DegreesToRadians(5.0);  // rad; both turns are the same

class FixedDirection final : public DirectionChoice {
 public:
  explicit constexpr FixedDirection(BoundaryDirection direction) : direction_(direction) {}
  [[nodiscard]] std::string_view name() const override {
    return direction_ == BoundaryDirection::kLeft ? "left" : "right";
  }
  [[nodiscard]] BoundaryDirection Choose(const BugView&, double) const override { return direction_; }

 private:
  BoundaryDirection direction_;
};

class LocalDirection final : public DirectionChoice {
 public:
  [[nodiscard]] std::string_view name() const override { return "local"; }
  [[nodiscard]] BoundaryDirection Choose(const BugView& view, double contact_bearing) const override {
    if (view.state.node_side) return *view.state.node_side;
    const double bearing = WrapAngle(contact_bearing);
    if (std::abs(bearing) < kHeadOn) return view.configuration.first_direction;
    return bearing > 0.0 ? BoundaryDirection::kRight : BoundaryDirection::kLeft;
  }
};

class AlternateDirection final : public DirectionChoice {
 public:
  [[nodiscard]] std::string_view name() const override { return "alternate"; }
  [[nodiscard]] BoundaryDirection Choose(const BugView& view, double) const override {
    return view.state.last_direction ? Opposite(*view.state.last_direction) : view.configuration.first_direction;
  }
};

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

// The condition that demands the same, but not on the M-line.
LeaveKind WithoutTheLine(const LeaveCondition& condition) {
  return condition.name() == ComponentFor(LeaveKind::kMLineClosestSoFar).name() ? LeaveKind::kClosestSoFar
                                                                                : LeaveKind::kCloserThanHit;
}

std::string Quoted(std::string_view name) { return "'" + std::string(name) + "'"; }

std::string NamesWithoutRange() {
  std::string names;
  for (const LeaveCondition* condition : AllLeaveConditions()) {
    if (condition->needs_range_sensor()) continue;
    names += (names.empty() ? "" : ", ") + Quoted(condition->name());
  }
  return names;
}

}  // namespace

std::span<const MotionToGoal* const> AllMotions() {
  static const StraightMotion straight;
  static const MLineMotion m_line;
  static const TangentMotion tangent;
  static constexpr std::array<const MotionToGoal*, 3> all{&straight, &m_line, &tangent};
  return all;
}

std::span<const DirectionChoice* const> AllDirections() {
  static const FixedDirection left(BoundaryDirection::kLeft);
  static const FixedDirection right(BoundaryDirection::kRight);
  static const LocalDirection local;
  static const AlternateDirection alternate;
  static constexpr std::array<const DirectionChoice*, 4> all{&left, &right, &local, &alternate};
  return all;
}

std::span<const Revisit* const> AllRevisits() {
  static const NoRevisit none;
  static const ReverseAtVisited reverse_at_visited;
  static constexpr std::array<const Revisit*, 2> all{&none, &reverse_at_visited};
  return all;
}

std::uint64_t BugComponents::Fingerprint() const {
  std::uint64_t hash = 0xcbf29ce484222325U;  // FNV-1a
  for (const std::string_view name : {motion->name(), leave->name(), revisit->name()}) {
    for (const char character : name) {
      hash = (hash ^ static_cast<unsigned char>(character)) * 0x100000001b3U;
    }
    hash = (hash ^ 0xffU) * 0x100000001b3U;
  }
  return hash == 0 ? 1 : hash;
}

BugComponents Assemble(const BugComposition& composition) {
  return {&ComponentFor(composition.motion), &ComponentFor(composition.direction), &ComponentFor(composition.leave),
          &ComponentFor(composition.revisit)};
}

std::optional<Misfit> FindMisfit(const BugComponents& components) {
  const LeaveCondition& leave = *components.leave;
  if (leave.needs_m_line() && !components.motion->follows_m_line()) {
    return Misfit{"the leave condition " + Quoted(leave.name()) + " needs the line from start to goal, which motion " +
                      Quoted(components.motion->name()) + " does not follow",
                  "take motion " + Quoted(ComponentFor(MotionKind::kMLine).name()) + ", or leave " +
                      Quoted(ComponentFor(WithoutTheLine(leave)).name())};
  }
  return std::nullopt;
}

std::optional<Misfit> FindMisfit(const BugComponents& components, const Surroundings& surroundings) {
  if (!components.leave->needs_range_sensor() || surroundings.sensor_range > 0.0F) {
    return std::nullopt;
  }
  return Misfit{"the leave condition " + Quoted(components.leave->name()) +
                    " needs a sensor that sees how far the way is free; this one only feels (sensor_range 0)",
                "take a laser or infrared rangers, or one of the leave conditions " + NamesWithoutRange()};
}

}  // namespace runnel
