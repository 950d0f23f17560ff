#pragma once

#include <atomic>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/clock.h"
#include "core/element/robot_stop.h"
#include "plugins/command_service/lookout.h"

namespace runnel {

/// Presses the STOP of the robot when no operator has been heard for a stated time, as <operators> wants it. An operator is
/// a client who may drive: a page, a terminal, Python, Foxglove; each of its messages counts. The time is counted from
/// Begin() on. A release that none of them has asked for is followed by the next press at once.
///
/// Threads: any; one of its own presses, which takes neither the structure lock nor the worker.
class OperatorWatch {
 public:
  /// `watched_clock`: for tests, of a machine on which only Look() presses.
  explicit OperatorWatch(RobotStop& stop, const Clock* watched_clock = nullptr)
      : stop_(stop), watched_clock_(watched_clock), lookout_([this] { return Look(); }) {}

  /// Once.
  void Begin(Duration timeout);
  /// An operator, as people call him, has said something.
  void Hear(std::string_view name);
  /// Presses when it is time. When to look again; nothing: when STOP has been pressed or released.
  std::optional<Time> Look();
  /// 0: nobody has to be heard.
  [[nodiscard]] Duration timeout() const noexcept { return Duration(timeout_.load(std::memory_order_relaxed)); }

 private:
  [[nodiscard]] Time Now() const { return watched_clock_ != nullptr ? watched_clock_->Now() : SteadyClock().Now(); }

  RobotStop& stop_;
  const Clock* const watched_clock_;
  std::atomic<Duration::rep> timeout_{0};
  std::mutex mutex_;  // a leaf
  Time heard_{};      // guarded by mutex_
  std::string last_;  // so: who was heard then; "": nobody yet
  Lookout lookout_;
  StopSignal::Subscription changes_;  // first to go: it asks the lookout
};

}  // namespace runnel
