#include <iostream>

#include "apps/runnel/commands.h"
#include "plugins/application/application_description.h"

namespace runnel::program {

ExitCode Check(const ApplicationArguments& arguments) {
  ApplicationDescription description(arguments.Options());
  (void)description.Read(arguments.file);
  std::cerr << description.diagnostics().ToString();
  const std::size_t errors = description.diagnostics().errors().size();
  if (errors > 0) {
    std::cerr << errors << (errors == 1 ? " error\n" : " errors\n");
    return ExitCode::kBadInput;
  }
  std::cout << arguments.file << ": no errors\n";
  return ExitCode::kDone;
}

}  // namespace runnel::program
