#pragma once

#include <string>

#include "plugins/control/command.h"

namespace runnel {

/// One step through the history of changes, and what it was: "undone: set /robot/arm/speed 0.3"; "" if
/// there was nothing to take back or to do again.
struct HistoryStep {
  ChangeOutcome outcome;
  std::string what;
};

/// Takes the newest change back, or does again what was taken back last, and writes it into the log.
/// Precondition: the application has a history. Threads: one that may wait.
[[nodiscard]] HistoryStep TakeHistoryStep(const ControlledApplication& application, bool goes_back);

}  // namespace runnel
