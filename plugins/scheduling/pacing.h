#pragma once

#include <functional>

#include "core/base/clock.h"

namespace runnel {

/// Lets simulated time pass no faster than `speed` times real time. It only ever delays cycles, so
/// what they compute does not depend on it.
///
/// Threads: one, but for what the clock allows.
class Pacing {
 public:
  static constexpr double kSlowest = 1e-6;
  static constexpr double kFastest = 1e6;
  /// Beyond these bounds deadlines would leave what a Time can hold.
  [[nodiscard]] static constexpr bool Takes(double speed) noexcept {
    return speed == 0 || (speed >= kSlowest && speed <= kFastest);
  }

  /// speed 0: as fast as it can. `real` must outlive this. Precondition: Takes(speed).
  Pacing(double speed, const Clock& real);

  /// When, on the real clock, the simulated time `simulated` is due. The first call ties the two
  /// clocks together; so does one that finds the simulation more than kLongestLag behind, so that
  /// it does not race after a pause.
  [[nodiscard]] Time Deadline(Time simulated);

  /// Sleeps until `simulated` is due, or until `give_up()`, which is asked a few times a second.
  void WaitFor(Time simulated, const std::function<bool()>& give_up);

  static constexpr Duration kLongestLag = std::chrono::milliseconds(200);

 private:
  const double speed_;
  const Clock& real_;
  bool is_tied_ = false;
  Time simulated_start_{};
  Time real_start_{};
};

}  // namespace runnel
