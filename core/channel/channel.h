#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

#include "core/base/check.h"
#include "core/channel/channel_base.h"
#include "core/channel/distribution.h"
#include "core/channel/lease.h"
#include "core/channel/loan.h"
#include "core/channel/queued_value.h"
#include "core/channel/value_times.h"
#include "core/lockfree/latest_buffer.h"
#include "core/lockfree/latest_value.h"
#include "core/lockfree/thread_epoch.h"

namespace runnel {

/// A channel for values of type T.
///
/// Threads:     one thread at a time may Loan and Publish; any number may Read and Pull, inside a
///              guard.
/// Progress:    Publish and Read are lock-free; see core/lockfree/README.md.
/// Allocation:  only in the constructor, ReserveFor(), and a growing pool (BufferPool).
template <typename T>
class Channel final : public ChannelBase {
 public:
  Channel(const PoolOptions& pool, typename BufferPool<T>::Factory factory, bool pullable = false)
      : ChannelBase(pullable), storage_(pool, std::move(factory), pullable) {}

  [[nodiscard, gnu::always_inline]] Loan<T> MakeLoan() {
    if constexpr (kIsInlined<T>) {
      static_assert(std::is_default_constructible_v<T>,
                    "Loan() of a small type starts with T{}; publish a ready T instead");
      return Loan<T>(T{});
    } else {
      Buffer<T>* const buffer = storage_.newest.LoanAtOnce();
      return Loan<T>(buffer != nullptr ? buffer : LookForBuffer());
    }
  }

  [[gnu::always_inline]] PublishStatus Publish(Loan<T>&& loan, ValueTimes times) {
    if (!loan) [[unlikely]]
      return PublishStatus::kNoBuffer;
    if constexpr (kIsInlined<T>) {
      const T value = *loan;
      const PublishStatus status = PublishValue(value, times);
      if (status != PublishStatus::kBusy) loan.Drop();
      return status;
    } else {
      Buffer<T>* const buffer = loan.slot_;
      RUNNEL_CHECK(&buffer->pool() == storage_.pool.get(), "a loan can be published only by the output that gave it");
      if (HasFlags()) [[unlikely]] {
        const PublishStatus status = PublishOnSlowPath(*buffer, times);
        if (status != PublishStatus::kBusy) loan.slot_ = nullptr;
        return status;
      }
      loan.slot_ = nullptr;
      return PublishNow<PublishPath::kFast>(*buffer, times);
    }
  }
  PublishStatus PublishValue(const T& value, ValueTimes times) requires(kIsInlined<T>) {
    if (HasFlags()) [[unlikely]]
      return PublishOnSlowPath(value, times);
    return PublishNow<PublishPath::kFast>(value, times);
  }

  /// Publishes what the lease holds: a copy, if that is how such values travel; else the very value.
  PublishStatus Forward(const Lease<T>& lease, ValueTimes times) {
    const internal::HeldValue<T>& held = lease.Checked();
    if constexpr (kIsInlined<T>) {
      return PublishValue(held.value(), times);
    } else if constexpr (kLiesInQueuesAsCopy<T>) {
      Loan<T> loan = MakeLoan();
      if (loan) std::construct_at(&*loan, held.value());  // trivially copyable: nothing to destroy
      return Publish(std::move(loan), times);
    } else {
      return PublishElsewhere(times, [&](Buffer<T>& buffer) { buffer.ReferTo(*held.buffer()); });
    }
  }
  /// Publishes a value that belongs to somebody else.
  PublishStatus PublishInPlace(const T& value, std::shared_ptr<ValueOwner<T>>&& owner,
                               ValueTimes times) requires(!kLiesInQueuesAsCopy<T>) {
    return PublishElsewhere(times, [&](Buffer<T>& buffer) { buffer.ReferTo(value, std::move(owner)); });
  }
  /// Gives back what of other outputs and of owners nobody holds by this one any more.
  void ReleaseUnused() noexcept requires(!kIsInlined<T>) { storage_.newest.ReleaseUnused(Publisher()); }

