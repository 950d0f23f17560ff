#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "apps/runnel/command_line.h"

namespace runnel::program {

/// The commands that talk to a running application, on the command line.
class ControlCommandLine {
 public:
  /// Adds them to `program`, which must not outlive this.
  explicit ControlCommandLine(CLI::App& program);

  /// After parsing: which of them it was, if any.
  [[nodiscard]] std::optional<ControlArguments> Parsed() const;

 private:
  struct Entry {
    CLI::App* command = nullptr;
    ControlArguments arguments;
  };
  std::deque<Entry> entries_;  // whose addresses the parser keeps
};

/// Of all of these commands: "-n", "--queue".
[[nodiscard]] std::vector<std::string> OptionsWithValue();

/// Lets numbers below 0 stand where a value is asked for: `runnel set /a/b -1`, which would be taken
/// for an option.
[[nodiscard]] std::vector<const char*> WithNegativeValues(int count, const char* const* words);

}  // namespace runnel::program
