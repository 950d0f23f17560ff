#pragma once

#include <csignal>

#include "plugins/scheduling/scheduler.h"

namespace runnel::program {

/// While it lives, Ctrl-C and SIGTERM ask the scheduler to stop, so that the run ends in order. A
/// second one ends the program at once.
///
/// One at a time.
class StopSignal {
 public:
  explicit StopSignal(Scheduler& scheduler);
  ~StopSignal();
  StopSignal(const StopSignal&) = delete;
  StopSignal& operator=(const StopSignal&) = delete;

  [[nodiscard]] bool has_come() const noexcept;

 private:
  struct sigaction interrupt_before_ {};
  struct sigaction terminate_before_ {};
};

}  // namespace runnel::program
