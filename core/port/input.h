#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "core/channel/channel.h"
#include "core/channel/lease.h"
#include "core/lockfree/queue_succession.h"
#include "core/port/bound_input.h"
#include "core/port/output.h"
#include "core/port/port.h"
#include "core/port/port_owner.h"
#include "core/port/stop_link.h"
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
///              and VisitLatest() from any thread. Connecting and publishing go on meanwhile.
/// Progress:    lock-free: repeats only if a newer value came. Pulling takes as long as the provider.
/// Allocation:  none.
/// Several sources: the value published last counts, the same one for every reader.
template <typename T>
class Input final : public BoundInput {
 public:
  Input(PortOwner* owner, std::string name, InputOptions options = {})
      : Input(owner->InputGroup(), std::move(name), std::move(options)) {}
  /// Into a certain group.
  Input(FrameworkElement& group, std::string name, InputOptions options = {})
      : BoundInput(group, std::move(name), TypeOf<T>(), std::move(options)) {
    internal::MakeTypedPortsKnown<T>();
    if (declares_driving()) DeclareDriving();
  }
  ~Input() override { DisconnectForEver(); }

  /// The newest value, with whether it is new since the last Read().
  [[nodiscard, gnu::always_inline]] Lease<T> Read() noexcept {
    const Binding* const binding = this->binding();
    if (!EpochGuard::HeldByThisThread() || binding->channel == nullptr) [[unlikely]] {
      Lease<T> lease = ReadOnSlowPath();
      return Lease<T>(std::move(lease), internal::NoCopy{});
    }
    return Lease<T>(Typed(*binding->channel), internal::thread_record->hazards, *binding->only);
  }
  /// The newest value without marking it as read. Any thread.
  [[nodiscard]] Lease<T> Peek() const noexcept {
    const EpochGuard guard;
    const Link* link = nullptr;
    Lease<T> lease = Newest(*binding(), link);
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
  [[nodiscard]] T Get() const noexcept requires(std::is_trivially_copyable_v<T>&& std::is_default_constructible_v<T>) {
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

  /// Whether readers find the safe value because of a stop, or because nothing has come since: who ramps or
  /// integrates begins from a standstill then. Not while a port that brakes is on its way there. Any thread.
  [[nodiscard]] bool is_stopped() const noexcept {
    return FindsStop([](const internal::StopLink& stop) { return !stop.is_braking(); });
  }
  [[nodiscard]] bool is_stop_in_force() const noexcept override {
    return FindsStop([](const internal::StopLink& stop) { return !stop.is_braking() && stop.stop().in_force(); });
  }

  bool VisitLatest(const Visitor& visit) const override {
    const Lease<T> lease = PeekForViewer();
    if (lease) visit(&*lease, lease.times());
    return lease.has_value();
  }

 private:
  using Link = internal::InputLink;
  using Binding = internal::InputBinding;
  template <typename Is>
  [[nodiscard]] bool FindsStop(const Is& is) const noexcept {
    const EpochGuard guard;
    const Binding& binding = *this->binding();
    const Link* link = nullptr;
    const Lease<T> newest = Newest(binding, link);
    return std::ranges::any_of(binding.stops, [&](const auto& stop) { return link == &stop->link() && is(*stop); });
  }
  struct NotNoted {
    static std::uint64_t Note(std::uint64_t) noexcept { return 0; }
  };

  [[gnu::always_inline]] bool CopyNewest(T& value) const noexcept {
    if (!EpochGuard::HeldByThisThread()) [[unlikely]]
      return CopyOutsideOfGuards(value);
    const Binding* const binding = this->binding();
    if (binding->channel == nullptr) [[unlikely]]
      return CopyOnSlowPath(value);
    return Typed(*binding->channel).Copy(value, internal::thread_record->hazards);
  }
  [[gnu::noinline]] Lease<T> PeekForViewer() const noexcept { return Peek(); }
  // The ways that are seldom taken, outside of a guard, from several sources or none, and with
  // pulling, are kept out of line, so that the usual one stays short.
  [[gnu::noinline]] Lease<T> ReadOnSlowPath() noexcept {
    const EpochGuard guard;
    const Binding& binding = *this->binding();
    PullInto(binding);
    const Link* link = nullptr;
    Lease<T> lease = Newest(binding, link);
    if (lease) lease.last_ = const_cast<Link*>(link)->Note(lease.sequence());
    if (lease) binding.NoteRead(&*lease, lease.times());
    return lease;
  }
  [[gnu::noinline]] bool CopyOutsideOfGuards(T& value) const noexcept {
    if (BriefEpochGuard::IsPossible()) [[likely]] {
      const BriefEpochGuard guard;
      const Binding* const binding = this->binding();
      if (binding->channel != nullptr) [[likely]]
        return Typed(*binding->channel).Copy(value, internal::thread_record->hazards);
    }
    return CopyOnSlowPath(value);
  }
  [[gnu::noinline]] bool CopyOnSlowPath(T& value) const noexcept {
    const EpochGuard guard;
    const Binding& binding = *this->binding();
    PullInto(binding);
    const Link* link = nullptr;
    const Lease<T> newest = Newest(binding, link);
    if (newest) value = *newest;
    if (newest) binding.NoteRead(&value, newest.times());
    return newest.has_value();
  }
  // The type is that of the input: connecting has checked it.
  [[nodiscard, gnu::always_inline]] static Channel<T>& Typed(ChannelBase& channel) noexcept {
    return static_cast<Channel<T>&>(channel);
  }
  // Inside a guard, by which the link lives.
  [[nodiscard]] static Lease<T> Newest(const Binding& binding, const Link*& link) noexcept {
    if (binding.channel == nullptr) return NewestOfSeveral(binding, link);
    link = binding.only;
    NotNoted unseen;
    return Lease<T>(Typed(*binding.channel), internal::thread_record->hazards, unseen);
  }
  [[gnu::noinline]] static Lease<T> NewestOfSeveral(const Binding& binding, const Link*& newest) noexcept {
    // Each group has an order of its own, and only their last ones are compared with each other:
    // the two comparisons mixed are no order, and the outcome would depend on whom we ask first.
    struct Last {
      internal::HeldValue<T> held;
      const Link* link = nullptr;
    } numbered, others;
    for (const auto& link : binding.links) {
      auto candidate = Typed(*link->channel).Read();
      if (!candidate.has_value()) continue;
      Last& last = candidate.publication().order != 0 ? numbered : others;
      if (last.link != nullptr &&
          !internal::IsLater(candidate.publication(), *link, last.held.publication(), *last.link))
        continue;
      last.held = std::move(candidate);
      last.link = link.get();
    }
    const bool other_is_later =
        others.link != nullptr &&
        (numbered.link == nullptr ||
         internal::IsLater(others.held.publication(), *others.link, numbered.held.publication(), *numbered.link));
    Last& last = other_is_later ? others : numbered;
    Lease<T> lease;
    lease.held_ = std::move(last.held);
    newest = last.link;
    if (!binding.stops.empty()) LookForStop(binding, lease, newest);
    return lease;
  }
  [[gnu::noinline]] static void LookForStop(const Binding& binding, Lease<T>& lease, const Link*& newest) noexcept {
    std::optional<ValueTimes> times;
    if (lease) times = lease.times();
    internal::StopLink* const stop = binding.StopBefore(times);
    if (stop == nullptr) return;
    lease.held_ = Typed(stop->channel()).Read();
    newest = &stop->link();
    if constexpr (Channel<T>::kGivesCopies) {
      if (!stop->brakes()) return;
      T value = lease.held_.value();
      Publication publication = lease.held_.publication();
      stop->Brake(&value, publication);
      lease.held_ = internal::HeldValue<T>(value, publication);
    }
  }
  bool HasNew() const override {
    const EpochGuard guard;
    const Binding* const binding = this->binding();
    // Where there is a queue, nobody may ever call Read().
    return binding->HasNext() || (binding->queue ? binding->StopToTake() != nullptr : PeekForViewer().is_new());
  }

  using Queued = internal::Queued<T>;
  [[nodiscard, gnu::always_inline]] static bool Pop(const Binding& binding, internal::HeldValue<T>& held,
                                                    std::uint64_t& source) noexcept {
    if (!binding.older_queues.empty()) [[unlikely]]
      return PopFromAll(binding, held, source);
    return binding.queue && internal::DistributionOf<T>::QueueOf(*binding.queue).Pop(TakeInto(held, source));
  }
  [[nodiscard, gnu::always_inline]] static auto TakeInto(internal::HeldValue<T>& held, std::uint64_t& source) noexcept {
    return [&](Queued & queued) __attribute__((always_inline)) {
      source = queued.source;
      internal::MoveTo<T>(held, queued);
    };
  }
  [[gnu::noinline]] static bool PopFromAll(const Binding& binding, internal::HeldValue<T>& held,
                                           std::uint64_t& source) noexcept {
    const bool popped = PopInOrder(binding.all_queues, [&](InputQueueBase& each, const auto& may) {
      return internal::DistributionOf<T>::QueueOf(each).PopIf(may, TakeInto(held, source));
    });
    if (binding.queue) binding.queue->SetWaitingBefore(binding.WaitingInOlder());
    return popped;
  }
  void TakeInside(Lease<T>& lease) noexcept {
    const Binding* const binding = this->binding();
    if (!binding->stops.empty() && TakeOfStop(*binding, lease)) return;
    std::uint64_t source = 0;
    while (Pop(*binding, lease.held_, source)) {
      Link* link = binding->FindLink(source);
      const std::uint64_t sequence = lease.held_.publication().sequence;
      // A value may lie in the queue twice just after connecting (see Bound()).
      if (link != nullptr && sequence <= link->taken) continue;
      lease.last_ = link != nullptr ? std::exchange(link->taken, sequence) : 0;
      if (!binding->stops.empty() && binding->StopBefore(lease.times()) != nullptr) continue;
      binding->NoteRead(&*lease, lease.times());
      return;
    }
    lease.held_ = {};  // what had been taken already
  }
  // The safe value, once for each press, where there is a queue.
  [[gnu::noinline]] static bool TakeOfStop(const Binding& binding, Lease<T>& lease) noexcept {
    internal::StopLink* const stop = binding.queue ? binding.StopToTake() : nullptr;
    if (stop == nullptr) return false;
    lease.held_ = Typed(stop->channel()).Read();
    lease.last_ = std::exchange(stop->link().taken, lease.sequence());
    return true;
  }

  [[nodiscard]] std::unique_ptr<InputQueueBase> MakeQueue(std::size_t capacity, OnFull on_full,
                                                          Writers writers) const override {
    return internal::DistributionOf<T>::MakeQueue(capacity, on_full, writers);
  }
};

}  // namespace runnel
