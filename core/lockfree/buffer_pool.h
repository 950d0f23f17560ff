#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <type_traits>
#include <utility>

#include "core/lockfree/buffer.h"
#include "core/lockfree/hazard.h"

namespace runnel {

/// How many buffers a pool has and whether it may get more.
struct PoolOptions {
  std::uint32_t buffers = 8;  ///< at the start
  bool may_grow = true;       ///< by allocating when all are in use; false: Loan() comes back empty
};

/// Reusable buffers of type T that one publisher fills and any number of readers hold.
///
///     free ──Loan()──▶ loaned ──publish──▶ newest ──the next one──▶ held by readers ─┐
///       ▲                 │ dropped                                                  │
///       └─────────────────┴──────────── Loan() finds that nobody holds it ───────────┘
///
/// The publisher keeps its buffers in a list of its own, the free ones first. Readers give nothing
/// back: they cease to hold, and the publisher looks when it needs a buffer. So neither side writes
/// to a list that the other uses, and no buffer can be given back twice or under another's name (no
/// ABA).
///
/// Ownership:   the pool belongs to its maker until that closes it (Closer); from then on to the
///              domain, which deletes it when nobody holds a buffer any more: at once, or when it
///              looks again (HazardDomain::Reclaim()). So a lease may outlive the port, the module and
///              the connection it came from, and whoever drops the last one deletes nothing.
/// Threads:     Loan() by one thread at a time, the publisher; Reserve(), capacity() and growths()
///              by any; it is closed when nobody loans, publishes, or reads the newest value any more.
/// Progress:    Loan() is wait-free: it looks at each buffer and each slot of readers once.
/// Allocation:  in Make() and Reserve(); in Loan() only if the pool may grow and all buffers are in
///              use, which growths() counts.
/// Limits:      2^64 references to one buffer at a time.
///
/// @tparam Atomic  replaced in tests. @tparam kSlots  fewer in tests.
template <typename T, template <typename> class Atomic = std::atomic, std::size_t kSlots = 7>
class BufferPool final : public Retirable<Atomic> {
 public:
  using Buffer = runnel::Buffer<T, Atomic, kSlots>;
  using Domain = HazardDomain<Atomic, kSlots>;
  using Record = HazardRecord<Atomic, kSlots>;
  using Factory = std::function<T()>;

  struct Closer {
    void operator()(BufferPool* pool) const noexcept { pool->domain_.Retire(*pool); }
  };
  using Owner = std::unique_ptr<BufferPool, Closer>;

  /// Makes a pool whose buffers `factory` fills first; without one, T is default-constructed. It is
  /// called by whoever makes buffers, Loan() and Reserve(), and so perhaps by two threads at once.
  /// `domain` has the records of all who may read, and outlives the pool.
  static Owner Make(Domain& domain, const PoolOptions& options, Factory factory) {
    std::unique_ptr<BufferPool> pool(new BufferPool(domain, options, std::move(factory)));
    pool->Add(pool->MakeChunk(options.buffers > 0 ? options.buffers : 1));
    return Owner(pool.release());
  }
  // Public for std::unique_ptr; a pool is deleted by its domain.
  ~BufferPool() override {
    DeleteAll(chunks_);
    // relaxed: who reserves has ended before the pool is closed.
    DeleteAll(arriving_.load(std::memory_order_relaxed));
  }

  /// A free buffer, or nullptr if there is none and none may be made. `newest` is the one that has
  /// been published last, or nullptr; `readers` returns the bits of the records that may hold others,
  /// after a fence that orders looking at them after publishing (LatestBuffer).
  template <typename Readers>
  [[nodiscard]] Buffer* Loan(const Buffer* newest, Readers&& readers) {
    if (Buffer* const buffer = LoanAtOnce()) return buffer;
    FindFree(newest, readers);
    if (free_count_ > 0) [[likely]]
      return TakeFree();
    return TakeNew();
  }
  /// A buffer that was free when others were looked for, or nullptr if it is time to look again.
  [[nodiscard, gnu::always_inline]] Buffer* LoanAtOnce() noexcept {
    if (free_count_ == 0 || (kPrefersWarmBuffers && count_ - free_count_ <= kFewBuffers)) [[unlikely]]
      return nullptr;
    return TakeFree();
  }

