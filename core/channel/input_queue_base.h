#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>

#include "core/channel/channel_options.h"
#include "core/channel/subscribers.h"
#include "core/lockfree/cache_line.h"

namespace runnel {

/// How many publishers fill a queue: those of one source take turns, and count as one.
enum class Writers { kOne, kSeveral };

/// What can be known of an input's queue, and done with it, without the type of
/// its values.
class InputQueueBase : public QueueSink {
 public:
  [[nodiscard]] std::size_t capacity() const noexcept final { return capacity_; }
  [[nodiscard]] OnFull on_full() const noexcept { return on_full_; }
  [[nodiscard]] Writers writers() const noexcept { return writers_; }
  [[nodiscard]] std::uint64_t dropped() const noexcept { return dropped_.load(std::memory_order_relaxed); }
  [[nodiscard]] virtual std::size_t size() const noexcept = 0;
  /// Whether Pop() would find something. By the reader.
  [[nodiscard]] virtual bool HasNext() const noexcept = 0;
  /// Whether the queue would refuse a value now. For publishers.
  [[nodiscard]] virtual bool WouldRefuse() noexcept = 0;
  /// Takes the oldest value out and counts it as dropped, if the queue drops the oldest. Any thread.
  virtual bool DropOldest() noexcept = 0;

  /// How many values wait in queues that this one has replaced: they take their share of its capacity,
  /// else much might wait after some changes. Told before publishers find the queue, then by the
  /// reader.
  void SetWaitingBefore(std::size_t count) noexcept {
    // relaxed, both: a little more or less capacity for a moment does not matter.
    if (waiting_before_.load(std::memory_order_relaxed) == count) return;
    waiting_before_.store(count, std::memory_order_relaxed);
  }

  /// The epoch since which no publisher that enters finds the queue; 0 while they can. Under the
  /// structure lock.
  std::uint64_t left_in_epoch = 0;

 protected:
  InputQueueBase(std::size_t capacity, OnFull on_full, Writers writers) noexcept
      : capacity_(capacity), on_full_(on_full), writers_(writers) {}

  // Whether what waits in older queues fills this one's capacity.
  [[nodiscard]] bool IsCrowdedOut() const noexcept {
    const std::size_t before = waiting_before_.load(std::memory_order_relaxed);
    return before > 0 && on_full_ != OnFull::kDropOldest && before + size() >= capacity_;
  }
  // Counts a value that is not taken in; false if its publisher is to know.
  [[gnu::noinline]] bool Drop() noexcept {
    CountDropped();
    return on_full_ != OnFull::kRefuse;
  }
  // relaxed: a statistic.
  void CountDropped() noexcept { dropped_.fetch_add(1, std::memory_order_relaxed); }

  const std::size_t capacity_;
  const OnFull on_full_;
  const Writers writers_;

 private:
  std::atomic<std::size_t> waiting_before_{0};
  alignas(kCacheLineSize) std::atomic<std::uint64_t> dropped_{0};
};

}  // namespace runnel
