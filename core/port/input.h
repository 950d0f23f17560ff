#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/port/channel.h"
#include "core/port/input_base.h"
#include "core/port/input_binding.h"
#include "core/port/lease.h"
#include "core/port/output.h"
#include "core/port/port.h"
#include "core/port/port_owner.h"
#include "core/types/type_of.h"

namespace runnel {

/// Where a module reads values of type T.
///
/// Two ways of reading, which do not disturb each other:
///   latest value   Read(), Peek(): the newest value of whatever is connected
///   queue          Take(), Drain(): each value once, in order, if the connection has a queue
///
/// Wait() sleeps until there is something to read. With Strategy::kPull, Read() and Get() first have
/// the providers of all sources make values; Peek() and the queue's functions never do.
///
/// Threads:     one thread at a time may Read, Take and Drain (a module's Update() does); Peek()
///              and LookAtValue() from any thread. Connecting and publishing go on meanwhile.
/// Progress:    lock-free: repeats only if a newer value came. Pulling takes as long as the provider.
/// Allocation:  none.
/// Several sources: the value published last counts, the same one for every reader.
template <typename T>
class Input final : public InputBase {
 public:
  Input(PortOwner* owner, std::string name, InputOptions options = {})
      : Input(owner->InputGroup(), std::move(name), std::move(options)) {}
  /// Into a certain group.
  Input(FrameworkElement& group, std::string name, InputOptions options = {})
      : InputBase({group, std::move(name)}, TypeOf<T>(), std::move(options)) {}
  ~Input() override {
    SetWaker(nullptr);
    DisconnectAll();
  }

  /// The newest value, with whether it is new since the last Read().
  [[nodiscard, gnu::always_inline]] Lease<T> Read() noexcept {
    ThreadRecord& thread = *internal::thread_record;
    // acquire: pairs with the release in Replace().
    const Binding* const binding = binding_.load(std::memory_order_acquire);
    if (thread.epoch.depth == 0 || binding->channel == nullptr) [[unlikely]] {
      Lease<T> lease = ReadTheLongWay();
      return Lease<T>(std::move(lease), internal::NoCopy{});
    }
    return Lease<T>(*binding->channel, thread.hazards, *binding->only);
  }
  /// The newest value without marking it as read. Any thread.
  [[nodiscard]] Lease<T> Peek() const noexcept {
    const EpochGuard guard;
    const Link* link = nullptr;
    Lease<T> lease = Newest(*binding_.load(std::memory_order_acquire), link);
    if (lease) lease.last_ = link->read.load_relaxed();
    return lease;
  }
  /// A copy of the newest value, or `otherwise` if there is none, without marking it as read: the
  /// quickest way to look. Any thread.
  [[nodiscard]] T Get(const T& otherwise) const noexcept requires(std::is_trivially_copyable_v<T>) {
    if constexpr (std::is_default_constructible_v<T>) {
      T value;
      if (!CopyNewest(value)) [[unlikely]]
        value = otherwise;
      return value;
    } else {
      T value = otherwise;
      (void)CopyNewest(value);
      return value;
    }
  }
  /// The same with T{} if there is none.
  [[nodiscard]] T Get() const noexcept
      requires(std::is_trivially_copyable_v<T>&& std::is_default_constructible_v<T>) {
    T value;
    if (!CopyNewest(value)) [[unlikely]]
      value = T{};
    return value;
  }
  /// The oldest value that waits in the queue; empty if none does, or if no connection has a queue.
  [[nodiscard]] Lease<T> Take() noexcept {
    return Guarded([this] {
      Lease<T> lease;
      TakeInside(lease);
      return lease;
    });
  }
  /// Takes all that wait, oldest first, and calls `use(lease)` for each; returns how many.
  template <typename Use>
  std::size_t Drain(Use&& use) {
    std::size_t count = 0;
    for (auto lease = Take(); lease; lease = Take(), ++count) use(lease);
    return count;
  }

  [[nodiscard]] std::uint64_t dropped() const noexcept override {
    const EpochGuard guard;
    return binding_.load(std::memory_order_acquire)->dropped();
  }
  /// How many queues that others have replaced still hold values, or may still get some. Any thread.
  [[nodiscard]] std::size_t replaced_queues() const noexcept {
    const EpochGuard guard;
    return binding_.load(std::memory_order_acquire)->older_queues.size();
  }
  [[nodiscard]] std::uint64_t publications() const noexcept override {
    const EpochGuard guard;
    const Binding* binding = binding_.load(std::memory_order_acquire);
    std::uint64_t sum = 0;
    for (const auto& link : binding->links) sum += link->channel->publications();
    return sum;
  }
  bool LookAtValue(const Look& look) const override {
    const Lease<T> lease = Peek();
    if (lease) look(&*lease, lease.stamp());
    return lease.has_value();
  }
  [[nodiscard]] std::unique_ptr<Port> MakeOutput(FrameworkElement& group, std::string name,
                                                 OutputOptions options) const override {
    return internal::MakeOutput<T>(group, std::move(name), std::move(options));
  }

