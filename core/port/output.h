#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

#include "core/channel/channel.h"
#include "core/channel/loan.h"
#include "core/port/output_base.h"
#include "core/port/port_owner.h"
#include "core/types/type_of.h"

namespace runnel {

namespace internal {
/// typed_ports.h
template <typename T>
void MakeTypedPortsKnown();
}  // namespace internal

/// Where a module publishes values of type T.
///
///     Output<RangeScan> scan{this, "scan"};
///     …
///     auto loan = scan.Loan();        // a free buffer, never a copy
///     Fill(*loan);
///     scan.Publish(std::move(loan));
///
/// Ownership:   owns the channel with the buffers; leases that are still out keep their buffers.
/// Threads:     one thread at a time may Loan and Publish (a module's Update() does); connecting
///              and reading go on meanwhile.
/// Progress:    Publish() is lock-free, and does not visit inputs that read only the latest value.
/// Allocation:  none, unless a growing pool has run out of buffers (growths() counts it).
/// Time:        values bear the time of the cycle; outside of a cycle, that of the runtime's clock; and
///              beside it that of their measurement, if Publish() is told. Outside of a cycle what is published with
///              a time of measurement bears the clock's coarse time (Clock::CoarseNow()), which is cheaper than the
///              rest of publishing together; OwnCycle gives it an exact one.
template <typename T>
class Output final : public OutputBase {
 public:
  using Factory = typename BufferPool<T>::Factory;

  /// `factory` makes the buffers' first values, for types without default constructor.
  Output(PortOwner* owner, std::string name, OutputOptions options = {}, Factory factory = {})
      : Output(owner->OutputGroup(), std::move(name), std::move(options), std::move(factory)) {}
  /// Into a certain group.
  Output(FrameworkElement& group, std::string name, OutputOptions options = {}, Factory factory = {})
      : OutputBase(group, std::move(name), TypeOf<T>(), std::move(options),
                   std::make_unique<Channel<T>>(options.pool, std::move(factory), options.pullable)) {
    internal::MakeTypedPortsKnown<T>();
  }

  /// A buffer to fill; empty if a pool of fixed size is exhausted.
  [[nodiscard, gnu::always_inline]] runnel::Loan<T> Loan() { return own().MakeLoan(); }

  /// Calls `fill` for each buffer that the pool has now, so that values keep their memory from the
  /// start (a list's capacity). For Prepare(); allocates. None of the buffers may be out.
  template <typename Fill>
  void PrepareBuffers(Fill&& fill) requires(!kIsInlined<T>) {
    std::vector<runnel::Loan<T>> loans;
    for (std::size_t i = own().buffers(); i > 0; --i) loans.push_back(Loan());
    for (auto& loan : loans) fill(*loan);
  }

  /// Errors: the loan of another output (but for inlined values) throws ProgrammingError.
  [[gnu::always_inline]] PublishStatus Publish(runnel::Loan<T>&& loan) {
    return own().Publish(std::move(loan), PublicationTimes());
  }
  /// Copies or moves the value into a buffer (inlined values: straight into the slot).
  PublishStatus Publish(const T& value) requires(kIsInlined<T> || std::is_copy_assignable_v<T>) {
    return PublishAt(value, PublicationTimes());
  }
  PublishStatus Publish(T&& value) requires(!kIsInlined<T>) { return PublishAt(std::move(value), PublicationTimes()); }
  /// The same with the time at which the value was measured, on the application's clock: what readers
  /// see as timestamp(). Values need not come in the order of their timestamps. A time that is still to come counts as
  /// now, since such a value would not grow old (Port::stamps_ahead()).
  [[gnu::always_inline]] PublishStatus Publish(runnel::Loan<T>&& loan, Time timestamp) {
    return own().Publish(std::move(loan), PublicationTimes(timestamp));
  }
  PublishStatus Publish(const T& value, Time timestamp) requires(kIsInlined<T> || std::is_copy_assignable_v<T>) {
    return PublishAt(value, PublicationTimes(timestamp));
  }
  PublishStatus Publish(T&& value, Time timestamp) requires(!kIsInlined<T>) {
    return PublishAt(std::move(value), PublicationTimes(timestamp));
  }

