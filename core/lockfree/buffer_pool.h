#pragma once

#include <array>
#include <atomic>
#include <bit>
#include <cstdint>
#include <functional>
#include <memory>
#include <new>
#include <utility>

#include "core/base/check.h"
#include "core/lockfree/cache_line.h"
#include "core/lockfree/latest_value.h"

namespace runnel {

/// How many buffers a pool has and whether it may get more.
struct PoolOptions {
  std::uint32_t buffers = 8;  ///< at the start; rounded up to a power of two
  bool may_grow = true;       ///< by allocating when all are in use; false: Loan() comes back empty
};

/// Reusable buffers of type T that threads lend to each other without copying.
///
/// A buffer is always in one of three hands:
///
///     free ──Loan()──▶ loaned (one writer) ──Share()──▶ shared (any number of readers)
///       ▲                    │ dropped                        │ last lease dropped
///       └────────────────────┴────────────────────────────────┘
///
/// Ownership:   the pool belongs to its maker until Close(); from then on it belongs to the leases
///              that are still out, and the last one to come home deletes it with all its buffers.
///              So a lease may outlive the port, the module and the connection it came from.
/// Threads:     every member may be called from any thread at any time, except Close(): its caller
///              promises that nobody loans or reads through the maker any more.
/// Progress:    lock-free: a call retries only when another thread's call has succeeded.
/// Allocation:  in Make() and Reserve(); in Loan() only if the pool may grow and all buffers are in
///              use, which growths() counts.
/// Limits:      a buffer's generation wraps after 2^32 uses, its leases must stay below 2^32.
///
/// @tparam Atomic  replaced in tests by an atomic that provokes interleavings.
template <typename T, template <typename> class Atomic = std::atomic>
class BufferPool {
 public:
  class Buffer;
  using Factory = std::function<T()>;

  /// Names one *use* of a buffer: the generation changes with each reuse, so that a tag read long
  /// ago is recognised as stale instead of naming somebody else's data (ABA).
  using Tag = std::uint64_t;
  static constexpr Tag kNoTag = ~Tag{0};

  struct Closer {
    void operator()(BufferPool* pool) const noexcept { pool->Close(); }
  };
  using Owner = std::unique_ptr<BufferPool, Closer>;

  /// Makes a pool whose buffers `factory` fills first; without one, T is default-constructed.
  static Owner Make(const PoolOptions& options, Factory factory) {
    return Owner(new BufferPool(options, std::move(factory)));
  }

  /// Takes a free buffer for one writer, or returns nullptr if there is none and none may be made.
  [[nodiscard]] Buffer* Loan() {
    for (;;) {
      if (Buffer* buffer = PopFree()) return buffer;
      const Growth growth = may_grow_ ? Grow() : Growth::kImpossible;
      if (growth == Growth::kImpossible) return nullptr;
      // relaxed: a statistic.
      if (growth == Growth::kDone) growths_.fetch_add(1, std::memory_order_relaxed);
    }
  }

  /// Sees to it that there are at least `buffers` buffers in all. Allocates; not for a cycle.
  void Reserve(std::uint32_t buffers) {
    while (capacity() < buffers && Grow() != Growth::kImpossible) {
    }
  }

  /// Hands a loaned buffer to readers, with one lease that the caller now holds.
  Tag Share(Buffer& buffer) noexcept {
    const std::uint64_t generation = High(buffer.state_.load(std::memory_order_relaxed));
    // relaxed: readers reach the buffer only through something released later (a slot, a queue).
    buffer.state_.store(Pack(generation, 1), std::memory_order_relaxed);
    return Pack(generation, buffer.index_);
  }

  /// One more lease of the buffer that `tag` names; nullptr if the tag has become stale.
  [[nodiscard]] Buffer* TryLease(Tag tag) noexcept {
    Buffer& buffer = At(static_cast<std::uint32_t>(Low(tag)));
    std::uint64_t seen = buffer.state_.load(std::memory_order_relaxed);
    do {
      if (High(seen) != High(tag) || Low(seen) == 0) return nullptr;  // reused, or on its way home
      // relaxed: the value was made visible by whatever handed over the tag (acquire there). This
      // exchange only keeps the count from reaching zero, which needs atomicity, not ordering.
    } while (!buffer.state_.compare_exchange_weak(seen, seen + 1, std::memory_order_relaxed,
                                                  std::memory_order_relaxed));
    return &buffer;
  }

  /// The buffer that `tag` names. Precondition: the caller owns a lease of it.
  [[nodiscard]] Buffer& Named(Tag tag) const noexcept {
    return At(static_cast<std::uint32_t>(Low(tag)));
  }

