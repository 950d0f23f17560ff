#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <utility>

#include "plugins/genom_modules/component_module.h"
#include "plugins/parameters/parameter.h"

namespace runnel::genom_modules {

/// A parameter that its module sets, too: what it says is what the module has made of it.
///
/// Threads: Take() and Follow() by the module's cycle, and never blocked; the rest as of parameters.
template <typename T>
class FollowingParameter final : public ParameterBase {
 public:
  FollowingParameter(FrameworkElement* module, std::string name, const ParameterOptions<T>& options)
      : ParameterBase(module, std::move(name), internal::DescriptionOf(options, false), &options.default_value),
        value_(options.default_value) {}

  [[nodiscard]] std::shared_ptr<void> Value() const override {
    const Hold hold(is_held_, true);
    return std::make_shared<T>(value_);
  }
  /// Whether somebody has set it since; `use(value)` is called then. False also if somebody is just looking at it: then
  /// a later call says so.
  template <typename Use>
  bool Take(const Use& use) {
    if (!has_changed_.load(std::memory_order_relaxed)) return false;
    const Hold hold(is_held_, false);
    if (!hold.has()) return false;
    has_changed_.store(false, std::memory_order_relaxed);
    use(std::as_const(value_));
    return true;
  }
  /// The module has this value now. False: somebody is just looking at it, try again. What somebody has set since
  /// counts.
  bool Follow(const T& value) {
    const Hold hold(is_held_, false);
    if (!hold.has()) return false;
    if (!has_changed_.load(std::memory_order_relaxed)) value_ = value;
    return true;
  }

 private:
  using Hold = runnel::internal::FlagHold;

  bool Assign(const void* value) override {
    const Hold hold(is_held_, true);
    T copy = *static_cast<const T*>(value);
    value_ = std::move(copy);  // whole or not at all, if memory ends
    has_changed_.store(true, std::memory_order_relaxed);
    return true;
  }

  mutable std::atomic_flag is_held_ = ATOMIC_FLAG_INIT;
  T value_;                               // by who holds it
  std::atomic<bool> has_changed_{false};  // changed by who holds it
};

/// An attribute with inputs only, as a parameter: each new value is a request of the attribute, with its validation and
/// exclusion. It follows calls of the attribute's service, and goes back if the component refuses a value. A default of
/// the description is only shown, as in the original; what a file says is set at the start.
///
/// Threads: as Parameter. A value that the component refuses is told in the log, and the ids stay as they are.
template <typename Value>
class AttributeParameter final : public ModulePart {
 public:
  using Request = genom_execution::Request;

  AttributeParameter(ComponentModule& module, std::string name, const genom_execution::ServiceTable& attribute,
                     std::string_view default_text, std::string description,
                     void (*fill)(Request& request, const Value& value), void (*read)(Request& request, Value& value))
      : module_(module),
        attribute_(attribute),
        fill_(fill),
        read_(read),
        parameter_(&module, std::move(name), Options(default_text, std::move(description))),
        accepted_(ValueOf<Value>(default_text)),
        default_text_(TextOf(accepted_)) {
    module.AddPart(*this);
  }

  void Prepare(genom_execution::Engine& engine) override {
    if (request_ == nullptr) request_ = std::make_unique<Request>(engine.component(), attribute_);
    (void)parameter_.Take([](const Value&) {});
    is_due_ = ToText(TypeOf<Value>(), parameter_.Value().get()) != default_text_;
    if (is_due_) fill_(*request_, *static_cast<const Value*>(parameter_.Value().get()));
  }
  void BeforePasses(genom_execution::Engine& engine, Time /*now*/) override {
    if (is_under_way_) return;
    is_due_ |= parameter_.Take([this](const Value& value) { fill_(*request_, value); });
    if (!is_due_) return;
    is_under_way_ = engine.Send(*request_);
    is_due_ = !is_under_way_;
  }
  void AfterPasses() override {
    if (is_under_way_ && request_->state() == Request::State::kDone) {
      is_under_way_ = false;
      if (request_->outcome().is_success()) {
        read_(*request_, accepted_);
      } else {
        module_.log().Warn("{} refuses the value: {}", parameter_.name(), request_->outcome().Text(module_.table()));
        is_behind_ = true;
      }
    }
    if (is_behind_) is_behind_ = !parameter_.Follow(accepted_);
  }
  void AfterCall(Request& request) override {
    if (&request.service() != &attribute_) return;
    read_(request, accepted_);
    is_behind_ = true;
  }

 private:
  static ParameterOptions<Value> Options(std::string_view default_text, std::string description) {
    return {.default_value = ValueOf<Value>(default_text), .description = std::move(description)};
  }

  ComponentModule& module_;
  const genom_execution::ServiceTable& attribute_;
  void (*const fill_)(Request& request, const Value& value);
  void (*const read_)(Request& request, Value& value);
  FollowingParameter<Value> parameter_;
  Value accepted_;  // by the component
  const std::string default_text_;
  std::unique_ptr<Request> request_;
  bool is_due_ = false;
  bool is_under_way_ = false;
  bool is_behind_ = false;  // the parameter, of accepted_
};

}  // namespace runnel::genom_modules
