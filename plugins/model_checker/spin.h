#pragma once

#include <string>
#include <vector>

#include "core/base/result.h"

namespace runnel {

/// What is looked for in a model, and how.
struct SpinSearch {
  std::vector<std::string> definitions = {};  ///< of the preprocessor: "-DENDS"
  std::vector<std::string> options = {};      ///< behind -run: "-bfs", "-a"
  int limit = 60;                             ///< s
};

/// What Spin found: nothing, or a run.
struct SpinAnswer {
  bool holds = false;
  std::vector<std::string> run = {};  ///< the lines that the model writes in the run that breaks what must hold
  std::size_t repeats_from = 0;       ///< from this line on over and over; run.size(): it ends there
};

/// Has the model checker search a model, in a folder of its own that goes again, also if the process or the thread that asked
/// for it ends meanwhile. Takes a second or more; any thread.
/// Errors: spin, or the compiler that it needs, is not here; it has not seen everything in this time or in 2 GB; it says
/// something else.
[[nodiscard]] Result<SpinAnswer> RunSpin(const std::string& model, const SpinSearch& search);

}  // namespace runnel
