#include "apps/runnel/plugin_choice.h"

#include "apps/runnel/print_error.h"

namespace runnel::program {

bool LoadChosenPlugins(const std::vector<std::string>& chosen,
                       ApplicationDescription& surroundings) {
  bool all_are_there = true;
  for (const std::string& plugin : chosen.empty() ? surroundings.plugins().Available() : chosen) {
    const auto loaded = surroundings.plugins().Load(plugin);
    if (loaded) continue;
    PrintError(loaded.error());
    all_are_there = false;
  }
  return all_are_there;
}

}  // namespace runnel::program
