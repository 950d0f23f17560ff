#include "apps/runnel/check_command.h"

#include <iostream>

#include "plugins/application/application_description.h"

namespace runnel::program {

ExitCode Check(const CheckArguments& arguments) {
  ApplicationDescription description(arguments.application.Options());
  (void)description.Read(arguments.application.file);
  std::cerr << description.diagnostics().ToString();
  const std::size_t errors = description.diagnostics().errors().size();
  if (errors > 0) {
    std::cerr << errors << (errors == 1 ? " error\n" : " errors\n");
    return ExitCode::kBadInput;
  }
  std::cout << arguments.application.file << ": no errors\n";
  return ExitCode::kDone;
}

}  // namespace runnel::program
