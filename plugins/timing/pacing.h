#pragma once

#include <algorithm>

#include "core/base/check.h"
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
  Pacing(double speed, const Clock& real) : speed_(speed), real_(real) { RUNNEL_CHECK(Takes(speed), kBounds); }

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
  static constexpr double kLongestWait = 4e9;  // s; what a Time can hold, less the machine's own time
  static constexpr const char* kBounds = "the speed of simulated time is 0 or from 1e-6 to 1e6";

  double speed_;
  const Clock& real_;
  bool is_tied_ = false;
  Time simulated_start_{};
  Time asked_for_{};  // last
  Time real_start_{};
};

inline Time Pacing::Deadline(Time simulated) {
  const Time now = real_.Now();
  asked_for_ = simulated;
  if (speed_ == 0) return now;
  const auto deadline = [&] {
    const double wait = ToSeconds(simulated - simulated_start_) / speed_;
    return real_start_ + FromSeconds(std::clamp(wait, -kLongestWait, kLongestWait));
  };
  if (!is_tied_ || deadline() + kLongestLag < now) {
    is_tied_ = true;
    simulated_start_ = simulated;
    real_start_ = now;
  }
  return deadline();
}

inline void Pacing::SetSpeed(double speed) {
  RUNNEL_CHECK(Takes(speed), kBounds);
  if (is_tied_ && speed_ != 0) {
    const Time now = real_.Now();
    const double passed = ToSeconds(now - real_start_) * speed_;
    const double needed = ToSeconds(asked_for_ - simulated_start_);
    simulated_start_ += FromSeconds(std::min(passed, needed));
    real_start_ = now;
  }
  is_tied_ = is_tied_ && speed_ != 0;
  speed_ = speed;
}

}  // namespace runnel
