#include "modules/planning/algorithm/bug_components.h"

namespace runnel {

namespace {

constexpr std::array kLeaveKinds = {LeaveKind::kBestAfterLap,      LeaveKind::kMLineCloserThanHit,
                                    LeaveKind::kMLineClosestSoFar, LeaveKind::kClosestSoFar,
                                    LeaveKind::kFreeRangeStep,     LeaveKind::kReachBelowFollowed,
                                    LeaveKind::kCloserThanHit,     LeaveKind::kFree};

// The condition that demands the same, but not on the M-line.
LeaveKind WithoutTheLine(const LeaveCondition& condition) {
  return condition.name() == ComponentFor(LeaveKind::kMLineClosestSoFar).name()
             ? LeaveKind::kClosestSoFar
             : LeaveKind::kCloserThanHit;
}

std::string Quoted(std::string_view name) { return "'" + std::string(name) + "'"; }

std::string NamesWithoutRange() {
  std::string names;
  for (const LeaveKind kind : kLeaveKinds) {
    const LeaveCondition& condition = ComponentFor(kind);
    if (!condition.needs_range_sensor())
      names += (names.empty() ? "" : ", ") + Quoted(condition.name());
  }
  return names;
}

}  // namespace

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

const MotionToGoal& ComponentFor(MotionKind kind) {
  static const StraightMotion straight;
  static const MLineMotion m_line;
  static const TangentMotion tangent;
  if (kind == MotionKind::kMLine) return m_line;
  if (kind == MotionKind::kTangent) return tangent;
  return straight;
}

const DirectionChoice& ComponentFor(DirectionKind kind) {
  static const FixedDirection left(BoundaryDirection::kLeft);
  static const FixedDirection right(BoundaryDirection::kRight);
  static const LocalDirection local;
  static const AlternateDirection alternate;
  if (kind == DirectionKind::kRight) return right;
  if (kind == DirectionKind::kLocal) return local;
  if (kind == DirectionKind::kAlternate) return alternate;
  return left;
}

const LeaveCondition& ComponentFor(LeaveKind kind) {
  static const BestAfterLap best_after_lap;
  static const MLineCloserThanHit m_line_closer_than_hit;
  static const MLineClosestSoFar m_line_closest_so_far;
  static const ClosestSoFar closest_so_far;
  static const FreeRangeStep free_range_step;
  static const ReachBelowFollowed reach_below_followed;
  static const CloserThanHit closer_than_hit;
  static const FreeToGo free;
  switch (kind) {
    case LeaveKind::kBestAfterLap:
      return best_after_lap;
    case LeaveKind::kMLineCloserThanHit:
      return m_line_closer_than_hit;
    case LeaveKind::kMLineClosestSoFar:
      return m_line_closest_so_far;
    case LeaveKind::kClosestSoFar:
      return closest_so_far;
    case LeaveKind::kFreeRangeStep:
      return free_range_step;
    case LeaveKind::kReachBelowFollowed:
      return reach_below_followed;
    case LeaveKind::kCloserThanHit:
      return closer_than_hit;
    case LeaveKind::kFree:
      break;
  }
  return free;
}

const Revisit& ComponentFor(RevisitKind kind) {
  static const NoRevisit none;
  static const ReverseAtVisited reverse_at_visited;
  if (kind == RevisitKind::kReverseAtVisited) return reverse_at_visited;
  return none;
}

BugComponents Assemble(const BugComposition& composition) {
  return {&ComponentFor(composition.motion), &ComponentFor(composition.direction),
          &ComponentFor(composition.leave), &ComponentFor(composition.revisit)};
}

std::optional<Misfit> FindMisfit(const BugComponents& components) {
  const LeaveCondition& leave = *components.leave;
  if (leave.needs_m_line() && !components.motion->follows_m_line()) {
    return Misfit{"the leave condition " + Quoted(leave.name()) +
                      " needs the line from start to goal, which motion " +
                      Quoted(components.motion->name()) + " does not follow",
                  "take motion " + Quoted(ComponentFor(MotionKind::kMLine).name()) + ", or leave " +
                      Quoted(ComponentFor(WithoutTheLine(leave)).name())};
  }
  return std::nullopt;
}

std::optional<Misfit> FindMisfit(const BugComponents& components,
                                 const Surroundings& surroundings) {
  if (!components.leave->needs_range_sensor() || surroundings.sensor_range > 0.0F) {
    return std::nullopt;
  }
  return Misfit{
      "the leave condition " + Quoted(components.leave->name()) +
          " needs a sensor that sees how far the way is free; this one only feels "
          "(sensor_range 0)",
      "take a laser or infrared rangers, or one of the leave conditions " + NamesWithoutRange()};
}

}  // namespace runnel
