#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <new>

#include "core/base/check.h"
#include "core/lockfree/cache_line.h"
#include "core/lockfree/publication.h"

namespace runnel {

template <typename T, template <typename> class Atomic, std::size_t kSlots>
class BufferPool;

/// What is kept with the value in a buffer of a pool, whatever its type. Who holds a buffer:
///
///   the publisher     from Loan() on, until it is published or the loan dropped  (is_loaned_)
///   the newest value  until the next one is published                           (LatestBuffer)
///   a reader's slot   from a lease until the lease is dropped                    (HazardRecord)
///   references        queue entries, copies of leases, leases without a slot     (count_)
///
/// It is free for its publisher when none of them does. References are added only by who holds the
/// buffer in some way, so of a free buffer no new one comes up (LatestBuffer has the one exception, which
/// looks again). Only the publisher asks, or who has the pool once it is closed, so no two can find the
/// same buffer free.
template <template <typename> class Atomic = std::atomic>
class BufferBase {
 public:
  /// Written by the publisher before it publishes, read by whoever holds the buffer.
  Publication publication;

  /// Adds `more` references. Precondition: the caller holds the buffer in some way.
  void AddReferences(std::uint32_t more) noexcept {
    // relaxed: the caller's own hold keeps the buffer from being reused meanwhile; that is given up
    // with a release, which carries this along to who asks whether the buffer is free.
    count_.fetch_add(more, std::memory_order_relaxed);
  }
  /// A reference whose holder does not know yet whether it came in time; see LatestBuffer::Lease().
  void AddUnverifiedReference() noexcept {
    // relaxed: a fence comes between this and the second look.
    count_.fetch_add(1, std::memory_order_relaxed);
  }
  /// Gives one reference up.
  void ReleaseReference() noexcept {
    // release: pairs with the acquire in IsHeld(); the holder's reads are over for who finds the
    // buffer free, or deletes it.
    count_.fetch_sub(1, std::memory_order_release);
  }
  /// A loan that is not published. Any thread.
  void DropLoan() noexcept {
    // release: as in ReleaseReference().
    is_loaned_.store(false, std::memory_order_release);
  }
  /// By the publisher, before others can reach the buffer.
  void EndLoan() noexcept { is_loaned_.store(false, std::memory_order_relaxed); }

 private:
  template <typename, template <typename> class, std::size_t>
  friend class BufferPool;

  // By loan or count. acquire: pairs with the releases of those who gave it up.
  [[nodiscard]] bool IsHeld() const noexcept {
    return is_loaned_.load(std::memory_order_acquire) ||
           count_.load(std::memory_order_acquire) != 0;
  }

  Atomic<std::uint64_t> count_{0};  // references
  Atomic<bool> is_loaned_{false};
  std::uint32_t seen_in_ = 0;  // the publisher's own: the search that last saw it in a slot
};

/// One buffer of a pool: a value and what is kept with it.
template <typename T, template <typename> class Atomic = std::atomic, std::size_t kSlots = 7>
class alignas(kCacheLineSize) Buffer : public BufferBase<Atomic> {
 public:
  using Pool = BufferPool<T, Atomic, kSlots>;
  using Factory = std::function<T()>;

  Buffer() = default;
  ~Buffer() {
    if (pool_ != nullptr) value().~T();
  }
  Buffer(const Buffer&) = delete;
  Buffer& operator=(const Buffer&) = delete;

  [[nodiscard]] T& value() noexcept { return *std::launder(reinterpret_cast<T*>(storage_)); }
  [[nodiscard]] const T& value() const noexcept {
    return *std::launder(reinterpret_cast<const T*>(storage_));
  }

  [[nodiscard]] Pool& pool() const noexcept { return *pool_; }

 private:
  friend Pool;

  void Fill(Pool& pool, const Factory& factory) {
    if (factory) {
      new (storage_) T(factory());
    } else if constexpr (std::is_default_constructible_v<T>) {
      new (storage_) T();
    } else {
      ThrowProgrammingError("a type without default constructor needs a factory", "BufferPool");
    }
    pool_ = &pool;
  }

  Pool* pool_ = nullptr;
  alignas(T) std::byte storage_[sizeof(T)];
};

}  // namespace runnel
