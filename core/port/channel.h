#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <utility>

#include "core/lockfree/latest_buffer.h"
#include "core/lockfree/latest_value.h"
#include "core/lockfree/thread_epoch.h"
#include "core/port/input_queue.h"
#include "core/port/lease.h"
#include "core/port/loan.h"
#include "core/port/subscribers.h"

namespace runnel {

/// What an output and the inputs connected to it share, apart from the type of the values: the
/// output publishes into its channel, and the inputs read from it.
///
/// Threads:  SetSubscribers() and SetOrdered() under the structure lock; the rest as stated.
class ChannelBase {
 public:
  ChannelBase();
  virtual ~ChannelBase();
  ChannelBase(const ChannelBase&) = delete;
  ChannelBase& operator=(const ChannelBase&) = delete;

  /// Different for each channel of the process, never 0, ascending with time.
  [[nodiscard]] std::uint64_t number() const noexcept { return number_; }
  [[nodiscard]] virtual std::uint64_t publications() const noexcept = 0;

  /// Swaps the list that publishers visit; the old one goes when nobody can still look at it.
  void SetSubscribers(Subscribers subscribers);
  /// A channel that shares an input with others numbers its values in one order with theirs.
  void SetOrdered(bool ordered) noexcept { ordered_.store(ordered, std::memory_order_relaxed); }
  /// Sees to it that `leases` values can wait in queues besides those that the pool's options plan
  /// for. Allocates.
  virtual void ReserveFor(std::size_t leases) = 0;

 protected:
  /// Inside an EpochGuard; nullptr if there are none.
  [[nodiscard]] const Subscribers* subscribers() const noexcept {
    // seq_cst: one order with the swap and the epoch's operations; see lockfree/epoch.h.
    return subscribers_.load(std::memory_order_seq_cst);
  }
  [[nodiscard]] std::uint64_t NextOrder() const noexcept {
    return ordered_.load(std::memory_order_relaxed) ? DrawOrder() : 0;
  }

 private:
  static std::uint64_t DrawOrder() noexcept;

  const std::uint64_t number_;
  std::atomic<const Subscribers*> subscribers_{nullptr};
  // relaxed: a publisher that sees the change late numbers one value less, which then counts as
  // older than all numbered ones.
  std::atomic<bool> ordered_{false};
};

/// A channel for values of type T.
///
/// Threads:     one thread at a time may Loan and Publish; any number may Read, inside a guard.
/// Progress:    Publish and Read are lock-free; see core/lockfree/README.md.
/// Allocation:  only in the constructor, ReserveFor(), and a growing pool (BufferPool).
template <typename T>
class Channel final : public ChannelBase {
 public:
  using Entry = typename InputQueue<T>::Entry;

  Channel(const PoolOptions& pool, typename BufferPool<T>::Factory factory)
      : storage_(pool, std::move(factory)) {}

  [[nodiscard]] Loan<T> MakeLoan() {
    if constexpr (kIsCheap<T>) {
      static_assert(std::is_default_constructible_v<T>,
                    "Loan() of a small type starts with T{}; publish a ready T instead");
      return Loan<T>(T{});
    } else {
      return Loan<T>(storage_.pool->Loan());
    }
  }

  PublishStatus Publish(Loan<T>&& loan, Time now) {
    if (!loan) return PublishStatus::kNoBuffer;
    if constexpr (kIsCheap<T>) {
      const T value = *loan;
      loan.Drop();
      return PublishValue(value, now);
    } else {
      auto* buffer = std::exchange(loan.slot_, nullptr);
      Publication& publication = buffer->publication;
      publication = {now.time_since_epoch().count(), storage_.published + 1, NextOrder()};
      const auto tag = storage_.pool->Share(*buffer);
      buffer->AddLease();  // ours, until the queues have been served
      storage_.newest.Replace(*storage_.pool, tag);
      // release: who counts the publication may read it.
      storage_.published_count.store(++storage_.published, std::memory_order_release);
      const internal::HeldValue<T> held(buffer);
      return Distribute(held);
    }
  }

  PublishStatus PublishValue(const T& value, Time now) requires(kIsCheap<T>) {
    const std::int64_t stamp = now.time_since_epoch().count();
    const std::uint64_t order = NextOrder();
    storage_.Publish(value, stamp, order);
    const EpochGuard guard;
    if (subscribers() == nullptr) return PublishStatus::kPublished;
    internal::HeldValue<T> held;
    new (&held.writable()) T(value);
    held.writable_publication() = {stamp, storage_.sequence(), order};
    return Distribute(held);
  }

  /// The newest value, or none. Call inside an EpochGuard if the channel may be going away.
  [[nodiscard]] internal::HeldValue<T> Read() const noexcept {
    if constexpr (kIsCheap<T>) {
      internal::HeldValue<T> held;
      storage_.Read(held.writable(), held.writable_publication());
      return held;
    } else {
      return internal::HeldValue<T>(storage_.newest.Read(*storage_.pool));
    }
  }

  [[nodiscard]] std::uint64_t publications() const noexcept override {
    if constexpr (kIsCheap<T>) {
      return storage_.sequence();
    } else {
      return storage_.published_count.load(std::memory_order_acquire);
    }
  }
  void ReserveFor([[maybe_unused]] std::size_t leases) override {
    if constexpr (!kIsCheap<T>) {
      storage_.pool->Reserve(storage_.first_capacity + static_cast<std::uint32_t>(leases));
    }
  }
  /// How many buffers there are.
  [[nodiscard]] std::size_t buffers() const noexcept requires(!kIsCheap<T>) {
    return storage_.pool->capacity();
  }
  /// How often the pool had to allocate while running.
  [[nodiscard]] std::uint64_t growths() const noexcept {
    if constexpr (kIsCheap<T>) {
      return 0;
    } else {
      return storage_.pool->growths();
    }
  }

 private:
  struct CheapStorage : LatestValue<T> {
    CheapStorage(const PoolOptions&, typename BufferPool<T>::Factory&&) {}
  };
  struct BufferStorage {
    BufferStorage(const PoolOptions& options, typename BufferPool<T>::Factory&& factory)
        : pool(BufferPool<T>::Make(options, std::move(factory))),
          first_capacity(pool->capacity()) {}
    ~BufferStorage() { newest.Clear(*pool); }

    typename BufferPool<T>::Owner pool;
    const std::uint32_t first_capacity;
    LatestBuffer<T> newest;
    std::uint64_t published = 0;  // the publisher's own
    std::atomic<std::uint64_t> published_count{0};
  };

  PublishStatus Distribute(const internal::HeldValue<T>& held) noexcept {
    const EpochGuard guard;
    const Subscribers* list = subscribers();
    if (list == nullptr) return PublishStatus::kPublished;
    PublishStatus status = PublishStatus::kPublished;
    for (QueueSink* sink : list->queues) {
      // The types are equal: connecting has checked it.
      auto* queue = static_cast<InputQueue<T>*>(sink);
      if (!queue->Push(Entry{held, number()})) status = PublishStatus::kRefused;
    }
    for (Waker* waker : list->wakers) waker->Wake();
    return status;
  }

  std::conditional_t<kIsCheap<T>, CheapStorage, BufferStorage> storage_;
};

}  // namespace runnel
