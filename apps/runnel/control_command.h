#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/runnel/exit_code.h"

namespace runnel::program {

/// What is asked of a running application.
struct ControlArguments {
  std::string command = {};      ///< "ls", as on the command line
  std::string application = {};  ///< name or process; "": the only one
  std::vector<std::string> words = {};
  std::optional<int> count = {};
  bool is_long = false;
  bool is_full = false;
  bool follows = false;
  std::optional<std::string> queue = {};
  std::optional<std::string> on_full = {};
  std::optional<std::string> probation = {};
  std::string file = {};         ///< of a recording
  std::string compression = {};  ///< likewise
};

/// Asks it and shows the answer: on stdout what was asked for, on stderr what is wrong.
[[nodiscard]] ExitCode Control(const ControlArguments& arguments);

}  // namespace runnel::program
