#include "core/channel/channel_base.h"

#include <algorithm>
#include <utility>

#include "core/channel/input_queue_base.h"
#include "core/lockfree/thread_epoch.h"

namespace runnel {

namespace {

std::uint64_t NextChannelNumber() noexcept {
  static std::atomic<std::uint64_t> last{0};
  // relaxed: only that the numbers differ matters.
  return last.fetch_add(1, std::memory_order_relaxed) + 1;
}

}  // namespace

const std::vector<std::string>& OnFullNames() {
  static const std::vector<std::string> names{"drop_oldest", "drop_newest", "refuse"};
  return names;
}

ChannelBase::ChannelBase(bool pullable)
    : number_(NextChannelNumber()),
      flags_(static_cast<std::uint8_t>((pullable ? kPullable : 0) |
                                       (Fences<std::atomic>::HeavyIsHeavy() ? 0 : kPassesFullFences))),
      pull_point_(pullable ? std::make_unique<PullPoint>() : nullptr) {}

ChannelBase::~ChannelBase() { delete subscribers_.load(std::memory_order_relaxed); }

void ChannelBase::SetSubscribers(Subscribers subscribers) {
  const bool has_others = !subscribers.probes.empty() || !subscribers.wakers.empty();
  subscribers.only_queue = subscribers.queues.size() == 1 && !has_others ? subscribers.queues.front() : nullptr;
  const Subscribers* next = subscribers.empty() ? nullptr : new Subscribers(std::move(subscribers));
  // acq_rel: release, pairs with the acquire in subscribers(); acquire for the next line.
  const Subscribers* previous = subscribers_.exchange(next, std::memory_order_acq_rel);
  if (previous != nullptr) Retire([previous] { delete previous; });
  // Between saying who subscribes and reading the newest value; pairs with subscribers().
  if (next != nullptr) HeavyFence();
}

bool ChannelBase::WouldRefuse() const noexcept {
  if (subscribers() == nullptr) return false;
  return Guarded([this] {
    const Subscribers* const list = subscribers_in_guard();
    return list != nullptr && std::ranges::any_of(list->queues, [](QueueSink* sink) {
             // What is no probe is the queue of an input.
             return static_cast<InputQueueBase&>(*sink).WouldRefuse();
           });
  });
}

void ChannelBase::Pull(ValueTimes (*times)(const Port& reader), const Port& reader) noexcept {
  if (pull_point_ == nullptr || !pull_point_->has_provider()) return;
  const PullPoint::Lock lock(*pull_point_);
  if (!lock.held()) return;
  try {
    PublishPulled(times, reader);
  } catch (...) {
    pull_point_->CountFailure();
  }
}

void ChannelBase::DeleteLater(ChannelBase* channel) {
  Retire([channel] { delete channel; });
}

void ChannelBase::SetOrdered() noexcept { flags_.fetch_or(kOrdered, std::memory_order_relaxed); }

std::uint64_t ChannelBase::TakeOrderNumber() noexcept {
  static std::atomic<std::uint64_t> last{0};
  // relaxed: the number decides which of two values is the later one for all readers alike; it
  // travels with the value and orders no other memory.
  return last.fetch_add(1, std::memory_order_relaxed) + 1;
}

}  // namespace runnel
