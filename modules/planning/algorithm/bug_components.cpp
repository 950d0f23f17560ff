#include "modules/planning/algorithm/bug_components.h"

namespace runnel {

namespace {

// The condition that demands the same, but not on the M-line.
LeaveKind WithoutTheLine(const LeaveCondition& condition) {
  return condition.name() == ComponentFor(LeaveKind::kMLineClosestSoFar).name()
             ? LeaveKind::kClosestSoFar
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
