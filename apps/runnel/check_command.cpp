#include <iostream>

#include <unistd.h>

#include "apps/runnel/commands.h"
#include "apps/runnel/output.h"
#include "plugins/application/application_description.h"

namespace runnel::program {

namespace {

// How many errors it has.
std::size_t CheckOne(const std::string& file, const ApplicationArguments& arguments, const std::string& model_file) {
  ApplicationDescription description(arguments.Options());
  (void)description.Read(file);
  description.RunChecks(model_file);
  std::cerr << Coloured(description.diagnostics().ToString(), STDERR_FILENO);
  const std::size_t errors = description.diagnostics().errors().size();
  if (errors == 0) std::cout << file << ": no errors\n" << std::flush;
  return errors;
}

// "a.xml b.xml goal_x=4": further files stand among the settings.
bool IsFile(const std::string& word) { return word.find('=') == std::string::npos; }

}  // namespace

ExitCode Check(const CheckArguments& check) {
  const ApplicationArguments& arguments = check.application;
  ApplicationArguments common = arguments;
  std::erase_if(common.settings, IsFile);
  std::size_t errors = CheckOne(arguments.file, common, check.model_file);
  for (const std::string& word : arguments.settings) {
    if (IsFile(word)) errors += CheckOne(word, common, {});
  }
  if (errors == 0) return ExitCode::kDone;
  std::cerr << errors << (errors == 1 ? " error\n" : " errors\n");
  return ExitCode::kBadInput;
}

}  // namespace runnel::program