  /// The newest value, or none. Call inside an EpochGuard.
  [[nodiscard]] internal::HeldValue<T> Read() noexcept { return Read(internal::thread_record->hazards); }
  /// The same outside of guards too, not so fast.
  [[nodiscard, gnu::noinline]] internal::HeldValue<T> ReadForViewer() noexcept {
    const EpochGuard guard;
    return Read();
  }
  /// The same by who has the calling thread's record at hand.
  [[nodiscard, gnu::always_inline]] internal::HeldValue<T> Read([[maybe_unused]] HazardRecord<>& record) noexcept {
    if constexpr (kIsInlined<T>) {
      return internal::HeldValue<T>(storage_);
    } else {
      return internal::HeldValue<T>(storage_.newest, record);
    }
  }
  /// Copies the newest value to `value`; false if there is none. Call inside an EpochGuard.
  [[gnu::always_inline]] bool Copy(T& value, [[maybe_unused]] HazardRecord<>& record) noexcept
      requires(std::is_trivially_copyable_v<T>) {
    if constexpr (kIsInlined<T>) {
      return storage_.Read(value);
    } else {
      const auto lease = storage_.newest.Lease(record);
      if (lease.get() == nullptr) return false;
      value = internal::ValueOf(*lease.get());
      return true;
    }
  }

