#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "core/element/runtime.h"
#include "core/port/port.h"
#include "plugins/scheduling/scheduler.h"
#include "plugins/supervision/supervision_rules.h"
#include "plugins/supervision/watches.h"

namespace runnel {

/// Errors: its type is neither a number nor bool.
[[nodiscard]] Result<void> CheckStopButton(const Port& port);

namespace internal {

class ButtonElement;

/// Presses the STOP of the robot for each value that is not 0 at a port, and again if somebody else releases it while that is
/// the newest; follows the port through renames and swaps. When the port is gone, set by hand, or what feeds it does not run,
/// nobody can press any more: that presses, too.
///
/// Threads: has one of its own, which waits for values, and for no lock. Construct and destroy outside of cycles.
class StopButton {
 public:
  using Tell = std::function<void(Notice)>;
  /// Precondition: the port is there, and good.
  StopButton(Runtime& runtime, const Scheduler& scheduler, StopButtonRule rule, Tell tell);
  ~StopButton();
  StopButton(const StopButton&) = delete;
  StopButton& operator=(const StopButton&) = delete;

 private:
  void Work();
  void TakeValues();
  /// False: somebody has the structure lock, so that nothing is known.
  bool LookForPort();
  void Press(const std::string& by);

  Runtime& runtime_;
  const Scheduler& scheduler_;
  StopButtonRule rule_;  // with the path where the port is now
  const Tell tell_;
  std::unique_ptr<ButtonElement> element_;
  bool is_down_ = false;
  std::uint64_t pressed_ = 0;  // RobotStop::State::requests after its own press, if nobody else has pressed meanwhile
  std::optional<RobotStop::AsOf> let_go_;  // nobody could look yet whether that was by the button itself
  bool is_covered_ = false;  // by a value by hand
  bool is_gone_ = false;
  bool is_at_rest_ = false;  // what feeds it
  std::optional<Feeding> feeding_;  // as of the structure's revision
  std::uint64_t revision_ = ~std::uint64_t{};
  std::atomic<bool> ends_{false};
  std::thread thread_;
};

}  // namespace internal

}  // namespace runnel
