#pragma once

#include <concepts>
#include <memory>
#include <string>
#include <utility>

#include "core/channel/channel.h"
#include "core/lockfree/latest_value.h"
#include "core/lockfree/thread_epoch.h"
#include "plugins/parameters/parameter_base.h"

namespace runnel {

/// Whether parameters of T are copied when they are read; others are held.
template <typename T>
inline constexpr bool kIsCopiedParameter = std::is_trivially_copyable_v<T> && sizeof(T) <= 256;

/// Read access to the value of a parameter that is held and not copied: a text, a list. The value does not change
/// while it is held. Threads: one at a time.
template <typename T>
class ParameterValue {
 public:
  [[nodiscard]] const T& operator*() const noexcept { return held_.value(); }
  [[nodiscard]] const T* operator->() const noexcept { return &held_.value(); }

 private:
  template <typename>
  friend class Parameter;
  explicit ParameterValue(internal::HeldValue<T>&& held) noexcept : held_(std::move(held)) {}

  internal::HeldValue<T> held_;
};

/// A value that can be changed while the module runs.
///
///     Parameter<double> stop_distance{this, "stop_distance",
///                                     {.default_value = 0.3, .bounds = {0.05, 5.0}, .unit = "m",
///                                      .description = "obstacles nearer than this stop the
///                                      robot"}};
///     Parameter<std::string> greeting{this, "greeting", {.default_value = "hello"}};
///     …
///     if (nearest < stop_distance.Get()) Say(*greeting.Get());
///
/// Threads:     Get() from any thread, at any time; HasChanged() by the module's; setting under the
///              structure lock, which SetFrom(), SetFromText() and Set() take.
/// Progress:    Get() is lock-free and sees a whole value, the old or the new.
/// Allocation:  Get() and HasChanged() none.
template <typename T>
class Parameter final : public ParameterBase {
 public:
  /// Errors: throws ElementError if the default value is out of the bounds.
  Parameter(FrameworkElement* module, std::string name, const ParameterOptions<T>& options = {})
      : ParameterBase(module, std::move(name), internal::DescriptionOf(options, false), &options.default_value) {
    Publish(options.default_value);
  }

  /// A copy of numbers and small structures.
  [[nodiscard]] T Get() const noexcept requires kIsCopiedParameter<T> {
    T value{};
    value_.Read(value);
    return value;
  }
  /// Other types are held: `*name.Get()`.
  [[nodiscard]] ParameterValue<T> Get() const noexcept requires(!kIsCopiedParameter<T>) {
    const EpochGuard guard;
    return ParameterValue<T>(value_->Read());
  }
  /// Whether it has got another value since the last call; true the first time. In OnParametersChanged() or in a
  /// cycle: what Get() gives afterwards is at least as new. A value that equals the one before is no change, if
  /// the type can be compared.
  [[nodiscard]] bool HasChanged() noexcept {
    const std::uint64_t published = Publications();
    return std::exchange(seen_, published) != published;
  }
  /// Errors: out of bounds.
  Result<void> Set(const T& value) { return Put({std::make_shared<const T>(value)}); }

  [[nodiscard]] std::shared_ptr<void> Value() const override {
    if constexpr (kIsCopiedParameter<T>) {
      return std::make_shared<T>(Get());
    } else {
      return std::make_shared<T>(*Get());
    }
  }

 private:
  struct CloseChannel {
    void operator()(Channel<T>* channel) const { ChannelBase::DeleteLater(channel); }
  };
  using Storage = std::conditional_t<kIsCopiedParameter<T>, LatestValue<T>, std::unique_ptr<Channel<T>, CloseChannel>>;

  bool Assign(const void* value) override {
    const T& wanted = *static_cast<const T*>(value);
    if constexpr (std::equality_comparable<T>) {
      if constexpr (kIsCopiedParameter<T>) {
        if (Get() == wanted) return false;
      } else {
        if (*Get() == wanted) return false;
      }
    }
    Publish(wanted);
    return true;
  }
  void Publish(const T& value) {
    if constexpr (kIsCopiedParameter<T>) {
      value_.Publish(value, 0);
    } else {
      if (!value_) value_.reset(new Channel<T>({.buffers = 2}, {}));
      auto loan = value_->MakeLoan();
      *loan = value;
      value_->Publish(std::move(loan), {});
    }
  }
  [[nodiscard]] std::uint64_t Publications() const noexcept {
    if constexpr (kIsCopiedParameter<T>) {
      return value_.sequence();
    } else {
      return value_->publications();
    }
  }

  Storage value_;
  std::uint64_t seen_ = 0;  // the reader's own
};

/// A value of any describable type that is settled once the module is ready: a file name, the
/// number of rays, a list of points.
///
/// Threads:  Get() from Prepare() on, from any thread; it never changes afterwards.
template <typename T>
class StaticParameter final : public ParameterBase {
 public:
  /// Errors: throws ElementError if the default value is out of the bounds.
  StaticParameter(FrameworkElement* module, std::string name, const ParameterOptions<T>& options = {})
      : ParameterBase(module, std::move(name), internal::DescriptionOf(options, true), &options.default_value),
        value_(options.default_value) {}

  [[nodiscard]] const T& Get() const noexcept { return value_; }
  /// Errors: out of bounds; the module is ready, or its ports have been made by the value before.
  Result<void> Set(const T& value) { return Put({std::make_shared<const T>(value)}); }

  [[nodiscard]] std::shared_ptr<void> Value() const override { return std::make_shared<T>(value_); }

 private:
  bool Assign(const void* value) override {
    value_ = *static_cast<const T*>(value);
    return true;
  }

  T value_;
};

}  // namespace runnel
