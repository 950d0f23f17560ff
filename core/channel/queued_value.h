#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>

#include "core/channel/lease.h"
#include "core/channel/probe_queue.h"
#include "core/lockfree/publication.h"

namespace runnel {

/// Whether values of T lie in queues as copies, so that whoever takes one out touches no buffer of
/// its publisher. So do all types whose leases can hold a copy.
template <typename T>
inline constexpr bool kLiesInQueuesAsCopy =
    std::is_constructible_v<internal::HeldValue<T>, const T&, const Publication&>;

namespace internal {

/// What lies in a queue: a copy of a value, of whatever type has this size and alignment …
template <std::size_t kSize, std::size_t kAlignment>
struct QueuedCopy {
  /// What a publisher shows to each queue, and what goes into one: where the value lies.
  using Shown = const void*;
  using Content = const void*;

  QueuedCopy(Content copied, const Publication& of, std::uint64_t from) noexcept
      : source(from), timestamp(of.timestamp), publication_time(of.publication_time), own_sequence(of.sequence) {
    std::memcpy(value, copied, kSize);
  }
  [[nodiscard]] std::uint64_t sequence() const noexcept { return own_sequence; }
  // What is in a queue has its order by that.
  [[nodiscard]] Publication publication() const noexcept { return {timestamp, own_sequence, 0, publication_time}; }

  // Without the order: so a value of 24 bytes lies in one line with all this and its cell's number.
  std::uint64_t source;
  std::int64_t timestamp;
  std::int64_t publication_time;
  std::uint64_t own_sequence;
  alignas(kAlignment) std::byte value[kSize];

  static void PushTo(ProbeQueue& probe, Shown shown, const Publication& publication, std::uint64_t source) noexcept {
    probe.PushCopy(shown, kSize, publication, source);
  }
};

/// … or a reference to its buffer.
struct QueuedReference {
  struct Shown {
    BufferBase<>* buffer;
    const void* value;  ///< in the buffer
    operator BufferReference() const noexcept { return BufferReference(*buffer); }
  };
  using Content = BufferReference;

  QueuedReference(BufferReference&& taken_over, const Publication&, std::uint64_t from) noexcept
      : source(from), reference(std::move(taken_over)) {}
  [[nodiscard]] std::uint64_t sequence() const noexcept { return reference.get()->publication.sequence; }

  std::uint64_t source;
  BufferReference reference;

  static void PushTo(ProbeQueue& probe, Shown shown, const Publication& publication, std::uint64_t source) noexcept {
    probe.PushReference(shown, shown.value, publication, source);
  }
};

/// Types of one size share what follows from this, so that each costs its user less code.
template <typename T>
using Queued = std::conditional_t<kLiesInQueuesAsCopy<T>, QueuedCopy<sizeof(T), alignof(T)>, QueuedReference>;

/// Moves the value out of a queue.
template <typename T>
void MoveTo(HeldValue<T>& held, Queued<T>& queued) noexcept {
  if constexpr (kLiesInQueuesAsCopy<T>) {
    // In its place: the value is copied once.
    std::destroy_at(&held);
    std::construct_at(&held, *std::launder(reinterpret_cast<const T*>(queued.value)), queued.publication());
  } else {
    held = HeldValue<T>(BufferLease<T>(static_cast<Buffer<T>*>(queued.reference.Take())));
  }
}

}  // namespace internal
}  // namespace runnel
