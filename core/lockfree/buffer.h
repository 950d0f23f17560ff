#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <new>
#include <utility>

#include "core/base/check.h"
#include "core/lockfree/cache_line.h"
#include "core/lockfree/publication.h"

namespace runnel {

/// Whom published values belong to that lie in no buffer of a pool: in the memory of a driver, of a
/// camera, shared with another process.
///
/// Ownership:   shared: whoever has published a value keeps its owner, with the memory, until the value has been
///              taken back. For an owner that lives longer in any case: std::shared_ptr<…>({}, &owner), which
///              counts nothing.
template <typename T>
class ValueOwner {
 public:
  /// Nobody holds `value` any more, and nobody will. Called once for each time it was published, by who
  /// looks for free buffers: the publisher, in its own thread; or, once the pool is closed, whoever has
  /// the closed ones looked at (HazardDomain::Reclaim()). Never by a reader. Inside a publisher's cycle,
  /// so it does not block; it neither loans from nor publishes into what the value was published by.
  virtual void TakeBack(const T& value) noexcept = 0;

  virtual ~ValueOwner() = default;
};

template <typename T, template <typename> class Atomic, std::size_t kSlots>
class BufferPool;

/// What is kept with the value in a buffer of a pool, whatever its type. Who holds a buffer:
///
///   the publisher     from Loan() on, until it is published or the loan dropped  (is_loaned_)
///   the newest value  until the next one is published                           (LatestBuffer)
///   a reader's slot   from a lease until the lease is dropped                    (HazardRecord)
///   references        queue entries, copies of leases, leases without a slot, buffers of other
///                     outputs that forward what lies in it                       (count_)
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
    return is_loaned_.load(std::memory_order_acquire) || count_.load(std::memory_order_acquire) != 0;
  }

  Atomic<std::uint64_t> count_{0};  // references
  Atomic<bool> is_loaned_{false};
  std::uint32_t seen_in_ = 0;  // the publisher's own: the search that last saw it in a slot
};

/// One buffer of a pool: a value and what is kept with it. What is published by it may also lie elsewhere:
/// in a buffer that is forwarded, of whatever pool, or with an owner of its own. Then the buffer holds that, as long
/// as it is held itself, and its own value rests.
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
  [[nodiscard]] const T& value() const noexcept { return *std::launder(reinterpret_cast<const T*>(storage_)); }

  /// What readers see: the buffer's own value, or one that lies elsewhere.
  [[nodiscard]] const T& published_value() const noexcept { return *published_value_; }

  [[nodiscard]] Pool& pool() const noexcept { return *pool_; }

  /// Has readers see what `held` has them see. What that is held by is counted once more, not `held` in
  /// between: so a chain of any length holds one buffer, and ends there. By who has the loan.
  /// Precondition: the caller holds `held`.
  void ReferTo(Buffer& held) noexcept {
    Buffer& origin = held.forwarded_ != nullptr ? *held.forwarded_ : held;
    origin.AddReferences(1);
    forwarded_ = &origin;
    published_value_ = held.published_value_;
  }
  /// The same with a value of somebody else's, which that one gets back.
  void ReferTo(const T& value, std::shared_ptr<ValueOwner<T>> owner) noexcept {
    owner_ = std::move(owner);
    published_value_ = &value;
  }
  /// By who has the loan and could not publish: the value stays with who has it.
  void ReferToNothing() noexcept {
    owner_.reset();
    EndReference();
  }

 private:
  friend Pool;

  /// By who has found that nobody holds the buffer.
  void EndReference() noexcept {
    if (published_value_ == &value()) [[likely]]
      return;
    const T* const published = std::exchange(published_value_, &value());
    if (Buffer* const origin = std::exchange(forwarded_, nullptr)) origin->ReleaseReference();
    if (const auto owner = std::exchange(owner_, nullptr)) owner->TakeBack(*published);
  }

  void Fill(Pool& pool, const Factory& factory) {
    if (factory) {
      new (storage_) T(factory());
    } else if constexpr (std::is_default_constructible_v<T>) {
      new (storage_) T();
    } else {
      ThrowProgrammingError("a type without default constructor needs a factory", "BufferPool");
    }
    pool_ = &pool;
    published_value_ = &value();
  }

  // With what is kept with it, one line. Plain, as the value is: written while only the publisher, or who
  // has the closed pool, can reach the buffer.
  Pool* pool_ = nullptr;
  const T* published_value_ = nullptr;
  alignas(T) std::byte storage_[sizeof(T)];
  // Whom what lies elsewhere is held from; behind the value, since it is seldom looked at.
  Buffer* forwarded_ = nullptr;
  std::shared_ptr<ValueOwner<T>> owner_;
};

}  // namespace runnel
