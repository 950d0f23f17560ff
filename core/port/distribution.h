#pragma once

#include <cstdint>
#include <utility>

#include "core/lockfree/buffer.h"
#include "core/lockfree/buffer_lease.h"
#include "core/lockfree/publication.h"
#include "core/port/input_queue.h"
#include "core/port/lease.h"
#include "core/port/port_options.h"
#include "core/port/probe_queue.h"
#include "core/port/subscribers.h"

namespace runnel::internal {

// How a value that has been published gets to who subscribes to its channel. `source` is the channel's
// number; `buffer` is the one that the value lies in, or nullptr if its type travels without.

/// That of the channel's type: connecting has checked it.
template <typename T>
InputQueue<T>& QueueOf(QueueSink& sink) noexcept {
  return static_cast<InputQueue<T>&>(sink);
}

template <typename T>
[[gnu::always_inline]] inline PublishStatus PushTo(QueueSink& sink, const T& value,
                                                   const Publication& publication,
                                                   [[maybe_unused]] Buffer<T>* buffer,
                                                   std::uint64_t source) noexcept {
  InputQueue<T>& queue = QueueOf<T>(sink);
  bool taken;
  if constexpr (kLiesInQueuesAsCopy<T>) {
    taken = queue.Push(value, publication, source);
  } else {
    buffer->AddReferences(1);
    taken = queue.Push(HeldValue<T>(BufferLease<T>(buffer)), source);
  }
  return taken ? PublishStatus::kPublished : PublishStatus::kRefused;
}

template <typename T>
void PushTo(ProbeQueue& probe, const T& value, const Publication& publication, Buffer<T>* buffer,
            std::uint64_t source) noexcept {
  if constexpr (kLiesInQueuesAsCopy<T>) {
    probe.PushCopy(value, publication, source);
  } else {
    probe.PushLease(*buffer, source);
  }
}

/// Inside an EpochGuard, by which the list lives.
template <typename T>
[[gnu::noinline]] PublishStatus PushToAll(const Subscribers& list, const T& value,
                                          const Publication& publication, Buffer<T>* buffer,
                                          std::uint64_t source) noexcept {
  PublishStatus status = PublishStatus::kPublished;
  for (QueueSink* queue : list.queues) {
    const PublishStatus pushed = PushTo(*queue, value, publication, buffer, source);
    if (pushed == PublishStatus::kRefused) status = pushed;
  }
  for (ProbeQueue* probe : list.probes) PushTo(*probe, value, publication, buffer, source);
  for (Waker* waker : list.wakers) waker->Wake();
  return status;
}

}  // namespace runnel::internal
