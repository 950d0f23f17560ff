#include <algorithm>
#include <iostream>
#include <string>
#include <string_view>
#include <vector>

#include "apps/runnel/command_line.h"
#include "apps/runnel/other_programs.h"
#include "apps/runnel/output.h"
#include "core/base/error.h"

namespace runnel::program {

namespace {

// "runnel check FILE.gen": a description of a component, which another program reads.
bool ChecksDescription(int count, char** words) {
  return count > 2 && words[1] == std::string_view("check") &&
         std::any_of(words + 2, words + count, [](std::string_view word) { return word.ends_with(".gen"); });
}

ExitCode CheckDescription(int count, char** words) {
  std::string command = "generate";
  std::vector<char*> all(words, words + count + 1);  // with the null at the end
  all[0] = command.data();
  const std::string why_not = BecomeProgram(command, all.data());  // returns only then
  std::cerr << "error: " << why_not << '\n';
  return ExitCode::kRunFailed;
}

ExitCode DoWhatIsAsked(int count, char** words) {
  try {
    if (ChecksDescription(count, words)) return CheckDescription(count, words);
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