 private:
  using Link = internal::InputLink<T>;
  using Binding = internal::InputBinding<T>;
  struct NotNoted {
    static std::uint64_t Note(std::uint64_t) noexcept { return 0; }
  };

  [[gnu::always_inline]] bool CopyNewest(T& value) const noexcept {
    ThreadRecord& thread = *internal::thread_record;
    const Binding* const binding = binding_.load(std::memory_order_acquire);
    if (thread.epoch.depth == 0 || binding->channel == nullptr) [[unlikely]]
      return CopyTheLongWay(value);
    return binding->channel->Copy(value, thread.hazards);
  }
  // The ways that are seldom taken, outside of a guard, from several sources or none, and with
  // pulling, are kept out of line, so that the usual one stays short.
  [[gnu::noinline]] Lease<T> ReadTheLongWay() noexcept {
    const EpochGuard guard;
    const Binding& binding = *binding_.load(std::memory_order_acquire);
    PullInto(binding);
    Link* link = nullptr;
    Lease<T> lease = Newest(binding, link);
    if (lease) lease.last_ = link->Note(lease.sequence());
    return lease;
  }
  [[gnu::noinline]] bool CopyTheLongWay(T& value) const noexcept {
    const EpochGuard guard;
    const Binding& binding = *binding_.load(std::memory_order_acquire);
    PullInto(binding);
    const Link* link = nullptr;
    const Lease<T> newest = Newest(binding, link);
    if (newest) value = *newest;
    return newest.has_value();
  }
  void PullInto(const Binding& binding) const noexcept {
    if (!binding.pulls) return;
    for (const auto& link : binding.links) {
      link->channel->Pull([this] { return PublicationTime(); });
    }
  }
  // Inside a guard, by which the link lives.
  template <typename LinkPointer>
  [[nodiscard]] static Lease<T> Newest(const Binding& binding, LinkPointer& link) noexcept {
    if (binding.channel == nullptr) return NewestOfSeveral(binding, link);
    link = binding.only;
    NotNoted unseen;
    return Lease<T>(*binding.channel, internal::thread_record->hazards, unseen);
  }
  template <typename LinkPointer>
  static Lease<T> NewestOfSeveral(const Binding& binding, LinkPointer& newest) noexcept {
    // Each group has an order of its own, and only their last ones are compared with each other:
    // the two comparisons mixed are no order, and the outcome would depend on whom we ask first.
    struct Last {
      internal::HeldValue<T> held;
      LinkPointer link = nullptr;
    } numbered, others;
    for (const auto& link : binding.links) {
      auto candidate = link->channel->Read();
      if (!candidate.has_value()) continue;
      Last& last = candidate.publication().order != 0 ? numbered : others;
      if (last.link != nullptr && !internal::IsLater(candidate, *link, last.held, *last.link))
        continue;
      last.held = std::move(candidate);
      last.link = link.get();
    }
    const bool other_is_later =
        others.link != nullptr &&
        (numbered.link == nullptr ||
         internal::IsLater(others.held, *others.link, numbered.held, *numbered.link));
    Last& last = other_is_later ? others : numbered;
    Lease<T> lease;
    lease.held_ = std::move(last.held);
    newest = last.link;
    return lease;
  }
  bool HasNew() const override {
    const EpochGuard guard;
    const Binding* binding = binding_.load(std::memory_order_acquire);
    // Where there is a queue, nobody may ever call Read().
    return binding->HasNext() || (!binding->queue && Peek().is_new());
  }

  void TakeInside(Lease<T>& lease) noexcept {
    const Binding* binding = binding_.load(std::memory_order_acquire);
    std::uint64_t source = 0;
    while (binding->Pop(lease.held_, source)) {
      Link* link = binding->FindLink(source);
      const std::uint64_t sequence = lease.held_.publication().sequence;
      // A value may lie in the queue twice just after connecting (see Bound()).
      if (link != nullptr && sequence <= link->taken) continue;
      lease.last_ = link != nullptr ? std::exchange(link->taken, sequence) : 0;
      return;
    }
    lease.held_ = {};  // what had been taken already
  }