  /// Loan() that looks for free buffers also if there are some: what those refer to that nobody holds any
  /// more is given back. By who publishes what lies elsewhere, which shall not be kept for long.
  template <typename Readers>
  [[nodiscard]] Buffer* LoanAnew(const Buffer* newest, Readers&& readers) {
    may_refer_ = true;
    FindFree(newest, readers);
    if (free_count_ > 0) [[likely]]
      return TakeFree();
    return TakeNew();
  }
  /// The same without a loan.
  template <typename Readers>
  void ReleaseUnused(const Buffer* newest, Readers&& readers) noexcept {
    FindFree(newest, readers);
  }

  /// Sees to it that there are at least `buffers` buffers in all. Allocates; not for a cycle.
  void Reserve(std::uint32_t buffers) {
    const std::uint32_t now = capacity();
    if (now >= buffers) return;
    Chunk* const chunk = MakeChunk(buffers - now).release();
    chunk->next = arriving_.load(std::memory_order_relaxed);
    // release: pairs with the acquire in TakeArriving(); the buffers are complete.
    while (!arriving_.compare_exchange_weak(chunk->next, chunk, std::memory_order_release, std::memory_order_relaxed)) {
    }
  }

  [[nodiscard]] std::uint32_t capacity() const noexcept { return capacity_.load(std::memory_order_relaxed); }
  /// How often Loan() had to allocate: 0 in an application that is sized right.
  [[nodiscard]] std::uint64_t growths() const noexcept { return growths_.load(std::memory_order_relaxed); }

 private:
  // Big values, and those with memory elsewhere, are better written where the last ones have been:
  // in the cache. For small ones it is cheaper to look for free buffers only when there are none.
  static constexpr bool kPrefersWarmBuffers = !std::is_trivially_copyable_v<T> || sizeof(T) > 4096;
  static constexpr std::uint32_t kFewBuffers = 16;

  // Buffers that are made at once, and a list long enough for them and all that were made before. A list
  // that a longer one has replaced goes with the pool.
  struct Chunk {
    std::unique_ptr<Buffer[]> buffers;
    std::uint32_t size;
    std::uint32_t list_capacity;
    std::unique_ptr<Buffer*[]> list;
    Chunk* next = nullptr;
  };

  BufferPool(Domain& domain, const PoolOptions& options, Factory factory)
      : domain_(domain), may_grow_(options.may_grow), factory_(std::move(factory)) {}

  std::unique_ptr<Chunk> MakeChunk(std::uint32_t size) {
    auto chunk = std::make_unique<Chunk>();
    chunk->buffers.reset(new Buffer[size]);
    chunk->size = size;
    for (std::uint32_t i = 0; i < size; ++i) chunk->buffers[i].Fill(*this, factory_);
    // relaxed: a count. Each list has a place for all buffers counted before, in whatever order the
    // chunks arrive.
    chunk->list_capacity = capacity_.fetch_add(size, std::memory_order_relaxed) + size;
    try {
      chunk->list.reset(new Buffer*[chunk->list_capacity]);
    } catch (...) {  // those made meanwhile are longer than they need be, which is no harm
      capacity_.fetch_sub(size, std::memory_order_relaxed);
      throw;
    }
    return chunk;
  }
  void Add(std::unique_ptr<Chunk> chunk) noexcept {
    if (chunk->list_capacity > list_capacity_) {
      std::copy_n(buffers_, count_, chunk->list.get());
      buffers_ = chunk->list.get();
      list_capacity_ = chunk->list_capacity;
    }
    for (std::uint32_t i = chunk->size; i > 0; --i) {
      buffers_[count_++] = buffers_[free_count_];
      buffers_[free_count_++] = &chunk->buffers[i - 1];
    }
    chunk->next = chunks_;
    chunks_ = chunk.release();
  }
  [[gnu::always_inline]] Buffer* TakeFree() noexcept {
    Buffer* const buffer = buffers_[--free_count_];
    if (buffer == nullptr) __builtin_unreachable();  // so that no caller looks again
    // relaxed: nobody else can reach the buffer.
    buffer->is_loaned_.store(true, std::memory_order_relaxed);
    return buffer;
  }
  // Apart, so that who finds a free buffer saves no registers for those that have to be made.
  [[gnu::noinline]] Buffer* TakeNew() { return TakeArriving() || Grow() ? TakeFree() : nullptr; }
  bool TakeArriving() noexcept {
    if (arriving_.load(std::memory_order_relaxed) == nullptr) return false;
    // acquire: pairs with the release in Reserve().
    Chunk* chunk = arriving_.exchange(nullptr, std::memory_order_acquire);
    while (chunk != nullptr) Add(std::unique_ptr<Chunk>(std::exchange(chunk, chunk->next)));
    return true;
  }
  bool Grow() {
    if (!may_grow_) return false;
    Add(MakeChunk(capacity()));  // as many as there are
    // relaxed: a statistic.
    growths_.fetch_add(1, std::memory_order_relaxed);
    return true;
  }
  static void DeleteAll(Chunk* chunk) noexcept {
    while (chunk != nullptr) delete std::exchange(chunk, chunk->next);
  }

