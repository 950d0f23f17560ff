#include "apps/runnel/modules_command.h"

#include <iostream>

#include "apps/runnel/module_listing.h"
#include "apps/runnel/plugin_choice.h"
#include "apps/runnel/print_error.h"
#include "plugins/application/application_description.h"

namespace runnel::program {

ExitCode ListModules(const ModulesArguments& arguments) {
  ApplicationDescription surroundings;
  ExitCode code =
      LoadChosenPlugins(arguments.plugins, surroundings) ? ExitCode::kDone : ExitCode::kBadInput;
  for (const ModuleType* type : surroundings.plugins().modules().All()) {
    if (arguments.names_only) {
      std::cout << type->name << '\n';
    } else if (auto listed = ListModule(*type, surroundings, std::cout); !listed) {
      PrintError(listed.error());
      code = ExitCode::kBadInput;
    }
  }
  return code;
}

}  // namespace runnel::program
