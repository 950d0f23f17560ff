#include <algorithm>
#include <iostream>

#include "apps/runnel/command_line.h"
#include "apps/runnel/other_programs.h"
#include "apps/runnel/output.h"
#include "core/base/exception_text.h"

namespace runnel::program {

namespace {

ExitCode DoWhatIsAsked(int count, char** words) {
  try {
    if (count > 1 && std::ranges::count(OtherCommands(), std::string(words[1])) > 0) {
      const std::string why_not = BecomeProgram(words[1], words + 1);
      std::cerr << "error: " << why_not << '\n';
      return ExitCode::kRunFailed;
    }
    return ParseCommandLine(count, words)();
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
