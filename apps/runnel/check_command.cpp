#include "apps/runnel/check_command.h"

#include <iostream>

#include "apps/runnel/workplace.h"

namespace runnel::program {

ExitCode Check(const CheckArguments& arguments) {
  Workplace workplace;
  const BuildOutcome outcome = workplace.Build(arguments.application, BuildMode::kCheck);
  const std::size_t errors = outcome.diagnostics.errors().size();
  if (errors > 0) {
    std::cerr << errors << (errors == 1 ? " error\n" : " errors\n");
    return ExitCode::kBadInput;
  }
  std::cout << arguments.application.file << ": no errors\n";
  return ExitCode::kDone;
}

}  // namespace runnel::program
