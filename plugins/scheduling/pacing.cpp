#include "plugins/scheduling/pacing.h"

#include <algorithm>

#include "core/base/check.h"
#include "plugins/scheduling/sleep_until.h"

namespace runnel {

namespace {

constexpr double kLongestWait = 4e9;  // s; what a Time can hold, less the machine's own time

}  // namespace

Pacing::Pacing(double speed, const Clock& real) : speed_(speed), real_(real) {
  RUNNEL_CHECK(Takes(speed), "the speed of simulated time is 0 or from 1e-6 to 1e6");
}

Time Pacing::Deadline(Time simulated) {
  const Time now = real_.Now();
  if (speed_ == 0) return now;
  const auto deadline = [&] {
    const double wait = ToSeconds(simulated - simulated_start_) / speed_;
    return real_start_ + FromSeconds(std::min(wait, kLongestWait));
  };
  if (!is_tied_ || deadline() + kLongestLag < now) {
    is_tied_ = true;
    simulated_start_ = simulated;
    real_start_ = now;
  }
  return deadline();
}

void Pacing::WaitFor(Time simulated, const std::function<bool()>& give_up) {
  if (speed_ == 0) return;
  SleepUntil(Deadline(simulated), give_up);
}

}  // namespace runnel
