#include "apps/runnel/modules_command.h"

#include <iostream>

#include "apps/runnel/module_listing.h"
#include "apps/runnel/print_error.h"
#include "apps/runnel/workplace.h"
#include "plugins/runtime_construction/plugin_loading.h"

namespace runnel::program {

ExitCode ListModules(const ModulesArguments& arguments) {
  Workplace workplace;
  ExitCode code = ExitCode::kDone;
  const auto plugins =
      arguments.plugins.empty() ? workplace.plugins().Available() : arguments.plugins;
  for (const std::string& plugin : plugins) {
    const auto loaded = LoadPlugin(plugin, workplace.plugins(), workplace.tags());
    if (loaded) continue;
    PrintError(loaded.error());
    code = ExitCode::kBadInput;
  }
  for (const ModuleType* type : workplace.plugins().modules().All()) {
    if (auto listed = ListModule(*type, workplace, std::cout); !listed) {
      PrintError(listed.error());
      code = ExitCode::kBadInput;
    }
  }
  return code;
}

}  // namespace runnel::program
