#include "plugins/timing/pacing.h"

#include <algorithm>

#include "core/base/check.h"

namespace runnel {

namespace {

constexpr double kLongestWait = 4e9;  // s; what a Time can hold, less the machine's own time
constexpr const char* kBounds = "the speed of simulated time is 0 or from 1e-6 to 1e6";

}  // namespace

Pacing::Pacing(double speed, const Clock& real) : speed_(speed), real_(real) { RUNNEL_CHECK(Takes(speed), kBounds); }

Time Pacing::Deadline(Time simulated) {
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

void Pacing::SetSpeed(double speed) {
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