  [[nodiscard]] std::uint32_t capacity() const noexcept {
    // acquire: pairs with the release in Grow().
    return capacity_.load(std::memory_order_acquire);
  }
  /// How often Loan() had to allocate: 0 in an application that is sized right.
  [[nodiscard]] std::uint64_t growths() const noexcept {
    return growths_.load(std::memory_order_relaxed);
  }

 private:
  static constexpr std::uint64_t kNone = 0xFFFFFFFF;
  static constexpr std::uint64_t kClosed = 0xFFFFFFFE;
  static constexpr std::size_t kChunks = 24;

  static constexpr std::uint64_t Pack(std::uint64_t high, std::uint64_t low) noexcept {
    return (high << 32) | low;
  }
  static constexpr std::uint64_t High(std::uint64_t word) noexcept { return word >> 32; }
  static constexpr std::uint64_t Low(std::uint64_t word) noexcept { return word & 0xFFFFFFFF; }

  BufferPool(const PoolOptions& options, Factory factory)
      : first_chunk_(std::bit_ceil(options.buffers > 0 ? options.buffers : 1u)),
        may_grow_(options.may_grow),
        factory_(std::move(factory)) {
    (void)Grow();
  }
  ~BufferPool() {
    for (Atomic<Buffer*>& chunk : chunks_) {
      delete[] chunk.load(std::memory_order_relaxed);
    }
  }

  // Chunk 0 has first_chunk_ buffers, and each further one as many as all before it together.
  [[nodiscard]] std::uint32_t ChunkSize(std::size_t chunk) const noexcept {
    return chunk == 0 ? first_chunk_ : first_chunk_ << (chunk - 1);
  }
  [[nodiscard]] Buffer& At(std::uint32_t index) const noexcept {
    const auto chunk = static_cast<std::size_t>(std::bit_width(index / first_chunk_));
    const std::uint32_t first = chunk == 0 ? 0 : ChunkSize(chunk);
    // acquire: pairs with the release in Grow(); the buffers of the chunk are constructed.
    return chunks_[chunk].load(std::memory_order_acquire)[index - first];
  }

  // Adds one chunk. Two threads may try at once: the slower one's chunk is thrown away, and then
  // the slower one says how many buffers there are now, should the faster one not have come to it
  // yet: so its next try is for the next chunk, and nobody waits for a thread that has been
  // stopped.
  enum class Growth { kDone, kDoneByAnother, kImpossible };
  Growth Grow() {
    const std::uint32_t before = capacity();
    const auto chunk = static_cast<std::size_t>(std::bit_width(before / first_chunk_));
    if (chunk >= kChunks) return Growth::kImpossible;
    const std::uint32_t size = ChunkSize(chunk);
    std::unique_ptr<Buffer[]> buffers(new Buffer[size]);
    for (std::uint32_t i = 0; i < size; ++i) buffers[i].Fill(*this, before + i, factory_);
    Buffer* expected = nullptr;
    // release: the buffers are complete for whoever finds the chunk in At().
    if (!chunks_[chunk].compare_exchange_strong(expected, buffers.get(), std::memory_order_release,
                                                std::memory_order_relaxed)) {
      RaiseCapacity(before, before + size);
      return Growth::kDoneByAnother;
    }
    Buffer* added = buffers.release();
    // relaxed: ComeHome() of these buffers comes after PushFree() of them, which releases.
    homeless_.fetch_add(size, std::memory_order_relaxed);
    RaiseCapacity(before, before + size);
    for (std::uint32_t i = size; i > 0; --i) PushFree(added[i - 1]);
    return Growth::kDone;
  }
  void RaiseCapacity(std::uint32_t before, std::uint32_t after) noexcept {
    // release, with the acquire in capacity(): who sees the count may bound indices by it. It fails
    // if somebody else has raised it, and then there is nothing to do.
    capacity_.compare_exchange_strong(before, after, std::memory_order_release,
                                      std::memory_order_relaxed);
  }

  // The free list is a Treiber stack of buffer indices under a change counter. A popper may read
  // `next_` of a buffer that another thread has just popped; the value is then meaningless, the
  // counter has moved, and the exchange below fails. That read is why `next_` is atomic.
  [[nodiscard]] Buffer* PopFree() noexcept {
    // acquire (here and on failure): `next_` of the head is read in the following lines, and what
    // earlier holders did to the value is finished.
    std::uint64_t head = free_.load(std::memory_order_acquire);
    while (Low(head) < kClosed) {
      Buffer& buffer = At(static_cast<std::uint32_t>(Low(head)));
      const std::uint64_t next = buffer.next_.load(std::memory_order_relaxed);
      if (free_.compare_exchange_weak(head, Pack(High(head) + 1, next), std::memory_order_acquire,
                                      std::memory_order_acquire)) {
        return &buffer;
      }
    }
    return nullptr;
  }

