#include "plugins/scheduling/pace.h"

#include <algorithm>
#include <mutex>
#include <string>

namespace runnel {

namespace {

constexpr Time kNever = Time::max();

}  // namespace

Pace::Pace(bool is_simulated, double speed, bool is_paused, const Clock& machine, bool follows_outside)
    : is_simulated_(is_simulated),
      follows_outside_(follows_outside),
      machine_(machine),
      pacing_(speed, machine),
      speed_(is_simulated ? speed : 1),
      is_paused_(is_simulated && is_paused),
      is_free_(speed == 0 && !is_paused && !follows_outside) {}

Result<void> Pace::Check(const char* what) const {
  if (is_simulated_ && !has_ended_.load(std::memory_order_acquire)) return {};
  if (is_simulated_)
    return Error{.message = "the run has ended", .hint = "'runnel restart' runs the application again"};
  return Error{.message = "real time cannot be " + std::string(what),
               .hint = "only of simulated time: <clock type=\"simulated\"/> in the application file"};
}

void Pace::Changed() {
  is_free_.store(!is_paused() && pacing_.speed() == 0 && !follows_outside_, std::memory_order_release);
  event_.Notify();
}

Result<void> Pace::Pause() {
  if (auto simulated = Check("paused"); !simulated) return simulated;
  const std::lock_guard lock(mutex_);
  is_paused_.store(true, std::memory_order_release);
  cycles_to_step_.store(0, std::memory_order_release);
  pacing_.Untie();
  Changed();
  return {};
}

Result<void> Pace::Resume() {
  if (auto simulated = Check("resumed"); !simulated) return simulated;
  const std::lock_guard lock(mutex_);
  if (is_paused()) pacing_.Untie();
  is_paused_.store(false, std::memory_order_release);
  cycles_to_step_.store(0, std::memory_order_release);
  Changed();
  return {};
}

Result<void> Pace::StepCycles(std::uint64_t count) {
  if (auto simulated = Check("stepped"); !simulated) return simulated;
  if (count < 1 || count > kMostCycles) {
    return Error{.message = std::to_string(count) + " cycles cannot be stepped",
                 .hint = "allowed is 1 .. " + std::to_string(kMostCycles)};
  }
  const std::lock_guard lock(mutex_);
  if (cycles_to_step() == 0) pacing_.Untie();
  is_paused_.store(true, std::memory_order_release);
  cycles_to_step_.store(std::min(cycles_to_step() + count, kMostCycles), std::memory_order_release);
  Changed();
  return {};
}

Result<void> Pace::SetSpeed(double speed) {
  if (auto simulated = Check("made faster or slower"); !simulated) return simulated;
  if (follows_outside_) {
    return Error{.message = "time passes as fast as the clock that it follows"};
  }
  if (!Pacing::Takes(speed)) {
    return Error{.message = "speed " + std::to_string(speed) + " is out of bounds",
                 .hint = "allowed is 0 (as fast as it can), or 1e-6 .. 1e6"};
  }
  const std::lock_guard lock(mutex_);
  pacing_.SetSpeed(speed);
  speed_.store(speed, std::memory_order_release);
  Changed();
  return {};
}

void Pace::End() {
  const std::lock_guard lock(mutex_);
  has_ended_.store(true, std::memory_order_release);
  cycles_to_step_.store(0, std::memory_order_release);
  Changed();
}

void Pace::Begin() { has_ended_.store(false, std::memory_order_release); }

Result<void> Pace::SetTime(Time time) {
  if (!follows_outside_) {
    return Error{.message = "this application follows no clock from outside",
                 .hint = "<clock type=\"outside\"/> in the application file has it do so"};
  }
  time = std::clamp(time, Time(-kFarthest), Time(kFarthest - Duration(1)));
  const std::lock_guard lock(mutex_);
  const auto before = outside_time();
  const Duration step = before ? time - shown_ : Duration{};
  if (before && step == Duration{}) return {};
  const bool jumps = step < Duration{} || step > kLongestStep;
  if (!std::exchange(has_jumped_, jumps) && jumps) jump_ = {shown_, time};
  shown_ = time;
  const Time here = !before ? time : jumps ? *before : *before + step;
  outside_lead_.store((here - time).count(), std::memory_order_release);
  outside_time_.store(here.time_since_epoch().count(), std::memory_order_release);
  event_.Notify();
  return {};
}

std::optional<std::pair<Time, Time>> Pace::TakeJump() {
  const std::lock_guard lock(mutex_);
  return std::exchange(jump_, {});
}

bool Pace::MayGoOnNow(Time due) {
  const std::lock_guard lock(mutex_);
  may_go_on_at_ = kNever;
  if (follows_outside_ && due > outside_time().value_or(Time::min())) return false;
  if (is_paused() && cycles_to_step() == 0) return false;
  may_go_on_at_ = pacing_.Deadline(due);
  if (machine_.Now() < may_go_on_at_) return false;
  is_a_step_ = is_paused();
  return true;
}

void Pace::CountStep() noexcept {
  is_a_step_ = false;
  const std::lock_guard lock(mutex_);
  const std::uint64_t left = cycles_to_step();
  if (left > 0) cycles_to_step_.store(left - 1, std::memory_order_release);
}

void Pace::Wait(Time latest) { event_.WaitUntil(std::min({may_go_on_at_, latest, machine_.Now() + kLongestSleep})); }

}  // namespace runnel
