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

  /// Returns false if the queue was full and refuses.
  bool Push(Entry entry) noexcept {
    while (!queue_.TryPush(std::move(entry))) {
      // relaxed: a statistic.
      dropped_.fetch_add(1, std::memory_order_relaxed);
      if (on_full_ == OnFull::kRefuse) return false;
      if (on_full_ == OnFull::kDropNewest) return true;
      Entry oldest;
      if (!queue_.TryPop(oldest)) {
        // A reader has just made room, or is making it: then nothing was dropped.
        dropped_.fetch_sub(1, std::memory_order_relaxed);
      }
    }
    return true;
  }
  [[nodiscard]] bool Pop(Entry& entry) noexcept { return queue_.TryPop(entry); }

  [[nodiscard]] std::size_t room() const noexcept override { return queue_.capacity(); }
  [[nodiscard]] std::size_t size() const noexcept { return queue_.size(); }
  [[nodiscard]] OnFull on_full() const noexcept { return on_full_; }
  [[nodiscard]] std::uint64_t dropped() const noexcept {
    return dropped_.load(std::memory_order_relaxed);
  }

 private:
  BoundedQueue<Entry> queue_;
  const OnFull on_full_;
  std::atomic<std::uint64_t> dropped_{0};
};

}  // namespace runnel
