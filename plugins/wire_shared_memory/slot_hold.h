#pragma once

#include <atomic>
#include <cstdint>

#include "core/lockfree/asymmetric_fence.h"

namespace runnel {

/// Tells which value lies in a slot of memory: 2 n once value n is there, 2 n - 1 while it is written. Written by the writer
/// only. Together with a SlotHold of each reader it sees to it that nothing is written while anybody reads: the writer marks
/// and then looks who holds, a reader holds and then looks for the mark, and of the two at least one sees the other (hazard
/// pointers, M. Michael, 2004; Dekker's flags).
///
/// Threads: one writes at a time, any number read. Progress: wait-free.
/// @tparam Atomic  replaced in tests.
template <template <typename> class Atomic = std::atomic>
class SlotUse {
 public:
  /// Before anything of value n, whose use is 2 n, is written. False if `is_held()`: whether anybody holds the slot. Then the
  /// value that was there still is, and nothing may be written.
  template <typename IsHeld>
  [[nodiscard]] bool BeginWriting(std::uint64_t use, const IsHeld& is_held) noexcept {
    const std::uint64_t before = state_.load(std::memory_order_relaxed);  // relaxed: the writer's own
    // relaxed: the fence has it come before the look who holds. It pairs with that in SlotHold::Take(): who is not seen to
    // hold finds this mark.
    state_.store(use - 1, std::memory_order_relaxed);
    Fences<Atomic>::Full();
    if (!is_held()) return true;
    // release: as in EndWriting(), for those who ask for the value from now on.
    state_.store(before, std::memory_order_release);
    return false;
  }
  /// When all of it is written.
  void EndWriting(std::uint64_t use) noexcept {
    // release: pairs with the acquire in Is(); who finds the use finds what was written.
    state_.store(use, std::memory_order_release);
  }

  /// Whether that value is there. Who does not hold the slot may find it gone at any time.
  [[nodiscard]] bool Is(std::uint64_t use) const noexcept { return state_.load(std::memory_order_acquire) == use; }

 private:
  Atomic<std::uint64_t> state_{0};
};

/// Whether one reader holds a slot. Written by the reader only.
///
/// Threads: one takes at a time, any gives back what has been taken; the writer looks.
template <template <typename> class Atomic = std::atomic>
class SlotHold {
 public:
  /// False if the value of that use has gone, and if the slot is held already: then nothing may be read.
  [[nodiscard]] bool Take(const SlotUse<Atomic>& slot, std::uint64_t use) noexcept {
    // relaxed: an honest writer has seen it given back before it wrote what is asked for now.
    if (is_held_.load(std::memory_order_relaxed) != 0) return false;
    is_held_.store(1, std::memory_order_relaxed);
    Fences<Atomic>::Full();  // pairs with that in SlotUse::BeginWriting(): who finds no mark is seen to hold
    if (slot.Is(use)) return true;
    GiveBack();
    return false;
  }
  void GiveBack() noexcept {
    // release: pairs with the acquire in is_held(); all has been read before anything is written.
    is_held_.store(0, std::memory_order_release);
  }
  /// By the writer.
  [[nodiscard]] bool is_held() const noexcept { return is_held_.load(std::memory_order_acquire) != 0; }

 private:
  Atomic<std::uint64_t> is_held_{0};
};

}  // namespace runnel
