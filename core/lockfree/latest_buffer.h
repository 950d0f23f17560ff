#pragma once

#include <atomic>
#include <cstdint>

#include "core/lockfree/asymmetric_fence.h"
#include "core/lockfree/buffer_lease.h"
#include "core/lockfree/buffer_pool.h"

namespace runnel {

/// The newest published buffer of a pool: the zero-copy path of the ports.
///
/// Threads:     Publish() and Loan() by one thread at a time; Lease() by any, at any time.
/// Progress:    Publish() and Loan() are wait-free; Lease() is lock-free: it repeats only if a
///              Publish() happened in between.
/// Cost:        a lease is a store to the reader's own record and a fence, or the store alone in the
///              thread that loans; publishing is a store, whatever the number of readers. The first
///              lease of a thread calls the system; so does a Loan() after which another thread
///              than before loans and reads, eight times at most.
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
  /// fences that its own slots do not need, when it loans and when it reads.
  [[nodiscard]] Buffer* Loan() { return LoanFor(nullptr, pool_); }
  [[nodiscard]] Buffer* Loan(Record& publisher) { return LoanFor(&publisher, pool_); }
  /// A buffer that is known to be free, or nullptr if Loan() has to look for one.
  [[nodiscard, gnu::always_inline]] Buffer* LoanAtOnce() noexcept { return pool_.LoanAtOnce(); }
  /// Loan() from another pool, for another publisher that takes turns with the first one: each may
  /// loan from its own pool while the other publishes. Then neither passes a record.
  [[nodiscard]] Buffer* LoanFrom(Pool& pool) { return LoanFor(nullptr, pool); }
  /// Loan() by who publishes what lies elsewhere, see BufferPool::LoanAnew(). nullptr: as in Loan().
  [[nodiscard]] Buffer* LoanAnew(Record* publisher) {
    return pool_.LoanAnew(newest_.load(std::memory_order_relaxed), LooksFor(publisher));
  }
  /// Gives back what lies elsewhere and nobody holds any more. By the publisher.
  void ReleaseUnused(Record* publisher) noexcept {
    pool_.ReleaseUnused(newest_.load(std::memory_order_relaxed), LooksFor(publisher));
  }
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
    Buffer* const buffer = newest_.load(std::memory_order_acquire);
    if (buffer == nullptr) return {};
    auto* const slot = record.FindFreeSlot();
    if (slot == nullptr) [[unlikely]]
      return BufferLease(CountNewest(buffer, record));
    // release: carries along what another thread did that used the slot before.
    slot->held.store(buffer, std::memory_order_release);
    // Between the slot and the look who loans; pairs with the heavy fence in LetRead(): if another
    // thread has taken over, either it finds the slot filled, or it is seen here.
    Fences<Atomic>::LightIfHeavyIsHeavy();
    // relaxed: the fences order; what this thread has stored itself it sees.
    if (own_reader_.load(std::memory_order_relaxed) == &record)
      return BufferLease(buffer, *slot);  // nobody looks for free buffers but this thread
    return LeaseFromOthers(buffer, *slot, record);
  }

 private:
  // The slot holds the buffer, if it still is the newest.
  [[nodiscard, gnu::always_inline]] BufferLease LeaseFromOthers(Buffer* buffer, HazardSlot<Atomic>& slot,
                                                                const Record& record) noexcept {
    // relaxed: an own bit is set by this thread alone; Register() sees to a shared one.
    if ((readers_.load(std::memory_order_relaxed) & record.own_bit) == 0) [[unlikely]]
      Register(record);
    for (;;) {
      // Between the slot and the second look; pairs with the full fence in ReadersBut(). If the
      // publisher does not find the slot filled then, what it looked for had been replaced before,
      // and is not found again here.
      Fences<Atomic>::Full();
      Buffer* const again = newest_.load(std::memory_order_acquire);
      if (again == nullptr) __builtin_unreachable();  // what has been published is not taken back
      if (again == buffer) [[likely]]
        return BufferLease(buffer, slot);
      buffer = again;
      // release: as above.
      slot.held.store(buffer, std::memory_order_release);
    }
  }
  [[nodiscard]] Buffer* LoanFor(Record* publisher, Pool& pool) {
    // relaxed: the newest is the caller's own note, unless it is of the other publisher, and then of
    // the other pool. An outdated one is not reused for one more time; one that is seen to have
    // replaced the caller's is, after the fences, seen by the readers too.
    return pool.Loan(newest_.load(std::memory_order_relaxed), LooksFor(publisher));
  }
  // Whose slots are to be looked at; asked when it comes to that.
  [[nodiscard]] auto LooksFor(Record* publisher) noexcept {
    return [this, publisher] {
      LetRead(publisher);
      return ReadersBut(publisher != nullptr ? publisher->own_bit : 0);
    };
  }
  // Before looking for free buffers: if it is the caller's thread alone that does so, and it reads
  // here too, its leases need no fence. They have until another thread comes to look.
  void LetRead(Record* publisher) noexcept {
    // relaxed, all: written by who looks for free buffers only, of whom there is one at a time.
    const bool reads = publisher != nullptr && Fences<Atomic>::HeavyIsHeavy() &&
                       (readers_.load(std::memory_order_relaxed) & publisher->own_bit) != 0;
    Record* const next = reads && takeovers_ < kMostTakeovers ? publisher : nullptr;
    const Record* const before = own_reader_.load(std::memory_order_relaxed);
    if (next == before) return;
    own_reader_.store(next, std::memory_order_relaxed);
    if (before == nullptr) return;  // all readers have passed their fences
    // A system call, so there is an end to it where two threads loan by turns.
    ++takeovers_;
    // Between taking over and looking at slots; pairs with the light fence in Lease().
    Fences<Atomic>::Heavy();
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
  [[gnu::noinline]] Buffer* CountNewest(Buffer* buffer, const Record& record) noexcept {
    // relaxed: as above.
    if ((readers_.load(std::memory_order_relaxed) & record.own_bit) == 0) Register(record);
    for (;;) {
      buffer->AddUnverifiedReference();
      Fences<Atomic>::Full();  // as above
      Buffer* const again = newest_.load(std::memory_order_acquire);
      if (again == buffer) return buffer;
      buffer->ReleaseReference();
      buffer = again;
    }
  }

  Pool& pool_;
  alignas(kCacheLineSize) Atomic<Buffer*> newest_{nullptr};
  // The record of the thread that alone looks for free buffers, if it reads, too; else nullptr.
  Atomic<Record*> own_reader_{nullptr};
  Atomic<std::uint64_t> readers_{0};  // bits of the records that have ever leased here
  Atomic<bool> shared_bit_is_seen_{false};
  // The publisher's own: how often another thread has taken over.
  static constexpr std::uint32_t kMostTakeovers = 8;
  std::uint32_t takeovers_ = 0;
};

}  // namespace runnel
