#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/port/arrival_event.h"
#include "core/port/channel.h"
#include "core/port/input_queue.h"
#include "core/port/lease.h"
#include "core/port/port.h"
#include "core/port/port_owner.h"
#include "core/types/type_of.h"

namespace runnel {

/// The part of an input that does not depend on the type of its values.
class InputBase : public Port {
 public:
  [[nodiscard]] bool is_required() const noexcept override { return options_.required; }
  [[nodiscard]] bool is_trigger() const noexcept { return options_.trigger; }

  ~InputBase() override;

  /// Has `waker` told of new data; nullptr for nobody. Locks.
  void SetWaker(Waker* waker);

  /// Sleeps until there is a value that the last Read() has not returned or, if a connection has a
  /// queue, until there is something to Take(); false if there is none when `timeout` has passed (at
  /// once if it is not positive), by the machine's clock. A new connection wakes as a publication
  /// does. In rare cases there may be nothing to Take() after all: a full queue has just dropped it.
  ///
  /// Publishers call the system only if the reader sleeps; for inputs that never wait, they do
  /// nothing at all. Does not pull: it waits for what others publish.
  /// Threads:     the one that reads. It sleeps, so never in a cycle. Nobody may be waiting when the
  ///              input is deleted.
  /// Allocation:  by the first call, which locks too; see InputOptions::waits.
  /// Errors:      throws ProgrammingError in a cycle or inside an EpochGuard, where a thread that
  ///              sleeps would keep all others from deleting anything.
  [[nodiscard]] bool Wait(Duration timeout);

  /// Chooses whether reading pulls (Output::SetProvider()) or takes what has been published. Any
  /// thread, at any time, but not from a cycle: locks and allocates.
  void SetStrategy(Strategy strategy);
  [[nodiscard]] Strategy strategy() const noexcept {
    // relaxed: for viewers; readers are told by a new binding.
    return strategy_.load(std::memory_order_relaxed);
  }
  /// Values lost because the queue was full, since the queue was made.
  [[nodiscard]] virtual std::uint64_t dropped() const noexcept = 0;

 protected:
  InputBase(const Placement& placement, const TypeInfo& type, InputOptions options);

  void Rebind(const std::vector<Source>& sources) final;
  /// Typed inputs: bind to the channels of `sources`; the queue that publishers shall fill, or
  /// nullptr.
  virtual QueueSink* Bind(const std::vector<Source>& sources) = 0;
  /// Typed inputs: Bind() has taken effect everywhere; put first values into a new queue.
  virtual void Bound() = 0;
  /// Typed inputs: what Wait() waits for. By the reader.
  [[nodiscard]] virtual bool HasNew() const = 0;

 private:
  ArrivalEvent& PrepareToWait();
  static void UpdateChannel(Port& output);

  const InputOptions options_;
  Waker* waker_ = nullptr;
  QueueSink* sink_ = nullptr;
  std::unique_ptr<ArrivalEvent> arrival_;  // once the reader waits; made by it, under the lock
  std::atomic<Strategy> strategy_;
  std::vector<Source> sources_;
};

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
/// Progress:    lock-free: reading repeats only if a newer value came meanwhile. Pulling takes as
///              long as the provider.
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
  [[nodiscard]] Lease<T> Read() noexcept {
    return EpochGuard::HeldByThisThread() ? ReadInside() : ReadGuarded();
  }
  /// The newest value without marking it as read. Any thread.
  [[nodiscard]] Lease<T> Peek() const noexcept {
    const EpochGuard guard;
    const Link* link = nullptr;
    Lease<T> lease = Newest(link);
    if (lease) lease.last_ = link->read.load_relaxed();
    return lease;
  }
  /// A copy of the newest value, or `otherwise` if there is none, without marking it as read: the
  /// quickest way to look. Any thread.
  [[nodiscard]] T Get(const T& otherwise) const noexcept requires(std::is_trivially_copyable_v<T>) {
    T value;
    if (!CopyNewest(value)) [[unlikely]]
      value = otherwise;
    return value;
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
    const Binding* binding = binding_.load(std::memory_order_acquire);
    return binding != nullptr && binding->queue ? binding->queue->dropped() : 0;
  }
  [[nodiscard]] std::uint64_t publications() const noexcept override {
    const EpochGuard guard;
    const Binding* binding = binding_.load(std::memory_order_acquire);
    std::uint64_t sum = 0;
    if (binding != nullptr) {
      for (const auto& link : binding->links) sum += link->channel->publications();
    }
    return sum;
  }
  bool LookAtValue(const Look& look) const override {
    const Lease<T> lease = Peek();
    if (lease) look(&*lease, lease.stamp());
    return lease.has_value();
  }

 private:
  // The reader's own notes, relaxed atomics only so that viewers and connecting may look at them.
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
  // What the reader keeps about one source; lives as long as the connection.
  struct Link {
    explicit Link(Channel<T>* source) : channel(source), number(source->number()) {}

