#pragma once

#include "core/base/clock.h"

namespace runnel {

/// When simulated time is due on the machine's clock, if it is to pass no faster than `speed` times
/// real time.
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

  [[nodiscard]] double speed() const noexcept { return speed_; }
  /// From what is due now on, time passes at another speed. Precondition: Takes(speed).
  void SetSpeed(double speed);
  /// The next call of Deadline() ties the clocks together anew.
  void Untie() noexcept { is_tied_ = false; }

  static constexpr Duration kLongestLag = std::chrono::milliseconds(200);

 private:
  double speed_;
  const Clock& real_;
  bool is_tied_ = false;
  Time simulated_start_{};
  Time asked_for_{};  // last
  Time real_start_{};
};

}  // namespace runnel
