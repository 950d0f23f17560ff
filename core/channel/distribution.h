#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "core/channel/channel_base.h"
#include "core/channel/channel_options.h"
#include "core/channel/input_queue.h"
#include "core/channel/probe_queue.h"
#include "core/channel/subscribers.h"
#include "core/lockfree/publication.h"
#include "core/lockfree/thread_epoch.h"

namespace runnel::internal {

/// How a value that has been published gets to who subscribes to its channel. Types of which the same lies
/// in queues share it.
///
/// @tparam Queued  what lies in the queues for values of the channel's type (queued_value.h).
template <typename Queued>
class Distribution {
 public:
  using Shown = typename Queued::Shown;
  using Queue = InputQueue<Queued>;

  /// That of the channel's type: connecting has checked it.
  [[nodiscard]] static Queue& QueueOf(QueueSink& sink) noexcept { return static_cast<Queue&>(sink); }
  [[nodiscard, gnu::noinline]] static std::unique_ptr<InputQueueBase> MakeQueue(std::size_t capacity, OnFull on_full,
                                                                                Writers writers) {
    return std::make_unique<Queue>(capacity, on_full, writers);
  }

  /// Gives the value to each queue. Apart, so that publishing to readers of the newest value alone
  /// stays short. What is told about the value comes in registers: to load it in one piece from where
  /// it has just been stored in three would have to wait for all stores before.
  [[gnu::noinline]] static PublishStatus ToAll(const ChannelBase& channel, Shown shown, std::int64_t timestamp,
                                               std::int64_t publication_time, std::uint64_t sequence,
                                               std::uint64_t order) noexcept {
    return Guarded([&]() __attribute__((always_inline)) {
      const Subscribers* const list = channel.subscribers_in_guard();
      if (list == nullptr) return PublishStatus::kPublished;
      const Publication publication{timestamp, sequence, order, publication_time};
      if (list->only_queue == nullptr)  // a copy for it, as it asks where that lies
        return PushToAll(*list, shown, Publication(publication), channel.number());
      return PushTo(*list->only_queue, shown, publication, channel.number());
    });
  }
  /// Puts the newest value of the channel into a queue that is new to it.
  [[gnu::noinline]] static void ToNew(QueueSink& sink, Shown shown, const Publication& publication,
                                      std::uint64_t source) noexcept {
    if (ProbeQueue* const probe = sink.probe()) {
      Queued::PushTo(*probe, shown, publication, source);
    } else {
      QueueOf(sink).PutFirst(shown, publication, source);
    }
  }

 private:
  [[gnu::always_inline]] static PublishStatus PushTo(QueueSink& sink, Shown shown, const Publication& publication,
                                                     std::uint64_t source) noexcept {
    const bool taken = QueueOf(sink).Push(shown, publication, source);
    return taken ? PublishStatus::kPublished : PublishStatus::kRefused;
  }
  // Inside an EpochGuard, by which the list lives.
  [[gnu::noinline]] static PublishStatus PushToAll(const Subscribers& list, Shown shown, const Publication& publication,
                                                   std::uint64_t source) noexcept {
    PublishStatus status = PublishStatus::kPublished;
    for (QueueSink* queue : list.queues) {
      const PublishStatus pushed = PushTo(*queue, shown, publication, source);
      if (pushed == PublishStatus::kRefused) status = pushed;
    }
    for (ProbeQueue* probe : list.probes) Queued::PushTo(*probe, shown, publication, source);
    for (Waker* waker : list.wakers) waker->Wake();
    return status;
  }
};

// That of most types is compiled once, in the core.
extern template class Distribution<QueuedReference>;
extern template class Distribution<QueuedCopy<1, 1>>;
extern template class Distribution<QueuedCopy<4, 4>>;
extern template class Distribution<QueuedCopy<8, 8>>;
extern template class Distribution<QueuedCopy<16, 8>>;
extern template class Distribution<QueuedCopy<24, 8>>;
extern template class Distribution<QueuedCopy<32, 8>>;

template <typename T>
using DistributionOf = Distribution<Queued<T>>;

}  // namespace runnel::internal
