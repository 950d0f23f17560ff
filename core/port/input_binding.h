#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/lockfree/queue_succession.h"
#include "core/port/channel.h"
#include "core/port/input_queue.h"
#include "core/port/lease.h"

namespace runnel::internal {

/// The reader's own notes, relaxed atomics only so that viewers and connecting may look at them.
struct RelaxedNumber {
  [[nodiscard]] std::uint64_t load_relaxed() const noexcept {
    return value.load(std::memory_order_relaxed);
  }
  // One thread writes: no read-modify-write is needed.
  std::uint64_t exchange_relaxed(std::uint64_t next) noexcept {
    const std::uint64_t before = load_relaxed();
    value.store(next, std::memory_order_relaxed);
    return before;
  }
  std::atomic<std::uint64_t> value{0};
};

/// What the reader keeps about one source; lives as long as the connection.
template <typename T>
struct InputLink {
  explicit InputLink(Channel<T>* source) : channel(source), number(source->number()) {}

  // Marks a value as read; returns which was before.
  [[gnu::always_inline]] std::uint64_t Note(std::uint64_t sequence) noexcept {
    return read.exchange_relaxed(sequence);
  }

  Channel<T>* const channel;
  const std::uint64_t number;  // of the channel, also when that is gone
  RelaxedNumber read;          // sequence of the value read last
  std::uint64_t taken = 0;     // sequence of the value taken last; the reader's own
};

/// Which of two values counts: by the common order of sources that share an input, which every
/// reader sees alike. Values from before the sharing have none; their time and then the age of their
/// source decide.
template <typename T>
bool IsLater(const HeldValue<T>& a, const InputLink<T>& from_a, const HeldValue<T>& b,
             const InputLink<T>& from_b) noexcept {
  const Publication& p = a.publication();
  const Publication& q = b.publication();
  if (p.order != 0 && q.order != 0) return p.order > q.order;
  if (p.stamp != q.stamp) return p.stamp > q.stamp;
  return from_a.number > from_b.number;
}

/// What reading needs; never changed but for the reader's own notes, replaced as a whole.
template <typename T>
struct InputBinding {
  using Link = InputLink<T>;

  // If there is one source and no pulling, the short way to it; else nullptr.
  Channel<T>* channel = nullptr;
  Link* only = nullptr;  // if there is one source
  bool pulls = false;
  std::vector<std::shared_ptr<Link>> links;  // shared by the binding before and after a change
  std::shared_ptr<InputQueue<T>> queue;      // likewise
  // Queues that another one has replaced: what waits in them comes first.
  std::vector<std::shared_ptr<InputQueue<T>>> older_queues;
  std::vector<InputQueue<T>*> all_queues;  // these and then the present one; if there are any
  std::uint64_t dropped_before = 0;        // by queues that are no longer among the older ones

  [[nodiscard]] bool Pop(internal::HeldValue<T>& held, std::uint64_t& source) const noexcept {
    if (older_queues.empty()) [[likely]]
      return queue && queue->Pop(held, source);
    return PopFromAll(held, source);
  }
  [[gnu::noinline]] bool PopFromAll(internal::HeldValue<T>& held,
                                    std::uint64_t& source) const noexcept {
    const bool popped = PopInOrder(all_queues, [&](InputQueue<T>& each, const auto& may) {
      return each.PopIf(may, held, source);
    });
    if (queue) queue->SetWaitingBefore(WaitingInOlder());
    return popped;
  }
  [[nodiscard]] std::size_t WaitingInOlder() const noexcept {
    std::size_t sum = 0;
    for (const auto& older : older_queues) sum += older->size();
    return sum;
  }
  [[nodiscard]] std::uint64_t dropped() const noexcept {
    std::uint64_t sum = dropped_before + (queue ? queue->dropped() : 0);
    for (const auto& older : older_queues) sum += older->dropped();
    return sum;
  }
  [[nodiscard]] bool HasNext() const noexcept {
    for (const auto& older : older_queues) {
      if (older->HasNext()) return true;
    }
    return queue && queue->HasNext();
  }
  [[nodiscard]] std::shared_ptr<Link> LinkOf(const Channel<T>& source) const noexcept {
    for (const auto& link : links) {
      if (link->channel == &source) return link;
    }
    return nullptr;
  }
  [[nodiscard]] Link* FindLink(std::uint64_t number) const noexcept {
    if (only != nullptr && only->number == number) [[likely]]
      return only;
    for (const auto& link : links) {
      if (link->number == number) return link.get();
    }
    return nullptr;
  }
};

}  // namespace runnel::internal
