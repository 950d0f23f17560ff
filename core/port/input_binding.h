#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "core/channel/channel_base.h"
#include "core/channel/input_queue_base.h"
#include "core/channel/value_times.h"
#include "core/lockfree/publication.h"
#include "core/port/cycle.h"

namespace runnel::internal {

/// The reader's own notes, relaxed atomics only so that viewers and connecting may look at them.
struct RelaxedNumber {
  [[nodiscard]] std::uint64_t load_relaxed() const noexcept { return value.load(std::memory_order_relaxed); }
  // One thread writes: no read-modify-write is needed.
  std::uint64_t exchange_relaxed(std::uint64_t next) noexcept {
    const std::uint64_t before = load_relaxed();
    value.store(next, std::memory_order_relaxed);
    return before;
  }
  std::atomic<std::uint64_t> value{0};
};

/// What the reader keeps about one source; lives as long as the connection.
struct InputLink {
  explicit InputLink(ChannelBase* source) : channel(source), number(source->number()) {}

  // Marks a value as read; returns which was before.
  [[gnu::always_inline]] std::uint64_t Note(std::uint64_t sequence) noexcept { return read.exchange_relaxed(sequence); }

  ChannelBase* const channel;
  const std::uint64_t number;  // of the channel, also when that is gone
  RelaxedNumber read;          // sequence of the value read last
  std::uint64_t taken = 0;     // sequence of the value taken last; the reader's own
};

/// Which of two values counts: by the common order of sources that share an input, which every
/// reader sees alike. Values from before the sharing have none; their time and then the age of their
/// source decide.
[[nodiscard]] bool IsLater(const Publication& a, const InputLink& from_a, const Publication& b,
                           const InputLink& from_b) noexcept;

class StopLink;

/// What reading needs, but for the type of the values; never changed but for
/// the reader's own notes, replaced as a whole.
struct InputBinding {
  using Link = InputLink;

  // If there is one source and nothing else to be looked at, the fast path to it; else nullptr.
  ChannelBase* channel = nullptr;
  Link* only = nullptr;  // if there is one source
  bool pulls = false;
  bool ages = false;                             // what is read ages what is published in the same cycle
  std::vector<std::shared_ptr<StopLink>> stops;  // on the way from the sources; shared as `links` are
  std::vector<std::shared_ptr<Link>> links;      // shared by the binding before and after a change
  std::shared_ptr<InputQueueBase> queue;         // likewise
  // Queues that another one has replaced: what waits in them comes first.
  std::vector<std::shared_ptr<InputQueueBase>> older_queues;
  std::vector<InputQueueBase*> all_queues;  // these and then the present one; if there are any
  std::uint64_t dropped_before = 0;         // by queues that are no longer among the older ones

  [[nodiscard]] std::size_t WaitingInOlder() const noexcept;
  [[nodiscard]] std::uint64_t dropped() const noexcept;
  [[nodiscard]] bool HasNext() const noexcept;
  /// The stop whose safe value readers find instead of what was published at these times, or instead of nothing;
  /// nullptr: none. Of several the one that was released last.
  [[nodiscard]] StopLink* StopBefore(std::optional<ValueTimes> times) const noexcept;
  /// What has been read at these times.
  void NoteRead(const void* value, ValueTimes times) const noexcept {
    if (ages) AgeCycle(times.timestamp);
    if (!stops.empty()) NoteForStops(value, times);
  }
  /// The first one whose safe value has to be taken (Input::Take()); nullptr: none.
  [[nodiscard]] StopLink* StopToTake() const noexcept;
  [[nodiscard]] std::shared_ptr<Link> LinkOf(const ChannelBase& source) const noexcept;
  [[nodiscard]] Link* FindLink(std::uint64_t number) const noexcept {
    if (only != nullptr && only->number == number) [[likely]]
      return only;
    return FindLinkOfSeveral(number);
  }

 private:
  void NoteForStops(const void* value, ValueTimes times) const noexcept;
  [[nodiscard]] Link* FindLinkOfSeveral(std::uint64_t number) const noexcept;
};

}  // namespace runnel::internal
