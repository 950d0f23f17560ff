#pragma once

#include "plugins/real_time_check/system_call_trap.h"

namespace runnel::test {

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
