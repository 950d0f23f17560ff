#include "apps/runnel/schema_command.h"

#include <iostream>

#include "apps/runnel/plugin_choice.h"
#include "apps/runnel/print_error.h"
#include "core/base/replace_file.h"
#include "plugins/application/application_description.h"
#include "plugins/application_files/schema.h"

namespace runnel::program {

ExitCode WriteSchema(const SchemaArguments& arguments) {
  ApplicationDescription surroundings;
  if (!LoadChosenPlugins(arguments.plugins, surroundings)) return ExitCode::kBadInput;
  Diagnostics diagnostics;
  const std::string text =
      SchemaText(surroundings.tags(), surroundings.plugins().modules(), diagnostics);
  std::cerr << diagnostics.ToString();
  if (!diagnostics.ok()) return ExitCode::kBadInput;
  if (arguments.output.empty()) {
    std::cout << text;
    return ExitCode::kDone;
  }
  const auto written = ReplaceFile(arguments.output, text);
  if (written) return ExitCode::kDone;
  PrintError(written.error());
  return ExitCode::kRunFailed;
}

}  // namespace runnel::program
