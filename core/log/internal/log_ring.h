#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <utility>

#include <boost/lockfree/spsc_queue.hpp>

namespace runnel::internal {

/// Where the messages of one thread wait to be formatted: bytes, of whole messages.
///
/// Lives for ever, and is handed to the next thread that logs when its own has ended.
/// Threads:     Push() by the thread that has it, Pop() and TakeLost() by one reader at a time.
/// Progress:    wait-free. A message for which there is no room is lost, and counted.
/// Allocation:  in the constructor only.
class LogRing {
 public:
  static constexpr std::size_t kCapacity = std::size_t{64} << 10;

  void Push(const std::byte* message, std::size_t size) noexcept {
    // Only this thread fills, so what is free now stays free.
    if (bytes_.write_available() < size) {
      // relaxed: a count, which one thread writes.
      lost_.store(lost_.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
      return;
    }
    (void)bytes_.push(message, size);
  }
  /// False if nothing waits. A message whose first bytes are there is there as a whole.
  bool Pop(void* into, std::size_t size) noexcept { return bytes_.pop(static_cast<std::byte*>(into), size) == size; }
  [[nodiscard]] std::uint64_t TakeLost() noexcept {
    const std::uint64_t lost = lost_.load(std::memory_order_relaxed);
    return lost - std::exchange(lost_taken_, lost);
  }

  /// One that no living thread has. Allocates.
  [[nodiscard]] static LogRing& Take();
  /// By its thread, at its end; what waits in it is read nevertheless.
  void GiveBack() noexcept {
    // release: pairs with the acquire in Take(): the next owner pushes after this one.
    taken_.store(false, std::memory_order_release);
  }
  /// Calls `visit` for each ring that there is.
  template <typename Visit>
  static void ForEach(Visit&& visit) {
    // acquire: pairs with the release in Take(): the ring is complete.
    for (LogRing* ring = first_.load(std::memory_order_acquire); ring != nullptr; ring = ring->next_) visit(*ring);
  }

 private:
  static std::atomic<LogRing*> first_;

  boost::lockfree::spsc_queue<std::byte> bytes_{kCapacity};
  std::atomic<std::uint64_t> lost_{0};
  std::uint64_t lost_taken_ = 0;   // the reader's
  std::atomic<bool> taken_{true};  // by a living thread
  LogRing* next_ = nullptr;        // constant once added
};

}  // namespace runnel::internal
