#pragma once

#include <atomic>
#include <cstdint>

namespace runnel {

/// By which others keep a runner between two of its cycles for a moment. Cycles pay one load of a line
/// that hardly ever changes.
///
/// Who closes the gate and then finds, by the runner's CycleQuiescence, that no cycle is under way that
/// began before, knows that none begins until it opens the gate: closing, heavy fence, looking at the
/// quiescence on one side; entering the guard, light fence, looking at the gate on the other.
///
/// Threads:  Close() and Open() in pairs, by any number of threads; the rest by the runner's.
class CycleGate {
 public:
  void Close() noexcept { closed_.fetch_add(1, std::memory_order_seq_cst); }
  void Open() noexcept {
    // release: pairs with the acquire in is_closed() and WaitUntilOpen(): the next cycle sees all
    // that was changed meanwhile.
    if (closed_.fetch_sub(1, std::memory_order_release) == 1) closed_.notify_all();
  }

  [[nodiscard]] bool is_closed() const noexcept {
    return closed_.load(std::memory_order_acquire) != 0;
  }
  /// Outside of the cycle and of its guard: this sleeps.
  void WaitUntilOpen() const noexcept {
    for (std::uint32_t closed = closed_.load(std::memory_order_acquire); closed != 0;
         closed = closed_.load(std::memory_order_acquire)) {
      closed_.wait(closed, std::memory_order_acquire);
    }
  }

 private:
  std::atomic<std::uint32_t> closed_{0};
};

}  // namespace runnel