    // Marks a value as read; returns which was before.
    [[gnu::always_inline]] std::uint64_t Note(std::uint64_t sequence) noexcept {
      return read.exchange_relaxed(sequence);
    }

    Channel<T>* const channel;
    const std::uint64_t number;  // of the channel, also when that is gone
    RelaxedNumber read;          // sequence of the value read last
    std::uint64_t taken = 0;     // sequence of the value taken last; the reader's own
  };
  struct NotNoted {
    static std::uint64_t Note(std::uint64_t) noexcept { return 0; }
  };
  // What reading needs; never changed but for the reader's own notes, replaced as a whole.
  struct Binding {
    // If there is one source and no pulling, the short way to it; else nullptr.
    Channel<T>* channel = nullptr;
    Link* only = nullptr;  // if there is one source
    bool pulls = false;
    std::vector<std::shared_ptr<Link>> links;  // shared by the binding before and after a change
    std::shared_ptr<InputQueue<T>> queue;      // likewise
    // Queues that a longer one has replaced: what waits in them comes first.
    std::vector<std::shared_ptr<InputQueue<T>>> older_queues;

    [[nodiscard]] bool Pop(internal::HeldValue<T>& held, std::uint64_t& source) const noexcept {
      for (const auto& older : older_queues) {
        if (older->Pop(held, source)) return true;
      }
      return queue && queue->Pop(held, source);
    }
    [[nodiscard]] bool HasNext() const noexcept {
      for (const auto& older : older_queues) {
        if (older->HasNext()) return true;
      }
      return queue && queue->HasNext();
    }
    [[nodiscard]] Link* FindLink(std::uint64_t number) const noexcept {
      for (const auto& link : links) {
        if (link->number == number) return link.get();
      }
      return nullptr;
    }
  };
  bool CopyNewest(T& value) const noexcept {
    return EpochGuard::HeldByThisThread() ? CopyInside(value) : CopyGuarded(value);
  }
  [[gnu::noinline]] bool CopyGuarded(T& value) const noexcept {
    const EpochGuard guard;
    return CopyInside(value);
  }
  [[gnu::always_inline]] bool CopyInside(T& value) const noexcept {
    const Binding* const binding = binding_.load(std::memory_order_acquire);
    if (binding == nullptr) return false;
    if (binding->channel != nullptr) [[likely]]
      return binding->channel->Copy(value);
    return CopySeveral(*binding, value);
  }
  [[gnu::noinline]] bool CopySeveral(const Binding& binding, T& value) const noexcept {
    PullInto(binding);
    const Link* link = nullptr;
    const Lease<T> newest = NewestOfSeveral(binding, link);
    if (newest) value = *newest;
    return newest.has_value();
  }
  // The ways that are seldom taken are kept out of line, so that the usual one stays short.
  [[gnu::noinline]] Lease<T> ReadGuarded() noexcept {
    const EpochGuard guard;
    return ReadInside();
  }
  [[gnu::always_inline]] Lease<T> ReadInside() noexcept {
    // acquire: pairs with the release in Replace().
    const Binding* const binding = binding_.load(std::memory_order_acquire);
    if (binding == nullptr) return {};
    if (binding->channel == nullptr) [[unlikely]]
      return ReadSeveral(*binding);
    return Lease<T>(*binding->channel, *binding->only);
  }
  [[gnu::noinline]] Lease<T> ReadSeveral(const Binding& binding) noexcept {
    PullInto(binding);
    Link* link = nullptr;
    Lease<T> lease = NewestOfSeveral(binding, link);
    if (lease) lease.last_ = link->Note(lease.sequence());
    return lease;
  }
  void PullInto(const Binding& binding) const noexcept {
    if (!binding.pulls) return;
    for (const auto& link : binding.links) {
      link->channel->Pull([this] { return PublicationTime(); });
    }
  }
  // Inside a guard, by which the link lives. `link` is set if there is a value.
  [[nodiscard]] Lease<T> Newest(const Link*& link) const noexcept {
    const Binding* const binding = binding_.load(std::memory_order_acquire);
    if (binding == nullptr) return {};
    if (binding->channel == nullptr) return NewestOfSeveral(*binding, link);
    link = binding->only;
    NotNoted unseen;
    return Lease<T>(*binding->channel, unseen);
  }
  template <typename LinkPointer>
  static Lease<T> NewestOfSeveral(const Binding& binding, LinkPointer& newest) noexcept {
    Lease<T> lease;
    for (const auto& link : binding.links) {
      auto candidate = link->channel->Read();
      if (!candidate.has_value()) continue;
      if (newest != nullptr && !IsLater(candidate, *link, lease.held_, *newest)) continue;
      lease.held_ = std::move(candidate);
      newest = link.get();
    }
    return lease;
  }
  // By the common order of sources that share an input, which every reader sees alike. Values from
  // before the sharing have none; their time and then the age of their source decide.
  static bool IsLater(const internal::HeldValue<T>& a, const Link& from_a,
                      const internal::HeldValue<T>& b, const Link& from_b) noexcept {
    const Publication& p = a.publication();
    const Publication& q = b.publication();
    if (p.order != 0 && q.order != 0) return p.order > q.order;
    if (p.stamp != q.stamp) return p.stamp > q.stamp;
    return from_a.number > from_b.number;
  }

