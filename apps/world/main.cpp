#include <iostream>

#include "apps/world/world_command.h"

namespace {

/// As those of `runnel`.
constexpr int kDone = 0, kFailed = 1, kBadInput = 2;

}  // namespace

int main(int count, char** words) {
  using namespace runnel::world_program;
  const auto arguments = ParseArguments(count, words);
  if (!arguments) {
    if (arguments.error().message.empty()) return kDone;
    std::cerr << "error: " << arguments.error().ToString() << '\n';
    return kBadInput;
  }
  if (const auto written = WriteGeneratedWorld(*arguments); !written) {
    std::cerr << "error: " << written.error().ToString() << '\n';
    return kFailed;
  }
  return kDone;
}
