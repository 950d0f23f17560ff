#pragma once

#include <functional>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>

#include "core/port/channel.h"
#include "core/port/loan.h"
#include "core/port/output_base.h"
#include "core/port/port_owner.h"
#include "core/types/type_of.h"

namespace runnel {

namespace internal {
/// Port::MakeOutput() of inputs and outputs.
template <typename T>
std::unique_ptr<Port> MakeOutput(FrameworkElement& group, std::string&& name,
                                 OutputOptions&& options);
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
/// Time:        values bear the time of the cycle; outside of a cycle, that of the runtime's clock.
template <typename T>
class Output final : public OutputBase {
 public:
  using Factory = typename BufferPool<T>::Factory;

  /// `factory` makes the buffers' first values, for types without default constructor.
  Output(PortOwner* owner, std::string name, OutputOptions options = {}, Factory factory = {})
      : Output(owner->OutputGroup(), std::move(name), std::move(options), std::move(factory)) {}
  /// Into a certain group.
  Output(FrameworkElement& group, std::string name, OutputOptions options = {},
         Factory factory = {})
      : OutputBase(
            group, std::move(name), TypeOf<T>(), std::move(options),
            std::make_unique<Channel<T>>(options.pool, std::move(factory), options.pullable)) {}

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
    return own().Publish(std::move(loan), PublicationTime());
  }
  /// Copies or moves the value into a buffer (inlined values: straight into the slot).
  PublishStatus Publish(const T& value) requires(kIsInlined<T> || std::is_copy_assignable_v<T>) {
    if constexpr (kIsInlined<T>) {
      return own().PublishValue(value, PublicationTime());
    } else {
      auto loan = Loan();
      if (!loan) return PublishStatus::kNoBuffer;
      *loan = value;
      return Publish(std::move(loan));
    }
  }
  PublishStatus Publish(T&& value) requires(!kIsInlined<T>) {
    auto loan = Loan();
    if (!loan) return PublishStatus::kNoBuffer;
    *loan = std::move(value);
    return Publish(std::move(loan));
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
    SetPullProvider([provider = std::move(provider)](void* value) {
      return provider(*static_cast<T*>(value));
    });
  }
  /// How often the pool had to allocate since the start.
  [[nodiscard]] std::uint64_t growths() const noexcept { return own().growths(); }

  bool VisitLatest(const Visitor& visit) const override {
    const auto held = own().ReadForViewer();
    if (!held.has_value()) return false;
    visit(&held.value(), Time(Duration(held.publication().timestamp)));
    return true;
  }
  Result<PublishStatus> PublishFilled(const Fill& fill) override {
    if constexpr (Channel<T>::kCanPull) {
      auto loan = Loan();
      return FillAndPublish(loan ? &*loan : nullptr, fill, &loan, [](Port& self, void* filled) {
        return static_cast<Output&>(self).Publish(
            std::move(*static_cast<runnel::Loan<T>*>(filled)));
      });
    } else {
      return CannotPublish("only its module can make values of its type");
    }
  }
  [[nodiscard]] std::unique_ptr<Port> MakeOutput(FrameworkElement& group, std::string name,
                                                 OutputOptions options) const override {
    return internal::MakeOutput<T>(group, std::move(name), std::move(options));
  }

 private:
  // The channel that the constructor has made, or another output's of this class.
  [[nodiscard, gnu::always_inline]] Channel<T>& own() const noexcept {
    return static_cast<Channel<T>&>(own_channel());
  }
};

template <typename T>
[[gnu::noinline]] std::unique_ptr<Port> internal::MakeOutput(FrameworkElement& group,
                                                             std::string&& name,
                                                             OutputOptions&& options) {
  if constexpr (std::is_default_constructible_v<T>) {
    return std::make_unique<Output<T>>(group, std::move(name), std::move(options));
  } else {
    return nullptr;
  }
}

}  // namespace runnel
