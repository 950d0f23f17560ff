#pragma once

#include <atomic>
#include <cstdint>

#include "core/lockfree/buffer_lease.h"
#include "core/lockfree/buffer_pool.h"

namespace runnel {

/// The newest published buffer of a pool: the zero-copy path of the ports.
///
/// Threads:     Publish() and Loan() by one thread at a time; Lease() by any, at any time.
/// Progress:    Publish() and Loan() are wait-free; Lease() is lock-free: it repeats only if a
///              Publish() happened in between.
/// Cost:        a lease is a store to the reader's own record and a fence; publishing is a store, whatever
///              the number of readers.
/// Allocation:  none but in Loan(), see BufferPool.
/// Lifetime:    the pool must outlive the slot.
template <typename T, template <typename> class Atomic = std::atomic, std::size_t kSlots = 7>
class LatestBuffer {
 public:
  using Pool = BufferPool<T, Atomic, kSlots>;
  using Buffer = typename Pool::Buffer;
  using Record = typename Pool::Record;
  using BufferLease = runnel::BufferLease<T, Atomic, kSlots>;

  explicit LatestBuffer(Pool& pool) : pool_(pool) {}

  /// A buffer to fill, see BufferPool::Loan(). Who passes the calling thread's record is spared the
  /// fence that its own slots do not need.
  [[nodiscard]] Buffer* Loan() { return LoanBut(0, pool_); }
  [[nodiscard]] Buffer* Loan(const Record& publisher) { return LoanBut(publisher.own_bit, pool_); }
  /// The same from another pool, for another publisher that takes turns with the first one: each
  /// may loan from its own pool while the other publishes.
  [[nodiscard]] Buffer* LoanFrom(Pool& pool) { return LoanBut(0, pool); }
  /// Makes a loaned buffer, of whichever pool, the newest one.
  void Publish(Buffer& buffer) noexcept {
    buffer.EndLoan();
    // release: pairs with the acquire in Lease(); the value is complete. Whoever reads has set a
    // bit and a slot before, which Loan() looks at.
    newest_.store(&buffer, std::memory_order_release);
  }

  /// Keeps the newest buffer for the thread that `record` belongs to; empty before the first one.
  [[nodiscard, gnu::always_inline]] BufferLease Lease(Record& record) noexcept {
    // acquire, here and below: pairs with the release in Publish(); what was written into the
    // buffer is visible.
    Buffer* buffer = newest_.load(std::memory_order_acquire);
    if (buffer == nullptr) return {};
    // relaxed: an own bit is set by this thread alone; Register() sees to a shared one.
    if ((readers_.load(std::memory_order_relaxed) & record.own_bit) == 0) [[unlikely]]
      Register(record);
    auto* const slot = record.FindFreeSlot();
    if (slot == nullptr) [[unlikely]]
      return LeaseCounted(buffer);
    for (;;) {
      // release: carries along what another thread did that used the slot before.
      slot->held.store(buffer, std::memory_order_release);
      // Between the slot and the second look; pairs with the full fence in ReadersBut(). If the
      // publisher does not find the slot filled then, what it looked for had been replaced before,
      // and is not found again here.
      Fences<Atomic>::Full();
      Buffer* const again = newest_.load(std::memory_order_acquire);
      if (again == buffer) [[likely]]
        return BufferLease(buffer, *slot);
      buffer = again;
    }
  }

 private:
  [[nodiscard]] Buffer* LoanBut(std::uint64_t own_bit, Pool& pool) {
    // relaxed: the newest is the caller's own note, unless it is of the other publisher, and then of
    // the other pool. An outdated one is not reused for one more time; one that is seen to have
    // replaced the caller's is, after the fences, seen by the readers too.
    return pool.Loan(newest_.load(std::memory_order_relaxed),
                     [this, own_bit] { return ReadersBut(own_bit); });
  }
  // Whose slots have to be looked at, after a fence if there are others than the caller's own.
  [[nodiscard]] std::uint64_t ReadersBut(std::uint64_t own_bit) const noexcept {
    // Between publishing and looking who reads; pairs with the heavy fence in Register().
    Fences<Atomic>::Light();
    // relaxed: the fences order.
    const std::uint64_t readers = readers_.load(std::memory_order_relaxed);
    if ((readers & ~own_bit) == 0) return readers;
    // Between publishing and looking at slots and counts; pairs with the fence in Lease(): a reader
    // whose slot is not seen now sees that its buffer is no longer the newest.
    Fences<Atomic>::Full();
    return readers_.load(std::memory_order_relaxed);
  }
  // Once for each thread that reads here. Whoever publishes and does not see the bit has published
  // before the fence, and the second look of the reader sees it. A shared bit that is set says
  // nothing yet: who set it may not have passed the fence.
  [[gnu::noinline]] void Register(const Record& record) noexcept {
    // acquire, release: the fence of who set the bit is passed.
    if (record.own_bit == 0 && shared_bit_is_seen_.load(std::memory_order_acquire)) return;
    readers_.fetch_or(record.bit, std::memory_order_relaxed);
    Fences<Atomic>::Heavy();
    if (record.own_bit == 0) shared_bit_is_seen_.store(true, std::memory_order_release);
  }
  // For a thread that holds as many leases as it has slots. The buffer that is counted may have
  // been reused meanwhile; then it is not the newest, and the count is taken back unused.
  [[gnu::noinline]] BufferLease LeaseCounted(Buffer* buffer) noexcept {
    for (;;) {
      buffer->CountForASecondLook();
      Fences<Atomic>::Full();  // as above
      Buffer* const again = newest_.load(std::memory_order_acquire);
      if (again == buffer) return BufferLease(buffer);
      buffer->DropHolder();
      buffer = again;
    }
  }

  Pool& pool_;
  alignas(kCacheLineSize) Atomic<Buffer*> newest_{nullptr};
  Atomic<std::uint64_t> readers_{0};  // bits of the records that have ever leased here
  Atomic<bool> shared_bit_is_seen_{false};
};

}  // namespace runnel
