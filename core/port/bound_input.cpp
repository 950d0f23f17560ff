#include "core/port/bound_input.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/element/runtime.h"
#include "core/port/stand_in.h"
#include "core/port/stop_link.h"

namespace runnel {

constinit const internal::InputBinding BoundInput::kUnbound{};

BoundInput::BoundInput(FrameworkElement& group, std::string&& name, const TypeInfo& type, InputOptions&& options)
    : InputBase({group, std::move(name)}, type, std::move(options)) {}

BoundInput::~BoundInput() {
  // What is read while there is nothing else, a default value, is no connection, and is still bound.
  const Binding* const last = binding_.load(std::memory_order_relaxed);
  if (last != &kUnbound) delete last;
}

std::uint64_t BoundInput::dropped() const noexcept {
  const EpochGuard guard;
  return binding()->dropped();
}

std::size_t BoundInput::replaced_queues() const noexcept {
  const EpochGuard guard;
  return binding()->older_queues.size();
}

std::uint64_t BoundInput::publications() const noexcept {
  const EpochGuard guard;
  std::uint64_t sum = 0;
  for (const auto& link : binding()->links) sum += link->channel->publications();
  for (const auto& stop : binding()->stops) sum += stop->publications();
  return sum;
}

void BoundInput::DisconnectForEver() {
  SetWaker(nullptr);
  DisconnectAll();
}

void BoundInput::PullInto(const Binding& binding) const noexcept {
  if (!binding.pulls) return;
  for (const auto& link : binding.links) {
    // What the provider reads makes its own value old, not what the reader has published or will.
    std::optional<CycleScope> scope;
    if (const Cycle* const cycle = CurrentCycle()) scope.emplace(Cycle{cycle->now, cycle->period});
    link->channel->Pull([](const Port& reader) { return static_cast<const BoundInput&>(reader).PublicationTimes(); },
                        *this);
  }
}

QueueSink* BoundInput::Bind(const std::vector<Source>& sources) {
  const Binding* before = binding_.load(std::memory_order_relaxed);
  replaced_.reserve(replaced_.size() + 1);  // what fails has replaced nothing
  if (!before->links.empty()) last_links_ = before->links;
  std::vector<internal::PassedStop> stops = internal::PassedStops(*this);
  if (sources.empty() && stops.empty()) {
    Replace(&kUnbound);
    return nullptr;
  }
  auto next = std::make_unique<Binding>();
  next->pulls = strategy() == Strategy::kPull;
  ConnectOptions options;
  fresh_.clear();
  for (const Source& source : sources) {
    ChannelBase* const channel = ChannelOf(*source.output);
    next->links.push_back(KeepOrMakeLink(*before, *channel));
    if (source.options.queue > options.queue) options = source.options;
    next->pulls = next->pulls || source.options.pull;
  }
  if (sources.size() == 1) {
    next->only = next->links.front().get();
  }
  BindStops(*before, *next, std::move(stops));
  next->ages = ageing() == Ageing::kTimesOut;
  if (next->only != nullptr && !next->pulls && !next->ages && next->stops.empty()) {
    next->channel = next->only->channel;
  }
  if (options.queue > 0) next->queue = KeepOrMakeQueue(*before, *next, options);
  if (!sources.empty()) KeepWaitingValues(*before, *next);
  InputQueueBase* const queue = next->queue.get();
  Replace(next.release());
  return queue;
}

void BoundInput::BindStops(const Binding& before, Binding& next, std::vector<internal::PassedStop> stops) {
  for (internal::PassedStop& stop : stops) {
    const auto is_it = [&](const auto& link) { return link->Is(stop); };
    if (const auto kept = std::ranges::find_if(before.stops, is_it); kept != before.stops.end()) {
      next.stops.push_back(*kept);
    } else if (auto channel = internal::MakeChannelFor(type())) {
      next.stops.push_back(std::make_shared<internal::StopLink>(std::move(stop), std::move(channel), runtime()));
    }
  }
}

void BoundInput::TellStops(const Subscribers& subscribers) {
  const Binding& binding = *binding_.load(std::memory_order_relaxed);
  for (const auto& stop : binding.stops) stop->SetSubscribers(subscribers, binding.queue != nullptr);
}

std::shared_ptr<internal::InputLink> BoundInput::KeepOrMakeLink(const Binding& before, ChannelBase& channel) {
  if (const auto kept = before.LinkOf(channel)) return kept;
  fresh_.push_back(&channel);
  auto link = std::make_shared<Link>(&channel);
  // A source that comes back at once does not bring what has been read already as new.
  for (const auto& last : last_links_) {
    if (last->number == channel.number()) link->read.exchange_relaxed(last->read.load_relaxed());
  }
  return link;
}

std::shared_ptr<InputQueueBase> BoundInput::KeepOrMakeQueue(const Binding& before, const Binding& next,
                                                            const ConnectOptions& options) const {
  const Writers writers = next.only != nullptr ? Writers::kOne : Writers::kSeveral;
  // A queue for one writer serves the source it was made for: another might begin before that
  // one has ended.
  if (before.queue && before.queue->capacity() == options.queue && before.queue->on_full() == options.on_full &&
      before.queue->writers() == writers && (writers == Writers::kSeveral || before.only == next.only)) {
    return before.queue;
  }
  return MakeQueue(options.queue, options.on_full, writers);
}

void BoundInput::KeepWaitingValues(const Binding& before, Binding& next) {
  next.dropped_before = before.dropped_before;
  for (const auto& older : before.older_queues) {
    // A publisher that found the queue before it was replaced may still put a value in. Its
    // leaving comes before the look at the size.
    const bool settled = older->left_in_epoch != 0 && ProcessEpochs().HasPassed(older->left_in_epoch);
    if (!settled || older->size() > 0) {
      next.older_queues.push_back(older);
    } else {
      next.dropped_before += older->dropped();
    }
  }
  if (before.queue && before.queue != next.queue) next.older_queues.push_back(before.queue);
  if (next.older_queues.empty()) return;
  for (const auto& older : next.older_queues) next.all_queues.push_back(older.get());
  if (!next.queue) return;
  next.all_queues.push_back(next.queue.get());
  // However often queues change, no more than twice the room can wait.
  for (const auto& older : next.older_queues) {
    while (next.WaitingInOlder() > next.queue->capacity() && older->DropOldest()) {
    }
  }
  next.queue->SetWaitingBefore(next.WaitingInOlder());
}

// A new connection delivers the last value at once. It is read after publishers have begun to fill
// the queue, so that none is lost; Take() leaves out one that is there twice for that reason.
void BoundInput::Bound() {
  const Binding* binding = binding_.load(std::memory_order_relaxed);
  for (auto& each : replaced_) {
    for (const auto& stop : each->stops) {
      if (std::ranges::find(binding->stops, stop) == binding->stops.end()) stop->End();
    }
    Retire([replaced = each.release()] { delete replaced; });
  }
  replaced_.clear();
  for (const auto& older : binding->older_queues) {
    if (older->left_in_epoch == 0) older->left_in_epoch = ProcessEpochs().Advance();
  }
  if (!binding->queue) return;
  const EpochGuard guard;
  for (ChannelBase* channel : fresh_) channel->DeliverNewest(*binding->queue);
  fresh_.clear();
}

// One of the two is not connected, so that nothing is replaced.
void BoundInput::TakeOverBinding(InputBase& from) noexcept {
  auto& other = static_cast<BoundInput&>(from);
  // acq_rel, release: as in Replace().
  const Binding* const taken =
      other.binding_.exchange(binding_.load(std::memory_order_relaxed), std::memory_order_acq_rel);
  binding_.store(taken, std::memory_order_release);
  last_links_.swap(other.last_links_);
}

// The previous binding owns the queue that publishers may still find; it goes in Bound().
void BoundInput::Replace(const Binding* next) {
  replaced_.emplace_back();
  // acq_rel: release, pairs with the acquire of readers; acquire for who destroys the old one.
  const Binding* const before = binding_.exchange(next, std::memory_order_acq_rel);
  if (before == &kUnbound) {
    replaced_.pop_back();
  } else {
    replaced_.back().reset(before);
  }
}

}  // namespace runnel
