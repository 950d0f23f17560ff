#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "modules/planning/algorithm/direction_choice.h"
#include "modules/planning/algorithm/leave_condition.h"
#include "modules/planning/algorithm/motion_to_goal.h"
#include "modules/planning/algorithm/revisit.h"

namespace runnel {

/// A choice of one component of each kind, as data.
struct BugComposition {
  MotionKind motion = MotionKind::kStraight;
  DirectionKind direction = DirectionKind::kLeft;
  LeaveKind leave = LeaveKind::kBestAfterLap;
  RevisitKind revisit = RevisitKind::kNone;

  friend constexpr bool operator==(const BugComposition&, const BugComposition&) = default;
};

/// The components themselves, that a BugAlgorithm is made of; own ones may be among them. They must
/// outlive it.
struct BugComponents {
  const MotionToGoal* motion = nullptr;
  const DirectionChoice* direction = nullptr;
  const LeaveCondition* leave = nullptr;
  const Revisit* revisit = nullptr;

  /// Tells apart who may not simply go on with what the other has remembered, by the names of the
  /// components but the direction; never 0.
  [[nodiscard]] std::uint64_t Fingerprint() const;
};

[[nodiscard]] inline const MotionToGoal& ComponentFor(MotionKind kind) {
  return *AllMotions()[static_cast<std::size_t>(kind)];
}
[[nodiscard]] inline const DirectionChoice& ComponentFor(DirectionKind kind) {
  return *AllDirections()[static_cast<std::size_t>(kind)];
}
[[nodiscard]] inline const LeaveCondition& ComponentFor(LeaveKind kind) {
  return *AllLeaveConditions()[static_cast<std::size_t>(kind)];
}
[[nodiscard]] inline const Revisit& ComponentFor(RevisitKind kind) {
  return *AllRevisits()[static_cast<std::size_t>(kind)];
}

[[nodiscard]] BugComponents Assemble(const BugComposition& composition);

/// Why components do not fit together, and what would.
struct Misfit {
  std::string message;
  std::string hint;
};
/// Nothing if they fit. Allocates.
[[nodiscard]] std::optional<Misfit> FindMisfit(const BugComponents& components);
/// Nothing if the components can do with what the sensors tell.
[[nodiscard]] std::optional<Misfit> FindMisfit(const BugComponents& components,
                                               const Surroundings& surroundings);

}  // namespace runnel