  [[nodiscard]] Buffer* Own(void* address) const noexcept {
    for (Chunk* chunk = chunks_; chunk != nullptr; chunk = chunk->next) {
      Buffer* const first = chunk->buffers.get();
      const std::less<const void*> less;
      if (less(address, first) || !less(address, first + chunk->size)) continue;
      return static_cast<Buffer*>(address);
    }
    return nullptr;
  }

  // Moves from the other buffers to the free ones those that nobody holds, and gives back what these
  // held themselves.
  template <typename Readers>
  void FindFree(const Buffer* newest, const Readers& readers) noexcept {
    ++search_;
    domain_.ForEach(readers(), [this](const Record& record) {
      for (const auto& slot : record.slots) {
        // acquire: pairs with the release of who empties a slot: its reads are over; and what it
        // counted before (a copy of its lease) is seen in IsHeld(). So slots come first.
        void* const held = slot.held.load(std::memory_order_acquire);
        if (held == nullptr) continue;
        if (Buffer* const own = Own(held)) own->seen_in_ = search_;
      }
    });
    // Copies of the members, which the compiler would load anew after each acquire.
    Buffer** const buffers = buffers_;
    const std::uint32_t search = search_;
    const std::uint32_t free_before = free_count_;
    std::uint32_t free = free_before;
    for (std::uint32_t i = free, count = count_; i < count; ++i) {
      Buffer* const buffer = buffers[i];
      const bool held = buffer == newest || buffer->seen_in_ == search || buffer->IsHeld();
      if (held) continue;
      buffers[i] = buffers[free];
      buffers[free++] = buffer;
    }
    free_count_ = free;
    if (may_refer_) [[unlikely]]
      EndReferences(free_before);
  }
  // Of the buffers that are free since then. Apart, so that who looks saves no registers for it.
  [[gnu::noinline]] void EndReferences(std::uint32_t free_before) noexcept {
    for (std::uint32_t i = free_before; i < free_count_; ++i) buffers_[i]->EndReference();
  }

  // A closed pool has no newest buffer, and all who may have leased have passed their fences: they are
  // ordered before its closing. From then on this thread is in the publisher's place.
  [[nodiscard]] bool IsHeld() noexcept override {
    std::uint32_t free_before = 0;
    do {  // again as long as some are free now: they may have held others of this pool
      free_before = free_count_;
      FindFree(nullptr, [] { return Domain::kAll; });
    } while (free_count_ > free_before && free_count_ < count_);
    return free_count_ < count_;
  }

  Domain& domain_;
  const bool may_grow_;
  const Factory factory_;
  // These are the publisher's own.
  // First the free ones, of which the last is taken first; a loan moves only the border between
  // them and the others: loaned, newest, or held by readers when they were last looked at.
  Buffer** buffers_ = nullptr;
  std::uint32_t free_count_ = 0;
  std::uint32_t count_ = 0;
  std::uint32_t list_capacity_ = 0;
  std::uint32_t search_ = 0;
  bool may_refer_ = false;  // whether one of them may refer to a value elsewhere
  Chunk* chunks_ = nullptr;
  alignas(kCacheLineSize) Atomic<Chunk*> arriving_{nullptr};  // reserved, not yet taken over
  Atomic<std::uint32_t> capacity_{0};
  Atomic<std::uint64_t> growths_{0};
};

}  // namespace runnel
