#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace runnel {

/// A program and how it is to run, without input.
struct ProgramStart {
  std::vector<std::string> words;     ///< the program, which is looked for in PATH, and its arguments
  std::filesystem::path folder = {};  ///< "": this process's
  bool keeps_complaints = false;      ///< what it writes to stderr is a part of its output; otherwise it is lost
};

struct ProgramOutput {
  std::string text = {};
  int exit_code = 0;  ///< -1: a signal has ended it
};

/// Runs a program, without a shell, and waits for its end.
///
/// Threads: any. Errors: it cannot be started, with the system's words.
[[nodiscard]] Result<ProgramOutput> OutputOf(ProgramStart start);

}  // namespace runnel