  QueueSink* Bind(const std::vector<Source>& sources) override {
    const Binding* before = binding_.load(std::memory_order_relaxed);
    if (!before->links.empty()) last_links_ = before->links;
    if (sources.empty()) {
      Replace(&kUnbound);
      return nullptr;
    }
    auto next = std::make_unique<Binding>();
    next->pulls = strategy() == Strategy::kPull;
    ConnectOptions options;
    fresh_.clear();
    for (const Source& source : sources) {
      // The types are equal: connecting has checked it.
      auto* channel = static_cast<Channel<T>*>(ChannelOf(*source.output));
      next->links.push_back(KeepOrMakeLink(*before, *channel));
      if (sources.size() == 1) {
        if (!next->pulls) next->channel = channel;
        next->only = next->links.back().get();
      }
      if (source.options.queue > options.queue) options = source.options;
    }
    if (options.queue > 0) next->queue = KeepOrMakeQueue(*before, *next, options);
    KeepWaitingValues(*before, *next);
    InputQueue<T>* const queue = next->queue.get();
    Replace(next.release());
    return queue;
  }
  std::shared_ptr<Link> KeepOrMakeLink(const Binding& before, Channel<T>& channel) {
    if (const auto kept = before.LinkOf(channel)) return kept;
    fresh_.push_back(&channel);
    auto link = std::make_shared<Link>(&channel);
    // A source that comes back at once does not bring what has been read already as new.
    for (const auto& last : last_links_) {
      if (last->number == channel.number()) link->read.exchange_relaxed(last->read.load_relaxed());
    }
    return link;
  }
  auto KeepOrMakeQueue(const Binding& before, const Binding& next, const ConnectOptions& options) {
    const Writers writers = next.only != nullptr ? Writers::kOne : Writers::kSeveral;
    // A queue for one writer serves the source it was made for: another might begin before that
    // one has ended.
    if (before.queue && before.queue->room() == options.queue &&
        before.queue->on_full() == options.on_full && before.queue->writers() == writers &&
        (writers == Writers::kSeveral || before.only == next.only)) {
      return before.queue;
    }
    return std::make_shared<InputQueue<T>>(options.queue, options.on_full, writers);
  }
  static void KeepWaitingValues(const Binding& before, Binding& next) {
    next.dropped_before = before.dropped_before;
    for (const auto& older : before.older_queues) {
      // A publisher that found the queue before it was replaced may still put a value in. Its
      // leaving comes before the look at the size.
      const bool settled =
          older->left_in_epoch != 0 && ProcessEpochs().HasPassed(older->left_in_epoch);
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
      while (next.WaitingInOlder() > next.queue->room() && older->DropOldest()) {
      }
    }
    next.queue->SetWaitingBefore(next.WaitingInOlder());
  }
  // A new connection delivers the last value at once. It is read after publishers have begun to fill
  // the queue, so that none is lost; Take() leaves out one that is there twice for that reason.
  void Bound() override {
    for (auto& each : replaced_) Retire([replaced = each.release()] { delete replaced; });
    replaced_.clear();
    const Binding* binding = binding_.load(std::memory_order_relaxed);
    for (const auto& older : binding->older_queues) {
      if (older->left_in_epoch == 0) older->left_in_epoch = ProcessEpochs().Advance();
    }
    if (!binding->queue) return;
    const EpochGuard guard;
    for (Channel<T>* channel : fresh_) {
      auto held = channel->Read();
      if (held.has_value()) binding->queue->PutFirst(std::move(held), channel->number());
    }
    fresh_.clear();
  }
  void TakeOverBinding(InputBase& from) override {
    auto& other = static_cast<Input&>(from);
    Replace(other.binding_.exchange(&kUnbound, std::memory_order_acq_rel));
    replaced_.clear();  // nothing: this input was not connected
    last_links_ = std::exchange(other.last_links_, {});
  }
  // The previous binding owns the queue that publishers may still find; it goes in Bound().
  void Replace(const Binding* next) {
    replaced_.emplace_back();
    // acq_rel: release, pairs with the acquire of readers; acquire for who destroys the old one.
    const Binding* const before = binding_.exchange(next, std::memory_order_acq_rel);
    if (before->links.empty()) {  // kUnbound
      replaced_.pop_back();
    } else {
      replaced_.back().reset(before);
    }
  }

  // Of an input that is not connected: there always is one, so that readers need not ask.
  static constinit inline const Binding kUnbound{};

  std::atomic<const Binding*> binding_{&kUnbound};
  // All three under the structure lock: bindings between Bind() and Bound(), sources that have just
  // been connected, and the links of the binding before, also while nothing is connected.
  std::vector<std::unique_ptr<const Binding>> replaced_;
  std::vector<Channel<T>*> fresh_;
  std::vector<std::shared_ptr<Link>> last_links_;
};

}  // namespace runnel
