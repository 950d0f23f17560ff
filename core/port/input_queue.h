#pragma once

#include <atomic>
#include <cstdint>

#include "core/lockfree/bounded_queue.h"
#include "core/port/lease.h"
#include "core/port/port_options.h"
#include "core/port/subscribers.h"

namespace runnel {

/// The values that wait at one input, from all its sources, in the order of their coming.
///
/// Threads: Push() by any publisher, Pop() by the reader. Progress: lock-free. Allocation: none.
template <typename T>
class InputQueue final : public QueueSink {
 public:
  struct Entry {
    internal::HeldValue<T> held;
    std::uint64_t source = 0;  // the channel's number
  };

  InputQueue(std::size_t capacity, OnFull on_full) : queue_(capacity), on_full_(on_full) {}

  /// Returns false if the queue was full and refuses. Ends after a few attempts in any case: a
  /// publisher never waits for a reader that was stopped while it emptied the very cell that is
  /// needed; then the new value is dropped, whatever the policy.
  bool Push(Entry entry) noexcept {
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
      if (queue_.TryPush(std::move(entry))) return true;
      if (on_full_ != OnFull::kDropOldest) break;
      // Not full and yet no room: a reader is at work there, and dropping others would not help.
      if (queue_.size() < queue_.capacity()) continue;
      Entry oldest;
      if (queue_.TryPop(oldest)) CountDropped();
    }
    CountDropped();
    return on_full_ != OnFull::kRefuse;
  }
  [[nodiscard]] bool Pop(Entry& entry) noexcept { return queue_.TryPop(entry); }

  [[nodiscard]] std::size_t room() const noexcept override { return queue_.capacity(); }
  [[nodiscard]] std::size_t size() const noexcept { return queue_.size(); }
  [[nodiscard]] OnFull on_full() const noexcept { return on_full_; }
  [[nodiscard]] std::uint64_t dropped() const noexcept {
    return dropped_.load(std::memory_order_relaxed);
  }

 private:
  static constexpr int kAttempts = 16;

  // relaxed: a statistic.
  void CountDropped() noexcept { dropped_.fetch_add(1, std::memory_order_relaxed); }

  BoundedQueue<Entry> queue_;
  const OnFull on_full_;
  std::atomic<std::uint64_t> dropped_{0};
};

}  // namespace runnel
