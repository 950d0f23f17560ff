#pragma once

namespace runnel {

/// Notices when the calling thread enters the kernel, by the kernel's "syscall user dispatch" (Linux 5.11, x86-64).
///
/// Threads:     all is of the calling thread alone.
/// Allocation:  none.
struct SystemCallTrap {
  /// Called in a signal handler, before the call is made as usual. `place` is behind its instruction.
  using Listener = void (*)(long call, const void* place) noexcept;

  /// Whether the kernel can do this; under a sanitizer it is not done. Enters the kernel when asked first.
  [[nodiscard]] static bool works() noexcept;
  /// `listener` is told of the next call of this thread, and then of none until this is called again. Enters the
  /// kernel when the thread calls it first. Precondition: works().
  static void Arm(Listener listener) noexcept;
  /// Nobody is told.
  static void Disarm() noexcept;
  /// Disarms, and the kernel no longer asks at each call.
  static void Remove() noexcept;
};

}  // namespace runnel
