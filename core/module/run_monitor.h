#pragma once

#include <optional>
#include <string>

#include "core/base/result.h"
#include "core/element/annotation.h"

namespace runnel {

/// How a run ended, in the words of the module that judges it.
struct RunOutcome {
  std::string verdict;   ///< one word: "reached", "unreachable", "timeout", "collision" …
  std::string summary;   ///< one line for a person: path length, time
  bool success = false;  ///< decides the exit code of the program that ran the application
};

/// "I know how the run is going, and when it is over": the annotation by which a program that runs
/// an application shows progress and learns the end, without knowing what the application is about.
///
/// Threads:  all functions are called by the program between cycles, or by another thread than the
///           module's: implementations hand over by lock-free means.
class RunMonitor : public Annotation {
 public:
  /// A few words on how it is going, for one line of a terminal: "2.31 m to the goal, following".
  [[nodiscard]] virtual std::string Progress() const = 0;
  /// Empty while the run goes on.
  [[nodiscard]] virtual std::optional<RunOutcome> Outcome() const = 0;
  /// The run is over, by Outcome() or because the program was asked to stop: write files, if any,
  /// and say in one line each what was written ("" if nothing). Called once, after the last cycle.
  /// Errors: something could not be written; the run then counts as failed.
  virtual Result<std::string> Finish() { return std::string(); }
};

}  // namespace runnel
