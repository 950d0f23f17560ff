#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>

#include "core/base/clock.h"
#include "core/channel/channel_options.h"
#include "core/channel/pull_point.h"
#include "core/channel/subscribers.h"
#include "core/channel/value_times.h"
#include "core/lockfree/asymmetric_fence.h"

namespace runnel {

class Port;

namespace internal {
template <typename Queued>
class Distribution;
}

/// What an output and the inputs connected to it share, apart from the type of the values: the
/// output publishes into its channel, and the inputs read from it.
///
/// Threads:  SetSubscribers() and SetOrdered() under the structure lock; the rest as stated.
class ChannelBase {
 public:
  virtual ~ChannelBase();
  ChannelBase(const ChannelBase&) = delete;
  ChannelBase& operator=(const ChannelBase&) = delete;

  /// Different for each channel of the process, never 0, ascending with time.
  [[nodiscard]] std::uint64_t number() const noexcept { return number_; }
  [[nodiscard]] virtual std::uint64_t publications() const noexcept = 0;

  /// Swaps the list that publishers visit; the old one goes when nobody can still look at it. A value
  /// whose publisher does not find the new list is seen by who reads the newest value from now on.
  void SetSubscribers(Subscribers subscribers);
  /// A channel that shares an input with others numbers its values in one order with theirs, from now on for
  /// ever: else a number from before would outdo a later value.
  void SetOrdered() noexcept;
  /// Sees to it that `leases` values can wait in queues besides those that the pool's options plan
  /// for. Allocates.
  virtual void ReserveFor(std::size_t leases) = 0;
  /// Pushes the newest value, if there is one, into a probe's queue, or into that of an input of this
  /// channel's type, see InputQueue::PutFirst(). Call inside an EpochGuard.
  virtual void DeliverNewest(QueueSink& sink) = 0;
  /// Shows the newest value; false if there is none. Any thread.
  virtual bool VisitLatest(const std::function<void(const void* value, ValueTimes times)>& visit) const = 0;
  /// Has `fill(context, value)` write a value into a free buffer, and publishes it; nothing if that says that
  /// there is none. For the publisher. Precondition: can_be_filled().
  virtual std::optional<PublishStatus> PublishFilled(bool (*fill)(void* context, void* value), void* context,
                                                     ValueTimes times) = 0;
  /// Whether others than the module that publishes can make values: T{}, or what lies in a buffer.
  [[nodiscard]] virtual bool can_be_filled() const noexcept = 0;
  /// Whether readers can hold a value that lies in no buffer.
  [[nodiscard]] virtual bool gives_copies() const noexcept = 0;
  /// Whether a queue that refuses is full.
  [[nodiscard]] bool WouldRefuse() const noexcept;
  /// Has the provider, if there is one and nobody is publishing just now, make
  /// a value in this thread and publishes it with the times that `times(reader)`
  /// returns then. Any thread, inside a guard.
  void Pull(ValueTimes (*times)(const Port& reader), const Port& reader) noexcept;

  /// What readers pull by; nullptr if the output is not pullable.
  [[nodiscard]] PullPoint* pull_point() const noexcept { return pull_point_.get(); }

  /// Deletes `channel` when no reader can still be looking at it.
  static void DeleteLater(ChannelBase* channel);

 protected:
  enum class PublishPath { kFast, kSlow };
  /// Whom to visit after publishing; nullptr if nobody, and to be called again inside an
  /// EpochGuard if somebody.
  [[nodiscard, gnu::always_inline]] const Subscribers* subscribers(
      PublishPath path = PublishPath::kSlow) const noexcept {
    // Between publishing and looking for subscribers; pairs with the heavy fence in
    // SetSubscribers(): the publisher sees the subscriber, or that one sees the value.
    if (path == PublishPath::kFast) {
      Fences<std::atomic>::LightIfHeavyIsHeavy();
    } else {
      LightFence();
    }
    // acquire: pairs with the release in SetSubscribers().
    return subscribers_.load(std::memory_order_acquire);
  }
  // For who has passed that fence already. Inside an EpochGuard.
  [[nodiscard]] const Subscribers* subscribers_in_guard() const noexcept {
    return subscribers_.load(std::memory_order_acquire);  // as above
  }
  /// What makes publishing more than it usually is; bits, so that one look is enough.
  enum Flag : std::uint8_t { kOrdered = 1, kPullable = 2, kPassesFullFences = 4 };
  explicit ChannelBase(bool pullable);
  /// Has the provider fill a free buffer, and publishes that. By who has the lock. Throws what the
  /// provider throws.
  virtual void PublishPulled(ValueTimes (*times)(const Port& reader), const Port& reader) = 0;
  // relaxed, as all of it: a publisher that sees a change late numbers one value less, which then
  // counts as older than all numbered ones.
  [[nodiscard]] bool Has(Flag flag) const noexcept { return (flags_.load(std::memory_order_relaxed) & flag) != 0; }
  [[nodiscard, gnu::always_inline]] bool HasFlags() const noexcept {
    return flags_.load(std::memory_order_relaxed) != 0;
  }
  [[nodiscard]] std::uint64_t OrderNumber() const noexcept { return Has(kOrdered) ? TakeOrderNumber() : 0; }

 private:
  template <typename>
  friend class internal::Distribution;

  static std::uint64_t TakeOrderNumber() noexcept;

  const std::uint64_t number_;
  std::atomic<const Subscribers*> subscribers_{nullptr};
  std::atomic<std::uint8_t> flags_;
  const std::unique_ptr<PullPoint> pull_point_;
};

}  // namespace runnel
