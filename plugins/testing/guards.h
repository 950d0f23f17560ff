#pragma once

#include <cstddef>

#include "plugins/real_time_check/real_time_hooks.h"
#include "plugins/real_time_check/system_call_trap.h"

namespace runnel::test {

/// Counts what the calling thread takes from and gives back to the heap while the guard lives:
///
///     const AllocationGuard guard;
///     output.Publish(value);
///     EXPECT_EQ(guard.allocations(), 0u);
///
/// The program that links this library has its malloc family replaced by a counting one, for all
/// libraries in it; operator new comes through malloc.
///
/// Threads:  one guard belongs to one thread and sees only that thread. May be nested.
/// Under a sanitizer, which has a malloc of its own, nothing is counted: works() is false, and both
/// counts stay 0.
class AllocationGuard {
 public:
  [[nodiscard]] static bool works() noexcept { return RunnelRealTimeHooks()->works; }
  /// malloc, calloc, realloc, aligned_alloc and their like, and operator new.
  [[nodiscard]] std::size_t allocations() const noexcept {
    return RunnelRealTimeHooks()->counts().allocations - before_.allocations;
  }
  /// free() of something, and operator delete.
  [[nodiscard]] std::size_t releases() const noexcept {
    return RunnelRealTimeHooks()->counts().releases - before_.releases;
  }

 private:
  RealTimeHooks::Counts before_ = RunnelRealTimeHooks()->counts();
};

/// Counts the locks that the calling thread takes, or tries to take, while the probe lives: mutexes
/// and reader-writer locks.
///
/// The program that links this library has these pthread functions replaced, for all libraries in
/// it. Locks inside of the C library itself are not seen.
///
/// Threads:  one probe belongs to one thread and sees only that thread.
/// Under a sanitizer nothing is counted, and works() is false.
class LockProbe {
 public:
  [[nodiscard]] static bool works() noexcept { return RunnelRealTimeHooks()->works; }
  [[nodiscard]] std::size_t locks() const noexcept { return RunnelRealTimeHooks()->counts().locks - before_; }

 private:
  std::size_t before_ = RunnelRealTimeHooks()->counts().locks;
};

/// Notices whether the calling thread enters the kernel while the probe lives, by the kernel's
/// "syscall user dispatch" (Linux 5.11, x86-64). The call is then made as usual.
///
/// Threads:  one probe at a time in a thread; it sees only that thread.
/// Where the kernel cannot do this, works() is false and nothing is noticed.
class SystemCallProbe {
 public:
  SystemCallProbe() noexcept {
    first_call = -1;
    if (works()) SystemCallTrap::Arm([](long call, const void*) noexcept { first_call = call; });
  }
  ~SystemCallProbe() { (void)Stop(); }
  SystemCallProbe(const SystemCallProbe&) = delete;
  SystemCallProbe& operator=(const SystemCallProbe&) = delete;

  [[nodiscard]] static bool works() noexcept { return SystemCallTrap::works(); }
  /// Ends the watch. The number of the first system call that was made, -1 if there was none.
  [[nodiscard]] long Stop() noexcept {
    if (works()) SystemCallTrap::Remove();
    return first_call;
  }

 private:
  static inline thread_local constinit volatile long first_call = -1;
};

}  // namespace runnel::test
