#pragma once

#include <atomic>

namespace runnel {

namespace internal {
// Set before main() if the kernel offers what HeavyFence() needs, constant from then on.
extern bool heavy_fence_is_heavy;
}  // namespace internal

/// The two halves of a store-load fence whose cost is borne by the side that seldom runs.
///
///     often:   store A ─ LightFence() ─ load B        (publishing, reading)
///     seldom:  store B ─ HeavyFence() ─ load A        (connecting, destroying)
///
/// As with a sequentially consistent fence on each side, at least one of the two sees the other's
/// store. Two light fences give no such promise to each other.
///
/// LightFence() keeps the compiler from reordering and costs nothing; HeavyFence() has the kernel
/// pass a fence through every running thread of the process (membarrier). On a kernel without it
/// both are full fences: slower, and as right. If it is refused later, the calling thread visits each
/// processor instead, which takes milliseconds.
///
/// Threads:   any. HeavyFence() is a system call of about a microsecond: never in a cycle.
/// Source:    the pair was proposed for C++ as P1202 (D. Goldblatt, "Asymmetric fences").
[[gnu::always_inline]] inline void FullFence() noexcept {
#if defined(__SANITIZE_THREAD__)
  // ThreadSanitizer has no fences; an operation that is one on every machine it runs on.
  std::atomic<int> nobodys{0};
  nobodys.exchange(1, std::memory_order_seq_cst);
#else
  std::atomic_thread_fence(std::memory_order_seq_cst);
#endif
}
[[gnu::always_inline]] inline void LightFence() noexcept {
  if (internal::heavy_fence_is_heavy) [[likely]] {
    std::atomic_signal_fence(std::memory_order_seq_cst);
  } else {
    FullFence();
  }
}
void HeavyFence() noexcept;

/// The fences that go with an atomic type: tests that put another atomic into a structure
/// specialise it, so that their search sees the fences too.
template <template <typename> class Atomic>
struct Fences {
  [[gnu::always_inline]] static void Full() noexcept { FullFence(); }
  [[gnu::always_inline]] static void Light() noexcept { LightFence(); }
  static void Heavy() noexcept { HeavyFence(); }
  [[nodiscard]] static bool HeavyIsHeavy() noexcept { return internal::heavy_fence_is_heavy; }
  /// A light fence where it orders nothing unless HeavyIsHeavy(): it does not ask for it.
  [[gnu::always_inline]] static void LightIfHeavyIsHeavy() noexcept {
    std::atomic_signal_fence(std::memory_order_seq_cst);
  }
};

}  // namespace runnel