  void PushFree(Buffer& buffer) noexcept {
    std::uint64_t head = free_.load(std::memory_order_relaxed);
    do {
      if (Low(head) == kClosed) return ComeHome(1);
      buffer.next_.store(static_cast<std::uint32_t>(Low(head)), std::memory_order_relaxed);
      // release: pairs with the acquire in PopFree(), so that whoever reuses the buffer sees
      // `next_`, the new generation, and every access of earlier holders as finished.
    } while (!free_.compare_exchange_weak(head, Pack(High(head) + 1, buffer.index_),
                                          std::memory_order_release, std::memory_order_relaxed));
  }

  // The last lease is gone: a new generation makes old tags stale, then the buffer is free.
  void Recycle(Buffer& buffer, std::uint64_t generation) noexcept {
    // relaxed: only this thread may change the state now; PushFree() releases it.
    buffer.state_.store(Pack(generation + 1, 0), std::memory_order_relaxed);
    PushFree(buffer);
  }

  // After Close() each buffer is counted once, either in the list that Close() took or on its
  // return; whoever counts the last one deletes the pool.
  void Close() noexcept {
    // acq_rel: acquire to walk the list; release has no partner needed but keeps one order for all
    // writers of free_.
    const std::uint64_t head = free_.exchange(Pack(0, kClosed), std::memory_order_acq_rel);
    std::uint32_t count = 0;
    for (std::uint64_t index = Low(head); index != kNone;
         index = At(static_cast<std::uint32_t>(index)).next_.load(std::memory_order_relaxed)) {
      ++count;
    }
    ComeHome(count);
  }
  void ComeHome(std::uint32_t count) noexcept {
    // acq_rel: release, so that this thread's use of its buffer is done; acquire, so that the last
    // one sees all other uses as done before it deletes them.
    if (homeless_.fetch_sub(count, std::memory_order_acq_rel) == count) delete this;
  }

  const std::uint32_t first_chunk_;
  const bool may_grow_;
  const Factory factory_;
  std::array<Atomic<Buffer*>, kChunks> chunks_{};
  Atomic<std::uint32_t> capacity_{0};
  Atomic<std::uint32_t> homeless_{0};
  Atomic<std::uint64_t> growths_{0};
  alignas(kCacheLineSize) Atomic<std::uint64_t> free_{Pack(0, kNone)};
};

/// One buffer of a pool: a value and what the pool keeps with it.
template <typename T, template <typename> class Atomic>
class alignas(kCacheLineSize) BufferPool<T, Atomic>::Buffer {
 public:
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

  /// Written by the writer before Share(), read by whoever holds a lease.
  Publication publication;

  /// One more lease, by a holder of one.
  void AddLease() noexcept {
    // relaxed: the caller's own lease keeps the count above zero.
    state_.fetch_add(1, std::memory_order_relaxed);
  }
  /// Gives back one lease; the last one sends the buffer home.
  void DropLease() noexcept {
    // acq_rel: release, so that this holder's reads of the value are done before the count drops;
    // acquire, so that the one who drops it to zero sees all those reads as done.
    const std::uint64_t before = state_.fetch_sub(1, std::memory_order_acq_rel);
    if (Low(before) == 1) pool_->Recycle(*this, High(before));
  }
  /// Gives back a loan that was never shared.
  void DropLoan() noexcept { pool_->PushFree(*this); }

 private:
  friend class BufferPool;

  void Fill(BufferPool& pool, std::uint32_t index, const Factory& factory) {
    if (factory) {
      new (storage_) T(factory());
    } else if constexpr (std::is_default_constructible_v<T>) {
      new (storage_) T();
    } else {
      ThrowProgrammingError("a type without default constructor needs a factory", "BufferPool");
    }
    pool_ = &pool;
    index_ = index;
  }

  Atomic<std::uint64_t> state_{0};  // generation in the high half, leases in the low half
  Atomic<std::uint32_t> next_{0};
  std::uint32_t index_ = 0;
  BufferPool* pool_ = nullptr;
  alignas(T) std::byte storage_[sizeof(T)];
};

}  // namespace runnel
