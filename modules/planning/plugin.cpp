#include <utility>

#include "core/plugin/plugin_entry.h"
#include "modules/planning/bug_planner.h"

RUNNEL_PLUGIN(planning, registry) {
  using namespace runnel;
  [&]<std::size_t... variants>(std::index_sequence<variants...>) {
    (registry.Add<BugPlannerOf<variants>>("planning/" + std::string(kBugVariants[variants].name),
                                          std::string(kBugVariants[variants].description)),
     ...);
  }
  (std::make_index_sequence<kBugVariants.size()>());
  registry.Add<ComposedBugPlanner>("planning/bug", "a variant of its own, composed of the components named");
}
