#include <algorithm>

#include "core/plugin/plugin_entry.h"
#include "modules/planning/bug_planner.h"

namespace {

using namespace runnel;

// Nearer to the goal than the hit point, as Class1, and a metre of the way to the goal is free.
class CloserWithRoom final : public LeaveCondition {
 public:
  std::string_view name() const override { return "closer_with_room"; }
  std::optional<LeavePoint> Find(const BugView& view) const override {
    const double distance = DistanceToGoal(view);
    const double wanted = view.state.hit_distance - view.configuration.leave_margin;
    const bool has_room = FreeRangeTowardsGoal(view) >= std::min(1.0, distance);
    if (distance >= wanted || !has_room) return std::nullopt;
    return LeavePoint{Position(view.input.pose)};
  }
};

class PatientBug final : public BugPlanner {
 public:
  using BugPlanner::BugPlanner;

 private:
  BugComponents Components() const override {
    static const CloserWithRoom leave;
    BugComponents components = Assemble({.direction = DirectionKind::kAlternate});
    components.leave = &leave;
    return components;
  }
};

}  // namespace

RUNNEL_PLUGIN(patient_bug, registry) {
  registry.Add<PatientBug>("patient/bug", "leaves obstacles where it has come nearer and has room");
}
