#pragma once

#include <atomic>

#include "core/lockfree/buffer_pool.h"

namespace runnel {

/// The newest published buffer of a pool: the zero-copy path of the ports.
///
/// Threads:   Replace() and Read() may be called concurrently from any threads.
/// Progress:  Replace() is wait-free apart from sending the previous buffer home (lock-free);
/// Read()
///            is lock-free: it repeats only if a Replace() happened in between.
/// Lifetime:  the pool must outlive the slot, and Clear() must be called before the pool is closed.
template <typename T, template <typename> class Atomic = std::atomic>
class LatestBuffer {
 public:
  using Pool = BufferPool<T, Atomic>;
  using Buffer = typename Pool::Buffer;
  using Tag = typename Pool::Tag;

  /// Takes over the lease that comes with `tag` and drops the one of the buffer before.
  void Replace(Pool& pool, Tag tag) noexcept {
    // release: publishes the payload. acquire: the previous publisher's first lease is in the
    // count before it is dropped here. seq_cst beyond that: as in LatestValue::Publish(), between
    // publisher and subscriber at least one sees the other.
    const Tag previous = newest_.exchange(tag, std::memory_order_seq_cst);
    if (previous != Pool::kNoTag) pool.Named(previous).DropLease();
  }
  void Clear(Pool& pool) noexcept { Replace(pool, Pool::kNoTag); }

  /// A lease of the newest buffer, or nullptr before the first one.
  [[nodiscard]] Buffer* Read(Pool& pool) const noexcept {
    for (;;) {
      // acquire: pairs with the release in Replace(); everything the writer put into the buffer
      // is visible from here on. seq_cst: see there.
      const Tag tag = newest_.load(std::memory_order_seq_cst);
      if (tag == Pool::kNoTag) return nullptr;
      if (Buffer* buffer = pool.TryLease(tag)) return buffer;
      // The buffer went home between the two steps, hence a newer one has been published.
    }
  }

 private:
  Atomic<Tag> newest_{Pool::kNoTag};
};

}  // namespace runnel
