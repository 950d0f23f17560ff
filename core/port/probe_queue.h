#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>

#include "core/lockfree/bounded_queue.h"
#include "core/lockfree/buffer.h"
#include "core/port/subscribers.h"

namespace runnel {

/// The values that wait at a ProbePort: of a type that the probe does not know. Plain values up to 256 bytes
/// are copied, all others leased, as in the queue of an input.
///
/// Threads:     Push() by any publisher, TryTake() by one reader at a time.
/// Progress:    lock-free. A full queue keeps what it has, and counts what does not fit.
/// Allocation:  in the constructor only.
class ProbeQueue final : public QueueSink {
 public:
  explicit ProbeQueue(std::size_t capacity) : values_(capacity) {}

  /// A copy of `value`, from the channel with the number `source`.
  template <typename T>
  void PushCopy(const T& value, const Publication& publication, std::uint64_t source) noexcept {
    static_assert(std::is_trivially_copyable_v<T> && sizeof(T) <= kLargestCopy &&
                  alignof(T) <= kCacheLineSize);
    PushBytes(&value, sizeof value, publication, source);
  }
  /// What is in `buffer`, which the caller holds.
  template <typename T>
  void PushLease(Buffer<T>& buffer, std::uint64_t source) noexcept {
    buffer.AddReferences(1);
    PushHold({&buffer, &std::as_const(buffer).value(),
              [](void* held) { static_cast<Buffer<T>*>(held)->ReleaseReference(); }},
             buffer.publication, source);
  }

  /// Calls `use(value, publication, source)` for the oldest value, then lets it go; false if there is
  /// none.
  template <typename Use>
  bool TryTake(Use&& use) noexcept {
    return values_.TryConsume(
        [&](const Waiting& oldest) { use(oldest.value(), oldest.publication, oldest.source); });
  }

  [[nodiscard]] std::size_t capacity() const noexcept override { return values_.capacity(); }
  [[nodiscard]] ProbeQueue* probe() noexcept override { return this; }
  [[nodiscard]] std::size_t size() const noexcept { return values_.size(); }
  [[nodiscard]] bool HasNext() const noexcept { return values_.HasOldest(); }
  [[nodiscard]] std::uint64_t dropped() const noexcept {
    return dropped_.load(std::memory_order_relaxed);
  }

 private:
  static constexpr std::size_t kLargestCopy = 256;

  /// One reference to a buffer, whose type only `release` knows.
  struct Hold {
    void* buffer = nullptr;
    const void* value = nullptr;
    void (*release)(void* buffer) = nullptr;
  };
  struct Waiting {
    Waiting(const void* copied, std::size_t size, const Publication& of,
            std::uint64_t from) noexcept
        : publication(of), source(from) {
      std::memcpy(copy, copied, size);
    }
    Waiting(const Hold& held, const Publication& of, std::uint64_t from) noexcept
        : hold(held), publication(of), source(from) {}
    Waiting(Waiting&& other) noexcept
        : hold(std::exchange(other.hold, {})),
          publication(other.publication),
          source(other.source) {
      std::memcpy(copy, other.copy, sizeof copy);
    }
    ~Waiting() {
      if (hold.release != nullptr) hold.release(hold.buffer);
    }
    [[nodiscard]] const void* value() const noexcept {
      return hold.value != nullptr ? hold.value : copy;
    }

    Hold hold;
    Publication publication;
    std::uint64_t source;
    alignas(kCacheLineSize) std::byte copy[kLargestCopy];  // if nothing is held
  };

  void PushBytes(const void* value, std::size_t size, const Publication& publication,
                 std::uint64_t source) noexcept;
  // Lets go of what does not fit.
  void PushHold(const Hold& hold, const Publication& publication, std::uint64_t source) noexcept;

  BoundedQueue<Waiting> values_;
  std::atomic<std::uint64_t> dropped_{0};
};

}  // namespace runnel
