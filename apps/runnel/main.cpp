#include <algorithm>
#include <iostream>
#include <type_traits>

#include "apps/runnel/check_command.h"
#include "apps/runnel/command_line.h"
#include "apps/runnel/control_command.h"
#include "apps/runnel/graph_command.h"
#include "apps/runnel/modules_command.h"
#include "apps/runnel/other_programs.h"
#include "apps/runnel/run_command.h"
#include "apps/runnel/schema_command.h"
#include "apps/runnel/standard_output.h"
#include "core/base/exception_text.h"

namespace runnel::program {

namespace {

ExitCode Do(const RunArguments& arguments) { return Run(arguments); }
ExitCode Do(const CheckArguments& arguments) { return Check(arguments); }
ExitCode Do(const ModulesArguments& arguments) { return ListModules(arguments); }
ExitCode Do(const SchemaArguments& arguments) { return WriteSchema(arguments); }
ExitCode Do(const GraphArguments& arguments) { return DrawGraph(arguments); }
ExitCode Do(const ControlArguments& arguments) { return Control(arguments); }
ExitCode Do(const VersionArguments&) {
  std::cout << "runnel " RUNNEL_VERSION "\n";
  return ExitCode::kDone;
}
ExitCode Do(ExitCode code) { return code; }

bool IsOtherCommand(const std::string& word) {
  const std::vector<std::string> commands = OtherCommands();
  return std::ranges::find(commands, word) != commands.end();
}

ExitCode DoWhatIsAsked(int count, char** words) {
  try {
    if (count > 1 && IsOtherCommand(words[1])) {
      const std::string why_not = BecomeProgram(words[1], words + 1);
      std::cerr << "error: " << why_not << '\n';
      return ExitCode::kRunFailed;
    }
    const CommandLine command = ParseCommandLine(count, words);
    return std::visit([](const auto& what) { return Do(what); }, command);
  } catch (...) {  // plugins may throw anything
    std::cerr << "error: " << runnel::DescribeException() << '\n';
  }
  return ExitCode::kRunFailed;
}

}  // namespace

}  // namespace runnel::program

int main(int count, char** words) {
  using namespace runnel::program;
  OutliveReaders();
  ExitCode code = DoWhatIsAsked(count, words);
  if (!FinishOutput()) {
    std::cerr << "error: standard output could not be written\n";
    if (code == ExitCode::kDone) code = ExitCode::kRunFailed;
  }
  return static_cast<int>(code);
}
