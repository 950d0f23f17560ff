#include "core/lockfree/futex.h"

#include <cerrno>
#include <climits>
#include <ctime>

#include <linux/futex.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace runnel {

bool KernelFutex::SleepOn(const void* word, std::uint32_t expected, Deadline deadline, Waiters waiter) noexcept {
  const auto since_start = deadline.time_since_epoch();
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(since_start);
  const std::chrono::nanoseconds rest = since_start - seconds;
  const timespec until{.tv_sec = seconds.count(), .tv_nsec = rest.count()};
  // Of the two ways to sleep, this one takes a point of time, on the monotonic clock: who is
  // interrupted and sleeps again does not sleep longer for it.
  const long result = syscall(SYS_futex, word, FUTEX_WAIT_BITSET | FUTEX_PRIVATE_FLAG, expected,
                              deadline == kNever ? nullptr : &until, nullptr, waiter);
  return result == 0 || errno != ETIMEDOUT;
}

void KernelFutex::WakeOn(const void* word, Waiters waiters) noexcept {
  syscall(SYS_futex, word, FUTEX_WAKE_BITSET | FUTEX_PRIVATE_FLAG, INT_MAX, nullptr, nullptr, waiters);
}

}  // namespace runnel
