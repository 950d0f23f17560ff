#pragma once

#include <array>
#include <csignal>

#include "plugins/scheduling/scheduler.h"

namespace runnel::program {

/// While it lives, Ctrl-C, SIGTERM and SIGHUP ask the scheduler to stop, so that the run ends in
/// order. A second one, of whichever kind, is left to who asks for it (EndWatch), a third ends the program at once. What the caller of the program
/// has it ignore (nohup) stays ignored.
///
/// One at a time.
class StopSignal {
 public:
  /// Those that end a run.
  static constexpr std::array kSignals{SIGINT, SIGTERM, SIGHUP};

  explicit StopSignal(Scheduler& scheduler);
  ~StopSignal();
  StopSignal(const StopSignal&) = delete;
  StopSignal& operator=(const StopSignal&) = delete;

  /// While the newest of them has lived; also after it has gone, since what comes then ends the program at once.
  [[nodiscard]] static bool has_come() noexcept;
  /// A second one has.
  [[nodiscard]] static bool has_come_again() noexcept;

 private:
  std::array<struct sigaction, kSignals.size()> before_{};
};

}  // namespace runnel::program