  [[nodiscard]] std::uint64_t publications() const noexcept override {
    if constexpr (kIsInlined<T>) {
      return storage_.sequence();
    } else {
      return storage_.published.load(std::memory_order_acquire);
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
  bool VisitLatest(const std::function<void(const void* value, ValueTimes times)>& visit) const override {
    // Reading changes nothing but counts of leases.
    const auto held = const_cast<Channel*>(this)->ReadForViewer();
    if (!held.has_value()) return false;
    visit(&held.value(), ValueTimes::Of(held.publication()));
    return true;
  }
  std::optional<PublishStatus> PublishFilled(bool (*fill)(void* context, void* value), void* context,
                                             ValueTimes times) override {
    if constexpr (kCanPull) {
      Loan<T> loan = MakeLoan();
      if (!loan) return PublishStatus::kNoBuffer;
      if (!fill(context, &*loan)) return std::nullopt;
      return Publish(std::move(loan), times);
    } else {
      return std::nullopt;
    }
  }
  [[nodiscard]] bool can_be_filled() const noexcept override { return kCanPull; }
  static constexpr bool kGivesCopies = kLiesInQueuesAsCopy<T>;
  [[nodiscard]] bool gives_copies() const noexcept override { return kGivesCopies; }
  /// An empty one; nullptr if only a module can make such values.
  [[nodiscard]] static std::unique_ptr<ChannelBase> Make() {
    if constexpr (std::is_default_constructible_v<T>) {
      return std::make_unique<Channel>(PoolOptions{}, typename BufferPool<T>::Factory{});
    } else {
      return nullptr;
    }
  }
  void DeliverNewest(QueueSink& sink) override {
    const auto held = ReadForViewer();
    if (!held.has_value()) return;
    if constexpr (kLiesInQueuesAsCopy<T>) {
      Distribution::ToNew(sink, &held.value(), held.publication(), number());
    } else {
      Distribution::ToNew(sink, {held.buffer(), &held.value()}, held.publication(), number());
    }
  }
  /// How many buffers there are for Loan().
  [[nodiscard]] std::size_t buffers() const noexcept requires(!kIsInlined<T>) { return storage_.pool->capacity(); }
  /// How often the pool had to allocate while running.
  [[nodiscard]] std::uint64_t growths() const noexcept {
    if constexpr (kIsInlined<T>) {
      return 0;
    } else {
      return storage_.pool->growths() + (storage_.pool_for_pulls ? storage_.pool_for_pulls->growths() : 0);
    }
  }

  /// A provider begins with T{}, as a loan does, or with what lies in a buffer.
  static constexpr bool kCanPull = !kIsInlined<T> || std::is_default_constructible_v<T>;

 private:
  using Distribution = internal::DistributionOf<T>;
  struct InlinedStorage : LatestValue<T> {
    InlinedStorage(const PoolOptions&, typename BufferPool<T>::Factory&&, bool) {}
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
    // Written by the publisher alone, when the value is there.
    std::atomic<std::uint64_t> published{0};
  };

  [[gnu::noinline]] Buffer<T>* LookForBuffer() requires(!kIsInlined<T>) {
    HazardRecord<>* const publisher = Publisher();
    return publisher == nullptr ? storage_.newest.Loan() : storage_.newest.Loan(*publisher);
  }
  // By whose own slots the publisher may be spared fences; nullptr if who pulls may look for buffers at the
  // same time, in another thread.
  [[nodiscard]] HazardRecord<>* Publisher() const noexcept { return Has(kPullable) ? nullptr : &ThisThread().hazards; }
  template <typename Refer>
  PublishStatus PublishElsewhere(ValueTimes times, Refer&& refer) {
    Buffer<T>* const buffer = storage_.newest.LoanAnew(Publisher());
    if (buffer == nullptr) return PublishStatus::kNoBuffer;
    refer(*buffer);
    if (!HasFlags()) [[likely]]
      return PublishNow<PublishPath::kFast>(*buffer, times);
    const PublishStatus status = PublishOnSlowPath(*buffer, times);
    if (status == PublishStatus::kBusy) {
      buffer->ReferToNothing();
      buffer->DropLoan();
    }
    return status;
  }
  // By who has the lock, if there is one, and in order, if there is one.
  template <typename ValueOrBuffer>
  [[gnu::noinline]] PublishStatus PublishOnSlowPath(ValueOrBuffer& what, ValueTimes times) {
    if (!Has(kPullable)) return PublishNow<PublishPath::kSlow>(what, times);
    const PullPoint::Lock lock(*pull_point());
    return lock.held() ? PublishNow<PublishPath::kSlow>(what, times) : PublishStatus::kBusy;
  }
  void PublishPulled(ValueTimes (*times_now)(const Port& reader), const Port& reader) override {
    if constexpr (kCanPull) {
      Loan<T> loan = LoanForPull();
      if (!loan) return pull_point()->CountFailure();
      std::optional<Time> timestamp;
      if (!pull_point()->Run(&*loan, timestamp)) return;
      ValueTimes times = times_now(reader);
      if (timestamp) times.timestamp = std::min(*timestamp, times.publication_time);
      if constexpr (kIsInlined<T>) {
        (void)PublishNow<PublishPath::kSlow>(*loan, times);
      } else {
        (void)PublishNow<PublishPath::kSlow>(*std::exchange(loan.slot_, nullptr), times);
      }
    }
  }
  [[nodiscard]] Loan<T> LoanForPull() requires(kCanPull) {
    if constexpr (kIsInlined<T>) {
      return Loan<T>(T{});
    } else {
      return Loan<T>(storage_.newest.LoanFrom(*storage_.pool_for_pulls));
    }
  }
  // The rest of publishing, by who has the lock, if there is one.
  template <PublishPath kPath>
  [[gnu::always_inline]] PublishStatus PublishNow(const T& value, ValueTimes times) requires(kIsInlined<T>) {
    const std::int64_t timestamp = times.timestamp.time_since_epoch().count();
    const std::int64_t published = times.publication_time.time_since_epoch().count();
    const std::uint64_t order = kPath == PublishPath::kFast ? 0 : OrderNumber();
    if constexpr (kPath == PublishPath::kFast) {
      storage_.Publish(value, timestamp, published);
    } else {
      storage_.Publish(value, timestamp, published, order);
    }
    if (subscribers(kPath) == nullptr) [[likely]]
      return PublishStatus::kPublished;
    return Distribution::ToAll(*this, &value, timestamp, published, storage_.sequence(), order);
  }
  template <PublishPath kPath>
  [[gnu::always_inline]] PublishStatus PublishNow(Buffer<T>& buffer, ValueTimes times) noexcept
      requires(!kIsInlined<T>) {
    const std::uint64_t sequence = storage_.published.load(std::memory_order_relaxed) + 1;
    const std::int64_t timestamp = times.timestamp.time_since_epoch().count();
    const std::int64_t published = times.publication_time.time_since_epoch().count();
    const std::uint64_t order = kPath == PublishPath::kFast ? 0 : OrderNumber();
    buffer.publication.timestamp = timestamp;
    buffer.publication.publication_time = published;
    buffer.publication.sequence = sequence;
    // Without flags no buffer has ever had an order: once numbered, always numbered.
    if constexpr (kPath != PublishPath::kFast) buffer.publication.order = order;
    storage_.newest.Publish(buffer);
    // release: pairs with the acquire in publications(). Who finds the count finds this value, or a later one.
    storage_.published.store(sequence, std::memory_order_release);
    if (subscribers(kPath) == nullptr) [[likely]]
      return PublishStatus::kPublished;
    // The buffer stays the newest while this goes on, which keeps it.
    if constexpr (kLiesInQueuesAsCopy<T>) {
      return Distribution::ToAll(*this, &buffer.value(), timestamp, published, sequence, order);
    } else {
      return Distribution::ToAll(*this, {&buffer, &buffer.published_value()}, timestamp, published, sequence, order);
    }
  }

  std::conditional_t<kIsInlined<T>, InlinedStorage, BufferStorage> storage_;
};

}  // namespace runnel
