#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>

#include "core/base/clock.h"

namespace runnel {

/// What a TickClock counts and what it goes by.
struct MachineTicks {
  /// Whether the processor's counter runs at one speed, whatever the processor does.
  [[nodiscard]] static bool AreSteady() noexcept;
  [[nodiscard]] static std::uint64_t Count() noexcept {
#if defined(__x86_64__)
    return __builtin_ia32_rdtsc();  // <x86intrin.h> alone takes half a second to compile
#else
    return 0;
#endif
  }
  [[nodiscard]] static Time Now() noexcept { return SteadyClock().Now(); }
};

/// The machine's steady clock for a thread that asks for the time all the time: asks the system
/// once a millisecond, and counts the processor's ticks in between (a third of the cost or less).
///
/// The rate of the ticks is measured from one question to the next, and is gone by only while two
/// measurements in a row agree to one in a thousand; else, and on processors without a steady
/// counter, every call asks the system. So it stays within two microseconds of the steady
/// clock; a counter that jumps, as from one processor to another, is noticed within a millisecond
/// and cannot mislead it by more. It never goes backwards.
///
/// Threads: one. Allocation: none. @tparam Machine  replaced in tests.
template <typename Machine>
class BasicTickClock {
 public:
  [[nodiscard, gnu::always_inline]] Time Now() noexcept {
    // A counter that has gone back makes this huge.
    const std::uint64_t since = Machine::Count() - asked_at_;
    if (since >= trusted_) return last_ = std::max(last_, Ask());
    const Duration passed(static_cast<std::int64_t>((since * scale_) >> kScaleBits));
    return last_ = std::max(last_, answer_ + passed);
  }

  static constexpr Duration kInterval = std::chrono::milliseconds(1);

 private:
  [[nodiscard, gnu::noinline]] Time Ask() noexcept {
    const std::uint64_t before = Machine::Count();
    const Time now = Machine::Now();
    // An answer that was long in coming says nothing of the rate.
    const bool came_at_once = Machine::Count() - before < kAtOnce;
    if (are_steady_ && came_at_once && now - answer_ >= kInterval) Measure(before, now);
    return now;
  }

  void Measure(std::uint64_t count, Time now) noexcept {
    const auto passed = static_cast<double>((now - answer_).count());
    const double rate = passed / static_cast<double>(count - asked_at_);
    const bool agrees = std::abs(rate - rate_) < 1e-3 * rate_;
    // The product in Now() is at most the interval in nanoseconds, scaled: it fits.
    trusted_ = agrees ? static_cast<std::uint64_t>(kIntervalInNanoseconds / rate) : 0;
    scale_ = agrees ? static_cast<std::uint64_t>(rate * (std::uint64_t{1} << kScaleBits)) : 0;
    rate_ = has_asked_ ? rate : 0;
    has_asked_ = true;
    asked_at_ = count;
    answer_ = now;
  }

  static constexpr int kScaleBits = 32;
  static constexpr std::uint64_t kAtOnce = 1000;
  static constexpr double kIntervalInNanoseconds = static_cast<double>(kInterval.count());

  const bool are_steady_ = Machine::AreSteady();
  bool has_asked_ = false;
  std::uint64_t trusted_ = 0;  // ticks after the last question; 0: ask every time
  std::uint64_t asked_at_ = 0;
  std::uint64_t scale_ = 0;  // the rate, as a fraction of 2 to the kScaleBits
  double rate_ = 0;          // nanoseconds per tick, between the last two questions
  Time answer_{};
  Time last_{};
};

using TickClock = BasicTickClock<MachineTicks>;

}  // namespace runnel
