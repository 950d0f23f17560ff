#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>

namespace runnel {

/// Everything in Runnel that has to do with time uses these two. A Time counts from the start of
/// its clock: of the application for a simulated clock, of the machine for the steady one.
using Duration = std::chrono::nanoseconds;
struct TimeOrigin {
  using duration = Duration;
  using rep = Duration::rep;
  using period = Duration::period;
  using time_point = std::chrono::time_point<TimeOrigin>;
  static constexpr bool is_steady = true;
};
using Time = TimeOrigin::time_point;

[[nodiscard]] constexpr double ToSeconds(Duration duration) noexcept {
  return std::chrono::duration<double>(duration).count();
}
[[nodiscard]] constexpr double ToSeconds(Time time) noexcept { return ToSeconds(time.time_since_epoch()); }
/// Times are between -kFarthest and kFarthest, 146 years, so that the difference of two is a Duration.
constexpr Duration kFarthest{std::int64_t{1} << 62};
/// Rounds to the nearest nanosecond; what is beyond kFarthest is that, and what is no number is 0.
[[nodiscard]] constexpr Duration FromSeconds(double seconds) noexcept {
  constexpr double kMost = 4.6e9;
  if (!(seconds > -kMost && seconds < kMost)) {
    return seconds > 0 ? kFarthest : seconds < 0 ? -kFarthest : Duration::zero();
  }
  return Duration(static_cast<std::int64_t>(seconds * 1e9 + (seconds < 0 ? -0.5 : 0.5)));
}

/// Where time comes from. Threads: Now() may be called from any thread.
class Clock {
 public:
  virtual ~Clock() = default;
  [[nodiscard]] virtual Time Now() const noexcept = 0;
  /// Not later than Now(), and cheaper where a clock has such a reading: how much earlier, the clock says; but not
  /// before `event`, which has just happened by this clock.
  [[nodiscard]] virtual Time CoarseNow(Time /*event*/) const noexcept { return Now(); }
};

/// The machine's monotonic clock.
class SteadyClock final : public Clock {
 public:
  [[nodiscard]] Time Now() const noexcept override;
  /// The kernel's last timer tick, 1 to 10 ms ago at most, for a fifth of the cost.
  [[nodiscard]] Time CoarseNow(Time event) const noexcept override;
};

/// A clock that moves only when told to: simulated time, and time in tests.
/// Threads: Now() from any thread; Advance() and Set() from one thread at a time.
class ManualClock final : public Clock {
 public:
  [[nodiscard]] Time Now() const noexcept override { return Time(Duration(now_.load(std::memory_order_acquire))); }
  /// Never moves backwards: an earlier `time` is ignored.
  void Set(Time time) noexcept;
  void Advance(Duration duration) noexcept { Set(Now() + duration); }

 private:
  // release in Set(), acquire in Now(): who reads a time also sees what was done before it came.
  std::atomic<std::int64_t> now_{0};
};

/// `time` plus a duration, or the last time that a Time can hold: users may write durations of
/// centuries. Precondition: duration >= 0.
[[nodiscard]] constexpr Time SaturatingSum(Time time, Duration duration) noexcept {
  // Times before the clock's start leave room for any duration.
  if (time > Time{} && duration > Time::max() - time) return Time::max();
  return time + duration;
}

}  // namespace runnel