  bool HasNew() const override {
    const EpochGuard guard;
    const Binding* binding = binding_.load(std::memory_order_acquire);
    if (binding == nullptr) return false;
    // Where there is a queue, nobody may ever call Read().
    return binding->HasNext() || (!binding->queue && Peek().is_new());
  }

  void TakeInside(Lease<T>& lease) noexcept {
    const Binding* binding = binding_.load(std::memory_order_acquire);
    if (binding == nullptr) return;
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
    if (before != nullptr) last_links_ = before->links;
    if (sources.empty()) {
      Replace(nullptr);
      return nullptr;
    }
    auto next = std::make_unique<Binding>();
    next->pulls = strategy() == Strategy::kPull;
    ConnectOptions options;
    fresh_.clear();
    for (const Source& source : sources) {
      // The types are equal: connecting has checked it.
      auto* channel = static_cast<Channel<T>*>(ChannelOf(*source.output));
      next->links.push_back(KeepOrMakeLink(before, *channel));
      if (sources.size() == 1) {
        if (!next->pulls) next->channel = channel;
        next->only = next->links.back().get();
      }
      if (source.options.queue > options.queue) options = source.options;
    }
    if (options.queue > 0) next->queue = KeepOrMakeQueue(before, *next, options);
    KeepWaitingValues(before, *next);
    InputQueue<T>* const queue = next->queue.get();
    Replace(next.release());
    return queue;
  }
  std::shared_ptr<Link> KeepOrMakeLink(const Binding* before, Channel<T>& channel) {
    if (before != nullptr) {
      for (const auto& link : before->links) {
        if (link->channel == &channel) return link;
      }
    }
    fresh_.push_back(&channel);
    auto link = std::make_shared<Link>(&channel);
    // A source that comes back at once does not bring what has been read already as new.
    for (const auto& last : last_links_) {
      if (last->number == channel.number()) link->read.exchange_relaxed(last->read.load_relaxed());
    }
    return link;
  }
  std::shared_ptr<InputQueue<T>> KeepOrMakeQueue(const Binding* before, const Binding& next,
                                                 const ConnectOptions& options) {
    const Writers writers = next.only != nullptr ? Writers::kOne : Writers::kSeveral;
    // A queue for one writer serves the source it was made for: another might begin before that
    // one has ended.
    if (before != nullptr && before->queue && before->queue->room() == options.queue &&
        before->queue->on_full() == options.on_full && before->queue->writers() == writers &&
        (writers == Writers::kSeveral || before->only == next.only)) {
      return before->queue;
    }
    return std::make_shared<InputQueue<T>>(options.queue, options.on_full, writers);
  }
  static void KeepWaitingValues(const Binding* before, Binding& next) {
    if (before == nullptr) return;
    for (const auto& older : before->older_queues) {
      if (older->size() > 0) next.older_queues.push_back(older);
    }
    if (before->queue && before->queue != next.queue) next.older_queues.push_back(before->queue);
  }
  // A new connection delivers the last value at once. It is read after publishers have begun to
  // fill the queue, so that none is lost; one that is there twice for that reason, Take() leaves
  // out.
  void Bound() override {
    for (auto& each : replaced_) Retire([replaced = each.release()] { delete replaced; });
    replaced_.clear();
    const Binding* binding = binding_.load(std::memory_order_relaxed);
    if (binding == nullptr || !binding->queue) return;
    const EpochGuard guard;
    for (Channel<T>* channel : fresh_) {
      auto held = channel->Read();
      if (held.has_value()) binding->queue->PutFirst(std::move(held), channel->number());
    }
    fresh_.clear();
  }
  // The previous binding owns the queue that publishers may still find; it goes in Bound().
  void Replace(const Binding* next) {
    replaced_.emplace_back();
    // acq_rel: release, pairs with the acquire of readers; acquire for who destroys the old one.
    replaced_.back().reset(binding_.exchange(next, std::memory_order_acq_rel));
  }

  std::atomic<const Binding*> binding_{nullptr};
  std::vector<std::unique_ptr<const Binding>>
      replaced_;                    // between Bind() and Bound(); structure lock
  std::vector<Channel<T>*> fresh_;  // sources that have just been connected; structure lock
  // Of the binding before, and kept while nothing is connected; structure lock.
  std::vector<std::shared_ptr<Link>> last_links_;
};

}  // namespace runnel
