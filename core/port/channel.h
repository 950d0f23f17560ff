#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <memory>
#include <utility>

#include "core/base/check.h"
#include "core/lockfree/asymmetric_fence.h"
#include "core/lockfree/latest_buffer.h"
#include "core/lockfree/latest_value.h"
#include "core/lockfree/thread_epoch.h"
#include "core/port/input_queue.h"
#include "core/port/lease.h"
#include "core/port/loan.h"
#include "core/port/pull_point.h"
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

  /// Swaps the list that publishers visit; the old one goes when nobody can still look at it. A value
  /// whose publisher does not find the new list is seen by who reads the newest value from now on.
  void SetSubscribers(Subscribers subscribers);
  /// A channel that shares an input with others numbers its values in one order with theirs.
  void SetOrdered(bool ordered) noexcept { ordered_.store(ordered, std::memory_order_relaxed); }
  /// Sees to it that `leases` values can wait in queues besides those that the pool's options plan
  /// for. Allocates.
  virtual void ReserveFor(std::size_t leases) = 0;

 protected:
  /// Whom to visit after publishing; nullptr if nobody, and to be called again inside an
  /// EpochGuard if somebody.
  [[nodiscard]] const Subscribers* subscribers() const noexcept {
    // Between publishing and looking for subscribers; pairs with the heavy fence in
    // SetSubscribers(): the publisher sees the subscriber, or that one sees the value.
    LightFence();
    // acquire: pairs with the release in SetSubscribers().
    return subscribers_.load(std::memory_order_acquire);
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
/// Threads:     one thread at a time may Loan and Publish; any number may Read and Pull, inside a
///              guard.
/// Progress:    Publish and Read are lock-free; see core/lockfree/README.md.
/// Allocation:  only in the constructor, ReserveFor(), and a growing pool (BufferPool).
template <typename T>
class Channel final : public ChannelBase {
 public:
  using Provider = typename PullPoint<T>::Provider;

  Channel(const PoolOptions& pool, typename BufferPool<T>::Factory factory, bool pullable = false)
      : pull_point_(pullable ? std::make_unique<PullPoint<T>>() : nullptr),
        storage_(pool, std::move(factory), pullable) {}

  [[nodiscard]] Loan<T> MakeLoan() {
    if constexpr (kIsCheap<T>) {
      static_assert(std::is_default_constructible_v<T>,
                    "Loan() of a small type starts with T{}; publish a ready T instead");
      return Loan<T>(T{});
    } else {
      return Loan<T>(storage_.newest.Loan(ThisThread().hazards));
    }
  }

  PublishStatus Publish(Loan<T>&& loan, Time now) {
    if (!loan) return PublishStatus::kNoBuffer;
    if constexpr (!kIsCheap<T>) {
      RUNNEL_CHECK(&loan.slot_->pool() == storage_.pool.get(),
                   "a loan can be published only by the output that gave it");
    }
    if (pull_point_ != nullptr) [[unlikely]]
      return InTurn([&] { return PublishInTurn(std::move(loan), now); });
    return PublishInTurn(std::move(loan), now);
  }
  PublishStatus PublishValue(const T& value, Time now) requires(kIsCheap<T>) {
    if (pull_point_ != nullptr) [[unlikely]]
      return InTurn([&] { return PublishCopy(value, now); });
    return PublishCopy(value, now);
  }

  /// May have a provider.
  [[nodiscard]] bool is_pullable() const noexcept { return pull_point_ != nullptr; }
  /// See Output::SetProvider(). Precondition: is_pullable().
  void SetProvider(Provider provider) { pull_point_->SetProvider(std::move(provider)); }
  /// Each of the two has the other's from then on. Precondition: both are pullable.
  void ExchangeProviders(Channel& other) { pull_point_->ExchangeProviders(*other.pull_point_); }
  [[nodiscard]] std::uint64_t pull_failures() const noexcept {
    return pull_point_ != nullptr ? pull_point_->failures() : 0;
  }
  /// Has the provider, if there is one and nobody is publishing just now, make a value in this
  /// thread and publishes it with the time that `now()` returns then. Any thread, inside a guard.
  template <typename Now>
  void Pull(const Now& now) noexcept {
    if constexpr (kCanPull) {
      if (pull_point_ == nullptr || !pull_point_->has_provider()) return;
      const typename PullPoint<T>::Turn turn(*pull_point_);
      if (!turn.held()) return;
      try {
        Loan<T> loan = LoanForPull();
        if (!loan) return pull_point_->CountFailure();
        if (pull_point_->Run(*loan)) (void)PublishInTurn(std::move(loan), now());
      } catch (...) {
        pull_point_->CountFailure();
      }
    }
  }

  /// Whether a queue that refuses is full.
  [[nodiscard]] bool WouldRefuse() const noexcept {
    if (subscribers() == nullptr) return false;
    return Guarded([this] {
      const Subscribers* list = subscribers();
      return list != nullptr && std::ranges::any_of(list->queues, &QueueSink::WouldRefuse);
    });
  }

  /// The newest value, or none. Call inside an EpochGuard.
  [[nodiscard, gnu::always_inline]] internal::HeldValue<T> Read() noexcept {
    if constexpr (kIsCheap<T>) {
      return internal::HeldValue<T>(storage_);
    } else {
      return internal::HeldValue<T>(storage_.newest, internal::thread_record->hazards);
    }
  }
  /// Copies the newest value to `value`; false if there is none. Call inside an EpochGuard.
  [[gnu::always_inline]] bool Copy(T& value) noexcept requires(std::is_trivially_copyable_v<T>) {
    if constexpr (kIsCheap<T>) {
      return storage_.Read(value);
    } else {
      const auto lease = storage_.newest.Lease(internal::thread_record->hazards);
      if (lease.get() == nullptr) return false;
      value = std::as_const(*lease.get()).value();
      return true;
    }
  }

  [[nodiscard]] std::uint64_t publications() const noexcept override {
    if constexpr (kIsCheap<T>) {
      return storage_.sequence();
    } else {
      return storage_.published_count.load(std::memory_order_relaxed);
    }
  }
  void ReserveFor([[maybe_unused]] std::size_t leases) override {
    if constexpr (!kLiesInQueuesAsCopy<T>) {
      // Some more than can wait at once, so that the publisher seldom looks through all of them.
      const std::size_t spare = leases / 4;
      const auto buffers = storage_.first_capacity + static_cast<std::uint32_t>(leases + spare);
      storage_.pool->Reserve(buffers);
      if (storage_.pool_for_pulls) storage_.pool_for_pulls->Reserve(buffers);
    }
  }
  /// How many buffers there are for Loan().
  [[nodiscard]] std::size_t buffers() const noexcept requires(!kIsCheap<T>) {
    return storage_.pool->capacity();
  }
  /// How often the pool had to allocate while running.
  [[nodiscard]] std::uint64_t growths() const noexcept {
    if constexpr (kIsCheap<T>) {
      return 0;
    } else {
      return storage_.pool->growths() +
             (storage_.pool_for_pulls ? storage_.pool_for_pulls->growths() : 0);
    }
  }

  /// A provider begins with T{}, as a loan does, or with what lies in a buffer.
  static constexpr bool kCanPull = !kIsCheap<T> || std::is_default_constructible_v<T>;

 private:
  struct CheapStorage : LatestValue<T> {
    CheapStorage(const PoolOptions&, typename BufferPool<T>::Factory&&, bool) {}
  };
  struct BufferStorage {
    using Pool = BufferPool<T>;
    BufferStorage(const PoolOptions& options, typename Pool::Factory&& factory, bool pullable)
        : pool_for_pulls(pullable ? Pool::Make(ProcessHazards(), options, factory) : nullptr),
          pool(Pool::Make(ProcessHazards(), options, std::move(factory))),
          first_capacity(pool->capacity()),
          newest(*pool) {}

    // So that a loan is the publisher's own business also while a reader pulls.
    typename BufferPool<T>::Owner pool_for_pulls;
    typename BufferPool<T>::Owner pool;
    const std::uint32_t first_capacity;
    LatestBuffer<T> newest;
    std::uint64_t published = 0;  // the publisher's own
    // relaxed: a count; who reads the value looks again.
    std::atomic<std::uint64_t> published_count{0};
  };

  // The rest of publishing, by who has the turn, if there are turns.
  [[gnu::always_inline]] PublishStatus PublishInTurn(Loan<T>&& loan, Time now) {
    if constexpr (kIsCheap<T>) {
      const T value = *loan;
      loan.Drop();
      return PublishCopy(value, now);
    } else {
      return PublishBuffer(*std::exchange(loan.slot_, nullptr), now);
    }
  }
  template <typename Publishing>
  [[gnu::noinline]] PublishStatus InTurn(const Publishing& publishing) {
    const typename PullPoint<T>::Turn turn(*pull_point_);
    return turn.held() ? publishing() : PublishStatus::kBusy;
  }
  [[nodiscard]] Loan<T> LoanForPull() requires(kCanPull) {
    if constexpr (kIsCheap<T>) {
      return Loan<T>(T{});
    } else {
      return Loan<T>(storage_.newest.LoanFrom(*storage_.pool_for_pulls));
    }
  }
  [[gnu::always_inline]] PublishStatus PublishCopy(const T& value, Time now) requires(kIsCheap<T>) {
    const std::int64_t stamp = now.time_since_epoch().count();
    const std::uint64_t order = NextOrder();
    storage_.Publish(value, stamp, order);
    if (subscribers() == nullptr) [[likely]]
      return PublishStatus::kPublished;
    return Distribute(value, {stamp, storage_.sequence(), order}, nullptr);
  }
  PublishStatus PublishBuffer(Buffer<T>& buffer, Time now) noexcept {
    const std::uint64_t sequence = ++storage_.published;
    buffer.publication = {now.time_since_epoch().count(), sequence, NextOrder()};
    storage_.newest.Publish(buffer);
    storage_.published_count.store(sequence, std::memory_order_relaxed);
    if (subscribers() == nullptr) [[likely]]
      return PublishStatus::kPublished;
    // The buffer stays the newest while this goes on, which keeps it.
    return Distribute(std::as_const(buffer).value(), buffer.publication, &buffer);
  }

  // Gives the value to each queue. Apart, so that publishing to readers of the newest value alone
  // stays short.
  [[gnu::noinline]] PublishStatus Distribute(const T& value, const Publication& publication,
                                             [[maybe_unused]] Buffer<T>* buffer) noexcept {
    return Guarded([&] {
      const Subscribers* list = subscribers();
      PublishStatus status = PublishStatus::kPublished;
      if (list == nullptr) return status;
      for (QueueSink* sink : list->queues) {
        // The types are equal: connecting has checked it.
        auto* queue = static_cast<InputQueue<T>*>(sink);
        bool taken;
        if constexpr (kLiesInQueuesAsCopy<T>) {
          taken = queue->Push(value, publication, number());
        } else {
          buffer->AddHolders(1);
          taken = queue->Push(internal::HeldValue<T>(BufferLease<T>(buffer)), number());
        }
        if (!taken) status = PublishStatus::kRefused;
      }
      for (Waker* waker : list->wakers) waker->Wake();
      return status;
    });
  }

  // On the line that publishing needs anyway.
  const std::unique_ptr<PullPoint<T>> pull_point_;  // nullptr if the output is not pullable
  std::conditional_t<kIsCheap<T>, CheapStorage, BufferStorage> storage_;
};

}  // namespace runnel
