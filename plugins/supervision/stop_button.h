#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <thread>

#include "core/element/runtime.h"
#include "core/port/port.h"
#include "plugins/scheduling/scheduler.h"
#include "plugins/supervision/supervision_rules.h"

namespace runnel {

/// Errors: its type is neither a number nor bool; it is to release, and is not the output of the button's own driver, or of interface
/// ports to which that alone is connected. Nothing may be connected yet.
[[nodiscard]] Result<void> CheckStopButton(const Port& port, bool releases);

namespace internal {

class ButtonElement;

/// Presses the STOP of the robot for each value that is not 0 at a port, and again if somebody else releases it while that is
/// the newest; follows the port through renames and swaps. When the port is gone, or somewhere on the way to it a value is set by
/// hand, a module does not run or nothing is connected any more, nobody can press: each of these presses, too. The way goes
/// through modules that pass on values of the button's type, as an input says that has an age or passes it on (Ageing). It releases only
/// at the output of the button's own driver: what is made of something else may be 0 as that was lost.
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
  void Look();
  void TakeValues();
  /// False: somebody has the structure lock, so that nothing is known.
  bool LookForPort();
  void Press(std::initializer_list<std::string_view> by) noexcept;
  void TellOfHeldStop(const std::string& why);

  Runtime& runtime_;
  const Scheduler& scheduler_;
  StopButtonRule rule_;  // with the path where the port is now
  const Tell tell_;
  std::unique_ptr<ButtonElement> element_;
  struct Down {
    std::uint64_t source;  // ProbePort::last_source()
    ValueTimes times;
  };
  bool is_set_by_hand_ = false;  // as of the last look
  std::optional<Down> down_;     // the newest value, if it was not 0
  std::uint64_t dropped_ = 0;
  std::uint64_t pressed_ = 0;    // RobotStop::State::requests after its own press, if nobody else has pressed meanwhile
  std::uint64_t let_go_by_ = 0;  // ProbePort::last_source()
  std::optional<RobotStop::AsOf> let_go_;  // nobody could look yet whether that was by the button itself
  bool is_gone_ = false;
  std::set<std::string> lacks_;             // why nobody could press, as of the last look
  std::string why_not_;                     // let it not release, as of then; "": nothing
  std::string told_;                        // why it releases nothing, of the STOP that is in force
  std::map<std::string, std::size_t> fed_;  // how many connections there have been, by ports on the way
  const Port* button_ = nullptr;            // as of the last look, to be compared only
  std::atomic<bool> ends_{false};
  std::thread thread_;
};

}  // namespace internal

}  // namespace runnel
