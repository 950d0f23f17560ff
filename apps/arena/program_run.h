#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace runnel::arena {

/// How a program has ended.
struct ProgramEnding {
  int exit_code = 0;
  int signal = 0;               ///< that ended it; 0: it ended by itself
  bool has_hung = false;        ///< it was ended because it took longer than it may
  double wall_time = 0.0;       ///< s
  double processor_time = 0.0;  ///< s
};

/// Runs a program beside this one, and waits for its end; ends it itself when it has taken `limit`, or when
/// `is_to_stop` becomes true. `words`: the program's file and its arguments. What it writes goes to the
/// file `output`. It is in a group of its own, so that Ctrl-C reaches only this program, and it dies
/// with this program, however that ends.
///
/// Threads: any, several at the same time. Errors: what the system says.
[[nodiscard]] Result<ProgramEnding> RunProgram(const std::vector<std::string>& words,
                                               const std::filesystem::path& output,
                                               std::chrono::duration<double> limit,
                                               const std::atomic<bool>& is_to_stop);

}  // namespace runnel::arena
