#pragma once

#include <cstddef>
#include <utility>

#include "core/lockfree/buffer.h"
#include "core/lockfree/hazard.h"

namespace runnel {

/// Keeps one buffer from being reused, by a slot of a reader's record or, without one, by a reference.
///
/// Ownership:   of the hold alone; the buffer belongs to its pool, which lives as long as it is held.
/// Threads:     one lease belongs to one thread at a time, and may be handed on; copies are
///              independent.
/// Progress:    wait-free. Copying and dropping a copy write to the buffer's count, which readers
///              share; moving, and dropping a lease with a slot, do not.
/// Allocation:  none, and nothing is freed: what the last lease of a closed pool leaves is deleted by
///              HazardDomain::Reclaim().
template <typename T, template <typename> class Atomic = std::atomic, std::size_t kSlots = 7>
class BufferLease {
 public:
  using Buffer = runnel::Buffer<T, Atomic, kSlots>;
  using Slot = HazardSlot<Atomic>;

  BufferLease() = default;
  /// Takes over one reference that the caller has; nullptr is no lease.
  explicit BufferLease(Buffer* counted) noexcept : buffer_(counted) {}
  /// Takes over a slot that holds `buffer`.
  BufferLease(Buffer* buffer, Slot& slot) noexcept : buffer_(buffer), slot_(&slot) {}
  BufferLease(const BufferLease& other) noexcept : buffer_(other.buffer_) {
    if (buffer_ != nullptr) buffer_->AddReferences(1);
  }
  BufferLease(BufferLease&& other) noexcept
      : buffer_(std::exchange(other.buffer_, nullptr)), slot_(std::exchange(other.slot_, nullptr)) {}
  BufferLease& operator=(BufferLease other) noexcept {
    std::swap(buffer_, other.buffer_);
    std::swap(slot_, other.slot_);
    return *this;
  }
  [[gnu::always_inline]] ~BufferLease() { Drop(); }

  [[nodiscard]] Buffer* get() const noexcept { return buffer_; }

 private:
  // What is seldom is not told where the lease lies, so that it can lie in registers.
  [[gnu::always_inline]] void Drop() noexcept {
    if (slot_ == nullptr) [[unlikely]] {
      if (buffer_ != nullptr) ReleaseCounted(*buffer_);
      return;
    }
    // release: pairs with the acquire in BufferPool::FindFree(); this reader's reads are over.
    slot_->held.store(nullptr, std::memory_order_release);
  }
  [[gnu::noinline]] static void ReleaseCounted(Buffer& buffer) noexcept { buffer.ReleaseReference(); }

  Buffer* buffer_ = nullptr;
  Slot* slot_ = nullptr;
};

}  // namespace runnel
