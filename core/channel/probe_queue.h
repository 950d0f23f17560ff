#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>

#include "core/channel/subscribers.h"
#include "core/lockfree/bounded_queue.h"
#include "core/lockfree/buffer.h"
#include "core/lockfree/publication.h"

namespace runnel {

/// One reference to a buffer, for who does not know its type: it keeps the buffer from being reused.
///
/// Threads: one at a time. Allocation: none.
class BufferReference {
 public:
  BufferReference() = default;
  /// Adds one. Precondition: the caller holds the buffer in some way.
  explicit BufferReference(BufferBase<>& buffer) noexcept : buffer_(&buffer) { buffer.AddReferences(1); }
  BufferReference(BufferReference&& other) noexcept : buffer_(std::exchange(other.buffer_, nullptr)) {}
  BufferReference& operator=(BufferReference&&) = delete;
  ~BufferReference() {
    if (buffer_ != nullptr) buffer_->ReleaseReference();
  }

  [[nodiscard]] const BufferBase<>* get() const noexcept { return buffer_; }
  /// The buffer, with the reference, which the caller has to release; nullptr if there is none.
  [[nodiscard]] BufferBase<>* Take() noexcept { return std::exchange(buffer_, nullptr); }

 private:
  BufferBase<>* buffer_ = nullptr;
};

/// The values that wait at a ProbePort: of a type that the probe does not know. Plain values up to 256 bytes
/// are copied, all others leased, as in the queue of an input.
///
/// Threads:     Push() by any publisher, TryTake() by one reader at a time.
/// Progress:    lock-free. A full queue keeps what it has, and counts what does not fit.
/// Allocation:  in the constructor only.
class ProbeQueue final : public QueueSink {
 public:
  explicit ProbeQueue(std::size_t capacity) : values_(capacity) {}

  /// A copy of the `size` bytes at `value`, from the channel with the number `source`.
  void PushCopy(const void* value, std::size_t size, const Publication& publication, std::uint64_t source) noexcept {
    if (values_.TryEmplace(value, size, publication, source)) return;
    // relaxed: a statistic.
    dropped_.fetch_add(1, std::memory_order_relaxed);
  }

  /// `value`, which lies in the buffer.
  void PushReference(BufferReference reference, const void* value, const Publication& publication,
                     std::uint64_t source) noexcept {
    if (values_.TryEmplace(std::move(reference), value, publication, source)) return;
    dropped_.fetch_add(1, std::memory_order_relaxed);
  }

  /// Calls `use(value, publication, source)` for the oldest value, then lets it go; false if there is
  /// none.
  template <typename Use>
  bool TryTake(Use&& use) noexcept {
    return values_.TryConsume([&](const Waiting& oldest) { use(oldest.value(), oldest.publication, oldest.source); });
  }

  [[nodiscard]] std::size_t capacity() const noexcept override { return values_.capacity(); }
  [[nodiscard]] ProbeQueue* probe() noexcept override { return this; }
  [[nodiscard]] std::size_t size() const noexcept { return values_.size(); }
  [[nodiscard]] bool HasNext() const noexcept { return values_.HasOldest(); }
  [[nodiscard]] std::uint64_t dropped() const noexcept { return dropped_.load(std::memory_order_relaxed); }

 private:
  static constexpr std::size_t kLargestCopy = 256;

  struct Waiting {
    Waiting(const void* copied, std::size_t size, const Publication& of, std::uint64_t from) noexcept
        : publication(of), source(from) {
      std::memcpy(copy, copied, size);
    }
    Waiting(BufferReference&& taken_over, const void* in_buffer, const Publication& of, std::uint64_t from) noexcept
        : reference(std::move(taken_over)), leased(in_buffer), publication(of), source(from) {}
    [[nodiscard]] const void* value() const noexcept { return leased != nullptr ? leased : copy; }

    BufferReference reference;
    const void* leased = nullptr;
    Publication publication;
    std::uint64_t source;
    alignas(kCacheLineSize) std::byte copy[kLargestCopy];  // if nothing is leased
  };

  BoundedQueue<Waiting> values_;
  std::atomic<std::uint64_t> dropped_{0};
};

}  // namespace runnel
