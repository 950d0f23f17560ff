#pragma once

#include <atomic>
#include <cstdint>

#include "core/lockfree/asymmetric_fence.h"

namespace runnel {

/// Tells which value lies in a slot of memory: 2 n once value n is there, 2 n - 1 while it is written. Readers look before
/// and after they read, and write nothing (a sequence lock, H. Boehm, "Can seqlocks get along with programming language
/// memory models?", 2012).
///
/// Threads: one writes at a time, any number read. Progress: wait-free; who reads too slowly is told so.
/// @tparam Atomic  replaced in tests.
template <template <typename> class Atomic = std::atomic>
class SlotUse {
 public:
  /// Before anything of value n, whose use is 2 n, is written.
  void BeginWriting(std::uint64_t use) noexcept {
    // relaxed: the fence has it come before all that is written then. It pairs with that in IsStill(): who has read
    // anything written after the one finds this mark, or a later one, after the other.
    state_.store(use - 1, std::memory_order_relaxed);
    Fences<Atomic>::Full();
  }
  /// When all of it is written.
  void EndWriting(std::uint64_t use) noexcept {
    // release: pairs with the acquire in Is(); who finds the use finds what was written.
    state_.store(use, std::memory_order_release);
  }

  /// Whether that value is there; it may go at any time.
  [[nodiscard]] bool Is(std::uint64_t use) const noexcept { return state_.load(std::memory_order_acquire) == use; }
  /// Whether all that has been read since Is() was of that value.
  [[nodiscard]] bool IsStill(std::uint64_t use) const noexcept {
    Fences<Atomic>::Full();
    return state_.load(std::memory_order_relaxed) == use;  // relaxed: as said in BeginWriting()
  }

 private:
  Atomic<std::uint64_t> state_{0};
};

}  // namespace runnel
