#pragma once

namespace runnel::test {

/// Notices whether the calling thread enters the kernel while the probe lives, by the kernel's
/// "syscall user dispatch" (Linux 5.11, x86-64). The call is then made as usual.
///
/// Threads:  one probe at a time in a thread; it sees only that thread.
/// Where the kernel cannot do this, works() is false and nothing is noticed.
class SystemCallProbe {
 public:
  SystemCallProbe() noexcept;
  ~SystemCallProbe();
  SystemCallProbe(const SystemCallProbe&) = delete;
  SystemCallProbe& operator=(const SystemCallProbe&) = delete;

  [[nodiscard]] static bool works() noexcept;
  /// Ends the watch. The number of the first system call that was made, -1 if there was none.
  [[nodiscard]] long Stop() noexcept;
};

}  // namespace runnel::test