  /// Publishes what has come by an input, from whatever output: of types that travel in buffers the very value,
  /// without a copy, for a switch, a gate, a merge. It keeps its timestamp; when it was published, its
  /// number and its order are those of this output, and readers of the other see what they have seen.
  /// The value stays in the buffer of the output that first published it, which is held as long as this
  /// output's readers hold it, or it is the newest here; and a while longer, until this output publishes
  /// again or is told to ReleaseUnused(). A buffer of the own pool is taken to refer to it.
  /// Threads:   as Publish(). Progress: wait-free to readers of the newest value, as Loan().
  /// Errors:    an empty lease throws ProgrammingError; kNoBuffer if the own pool is of fixed size and
  ///            exhausted.
  PublishStatus Forward(const Lease<T>& lease) { return own().Forward(lease, {lease.timestamp(), PublicationTime()}); }
  /// Publishes a value that lies in the user's own memory, as it is: `owner` gets it back
  /// (ValueOwner::TakeBack()) when nobody holds it any more. Who finds that out is this output, when it is given
  /// more to publish in place or to forward, when it looks for a free buffer, or in ReleaseUnused(); after
  /// its end, whoever changes the structure. Until then the value must not change, and its owner is kept.
  /// Threads:   as Publish(). Allocation: none, but for a growing pool.
  /// Errors:    if it returns kNoBuffer or kBusy nothing is published and the value stays with the caller.
  PublishStatus PublishInPlace(const T& value, std::shared_ptr<ValueOwner<T>> owner) {
    return PublishInPlaceAt(value, std::move(owner), PublicationTimes());
  }
  PublishStatus PublishInPlace(const T& value, std::shared_ptr<ValueOwner<T>> owner, Time timestamp) {
    return PublishInPlaceAt(value, std::move(owner), PublicationTimes(timestamp));
  }
  /// Gives back what has been forwarded or published in place and nobody holds any more. By the publisher.
  void ReleaseUnused() noexcept {
    if constexpr (!kIsInlined<T>) own().ReleaseUnused();
  }

  /// Fills `value` (T{}, or what an earlier use left in a buffer) and returns true, or returns
  /// false if there is nothing new.
  using Provider = std::function<bool(T& value)>;
  /// Lets inputs pull: when one with Strategy::kPull is read, its thread calls `provider` and
  /// publishes what it has made, for all inputs alike; then it reads. An empty provider ends that.
  ///
  /// One at a time pulls or publishes: a reader that comes meanwhile reads what is there, and
  /// Publish() returns kBusy and leaves a loan with its owner.
  /// Threads:   any, at any time, but not from a cycle: it allocates, and waits until the provider
  ///            before is not running any more, so that what that refers to may go. A provider is
  ///            run by one thread at a time, inside the reader's cycle: it shall keep a cycle's
  ///            rules, must not connect or delete ports, and must not replace itself. One that
  ///            throws, or for which a fixed pool has no buffer, has made nothing: the reader finds
  ///            the value of before, and pull_failures() counts it.
  /// Errors:    throws ProgrammingError if the output was not made with OutputOptions::pullable.
  void SetProvider(Provider provider) requires(Channel<T>::kCanPull) {
    if (!provider) return SetPullProvider({});
    SetPullProvider([provider = std::move(provider)](void* value, std::optional<Time>&) {
      return provider(*static_cast<T*>(value));
    });
  }
  /// The same for a `provider(T& value, std::optional<Time>& timestamp)` that also says when the value
  /// was measured.
  template <typename TimedProvider>
  requires std::is_invocable_r_v < bool, TimedProvider&, T&, std::optional<Time>
  & > void SetProvider(TimedProvider provider) requires(Channel<T>::kCanPull) {
    SetPullProvider([provider = std::move(provider)](void* value, std::optional<Time>& timestamp) mutable {
      return provider(*static_cast<T*>(value), timestamp);
    });
  }
  /// How often the pool had to allocate since the start.
  [[nodiscard]] std::uint64_t growths() const noexcept { return own().growths(); }

 private:
  template <typename Value>
  [[gnu::always_inline]] PublishStatus PublishAt(Value&& value, ValueTimes times) {
    if constexpr (kIsInlined<T>) {
      return own().PublishValue(value, times);
    } else {
      auto loan = Loan();
      if (!loan) return PublishStatus::kNoBuffer;
      *loan = std::forward<Value>(value);
      return own().Publish(std::move(loan), times);
    }
  }
  PublishStatus PublishInPlaceAt(const T& value, std::shared_ptr<ValueOwner<T>>&& owner, ValueTimes times) {
    static_assert(!kLiesInQueuesAsCopy<T>,
                  "values of this type are copied on their way, so nobody would hold this one: publish it, "
                  "and it is free at once; if it only refers to memory of yours, set kIsInlined and "
                  "kIsCopiedInQueues to false for its type");
    return own().PublishInPlace(value, std::move(owner), times);
  }
  // The channel that the constructor has made, or another output's of this class.
  [[nodiscard, gnu::always_inline]] Channel<T>& own() const noexcept { return static_cast<Channel<T>&>(own_channel()); }
};

}  // namespace runnel

#include "core/port/typed_ports.h"  // which needs all of the above
