#include "core/plugin/plugin_entry.h"
#include "modules/planning/algorithm/bug1.h"
#include "modules/planning/algorithm/bug2.h"
#include "modules/planning/bug_planner.h"

RUNNEL_PLUGIN(planning, registry) {
  using namespace runnel;
  registry.Add<BugPlannerOf<Bug1>>(
      "planning/bug1", "goes once round each obstacle, leaves where it was nearest to the goal");
  registry.Add<BugPlannerOf<Bug2>>(
      "planning/bug2", "leaves obstacles where it meets the line from start to goal again");
}
