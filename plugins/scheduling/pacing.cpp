#include "plugins/scheduling/pacing.h"

#include "core/base/check.h"
#include "plugins/scheduling/sleep_until.h"

namespace runnel {

Pacing::Pacing(double speed, const Clock& real) : speed_(speed), real_(real) {
  RUNNEL_CHECK(speed >= 0, "simulated time cannot run backwards");
}

Time Pacing::Deadline(Time simulated) {
  const Time now = real_.Now();
  if (speed_ == 0) return now;
  const auto deadline = [&] {
    return real_start_ + FromSeconds(ToSeconds(simulated - simulated_start_) / speed_);
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
