#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <utility>

#include "core/lockfree/bounded_queue.h"
#include "core/lockfree/publication.h"
#include "core/lockfree/stream_queue.h"
#include "core/port/input_queue_base.h"
#include "core/port/lease.h"

namespace runnel {

/// Whether values of T lie in queues as copies, so that whoever takes one out touches no buffer of
/// its publisher. So do all types whose leases can hold a copy.
template <typename T>
inline constexpr bool kLiesInQueuesAsCopy =
    std::is_constructible_v<internal::HeldValue<T>, const T&, const Publication&>;

namespace internal {

/// What lies in a queue, made in its place and read from there: a copy …
template <typename T>
struct QueuedCopy {
  QueuedCopy(const T& copied, const Publication& of, std::uint64_t from) noexcept
      : source(from), publication(of), value(copied) {}
  void MoveTo(HeldValue<T>& held) noexcept {
    // In its place: the value is copied once.
    std::destroy_at(&held);
    std::construct_at(&held, value, publication);
  }

  std::uint64_t source;
  Publication publication;
  T value;
};
/// … or a lease.
template <typename T>
struct QueuedLease {
  QueuedLease(HeldValue<T>&& taken_over, std::uint64_t from) noexcept
      : source(from), publication(taken_over.publication()), held(std::move(taken_over)) {}
  void MoveTo(HeldValue<T>& to) noexcept { to = std::move(held); }

  std::uint64_t source;
  Publication publication;
  HeldValue<T> held;
};

}  // namespace internal

/// The values that wait at one input, from all its sources, in the order of their coming.
///
/// Threads:     Push() by any publisher, or by that of the one source; Pop() by one reader at a
///              time; PutFirst() at most once for each source, by who connects it.
/// Progress:    lock-free; with one writer and nothing to push out, wait-free. A publisher never
///              waits for a reader that has been stopped.
/// Allocation:  in the constructor only.
template <typename T>
class InputQueue final : public InputQueueBase {
  using Queued =
      std::conditional_t<kLiesInQueuesAsCopy<T>, internal::QueuedCopy<T>, internal::QueuedLease<T>>;
  using Stream = StreamQueue<Queued>;
  using Shared = BoundedQueue<Queued>;

 public:
  struct Entry {
    internal::HeldValue<T> held;
    std::uint64_t source = 0;  // the channel's number
  };

  InputQueue(std::size_t capacity, OnFull on_full, Writers writers = Writers::kSeveral)
      : InputQueueBase(capacity, on_full, writers) {
    // Who makes room has to take something out, and then is a reader beside the input's.
    if (writers == Writers::kOne && on_full != OnFull::kDropOldest) {
      stream_ = std::make_unique<Stream>(capacity);
    } else {
      shared_ = std::make_unique<Shared>(capacity);
    }
  }

  /// Returns false if the queue was full and refuses.
  [[gnu::always_inline]] bool Push(const T& value, const Publication& publication,
                                   std::uint64_t source) noexcept requires(kLiesInQueuesAsCopy<T>) {
    if (IsCrowdedOut()) [[unlikely]]
      return Drop();
    if (stream_ == nullptr) return PushShared(value, publication, source);
    return stream_->TryEmplace(value, publication, source) || Drop();
  }
  bool Push(internal::HeldValue<T>&& held, std::uint64_t source) noexcept
      requires(!kLiesInQueuesAsCopy<T>) {
    if (IsCrowdedOut()) [[unlikely]]
      return Drop();
    if (stream_ == nullptr) return EmplaceShared(std::move(held), source);
    return stream_->TryEmplace(std::move(held), source) || Drop();
  }
  bool Push(Entry entry) noexcept {
    if constexpr (kLiesInQueuesAsCopy<T>) {
      return Push(entry.held.value(), entry.held.publication(), entry.source);
    } else {
      return Push(std::move(entry.held), entry.source);
    }
  }

  /// Puts in the value that a new connection delivers, while its source may be publishing already:
  /// call it after the source has been told of the queue, with the source's newest value then. It
  /// comes out before later ones, unless values up to it have come in through Push().
  void PutFirst(internal::HeldValue<T>&& held, std::uint64_t source) noexcept {
    if (stream_ == nullptr) {
      (void)Push({std::move(held), source});
      return;
    }
    first_ = {std::move(held), source};
    // release: pairs with the acquire in PopStream(). What the source had pushed before it published
    // this value is in the queue for whoever sees the flag.
    first_waits_.store(true, std::memory_order_release);
  }

  /// Takes the oldest value out; false if there is none.
  [[nodiscard]] bool Pop(Entry& entry) noexcept { return Pop(entry.held, entry.source); }
  [[nodiscard]] bool Pop(internal::HeldValue<T>& held, std::uint64_t& source) noexcept {
    return PopIf([] { return true; }, held, source);
  }
  /// The same, but asks `may()` when a value has been seen, and leaves it there if not. What the
  /// value's publisher had pushed before it, into whatever queue, is visible to `may`.
  template <typename May>
  [[nodiscard]] bool PopIf(May&& may, internal::HeldValue<T>& held,
                           std::uint64_t& source) noexcept {
    if (stream_ != nullptr) return PopStream(may, held, source);
    return shared_->TryConsumeIf(may, [&](Queued& oldest) {
      source = oldest.source;
      oldest.MoveTo(held);
    });
  }

  [[nodiscard]] bool HasNext() const noexcept override {
    if (stream_ == nullptr) return shared_->HasOldest();
    return first_waits_.load(std::memory_order_acquire) || stream_->Front() != nullptr;
  }

  [[nodiscard]] bool WouldRefuse() noexcept override {
    if (on_full_ != OnFull::kRefuse) return false;
    if (IsCrowdedOut()) return true;
    return stream_ != nullptr ? !stream_->HasCapacity() : shared_->size() >= capacity_;
  }
  [[nodiscard]] std::size_t size() const noexcept override {
    const std::size_t first = first_waits_.load(std::memory_order_relaxed) ? 1 : 0;
    return first + (stream_ != nullptr ? stream_->size() : shared_->size());
  }
  bool DropOldest() noexcept override {
    if (on_full_ != OnFull::kDropOldest || !shared_->TryConsume([](Queued&) {})) return false;
    CountDropped();
    return true;
  }

 private:
  static constexpr int kAttempts = 16;
  // The publication by value: its publisher has it in registers, and leaves it there as long as nobody
  // asks where it lies.
  [[gnu::noinline]] bool PushShared(const T& value, Publication publication,
                                    std::uint64_t source) noexcept {
    return EmplaceShared(value, publication, source);
  }
  // Ends after a few attempts in any case: if a reader was stopped while it emptied the very cell
  // that is needed, the new value is dropped, whatever the policy.
  template <typename... Parts>
  bool EmplaceShared(Parts&&... parts) noexcept {
    Shared& queue = *shared_;
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
      if (queue.TryEmplace(std::forward<Parts>(parts)...)) return true;
      if (on_full_ != OnFull::kDropOldest) break;
      // Not full and yet no room: a reader is at work there, and dropping others would not help.
      if (queue.size() < queue.capacity()) continue;
      (void)DropOldest();
    }
    return Drop();
  }
  template <typename May>
  bool PopStream(May&& may, internal::HeldValue<T>& held, std::uint64_t& source) noexcept {
    // acquire: pairs with the release in PutFirst().
    if (first_waits_.load(std::memory_order_acquire)) [[unlikely]] {
      if (!may()) return false;
      // relaxed: for size(), and for this reader.
      first_waits_.store(false, std::memory_order_relaxed);
      Entry first = std::exchange(first_, Entry{});
      const Queued* const front = stream_->Front();
      const std::uint64_t sequence = first.held.publication().sequence;
      // Else it comes through the queue, after those before it.
      if (front == nullptr || front->publication.sequence > sequence) {
        held = std::move(first.held);
        source = first.source;
        return true;
      }
    }
    Queued* const front = stream_->Front();
    if (front == nullptr || !may()) return false;
    source = front->source;
    front->MoveTo(held);
    stream_->PopFront();
    return true;
  }

  std::unique_ptr<Stream> stream_;  // one of the two, constant from the constructor on
  std::unique_ptr<Shared> shared_;
  std::atomic<bool> first_waits_{false};
  Entry first_;  // the connecting thread's, then the reader's
};

}  // namespace runnel
