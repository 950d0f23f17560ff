#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <utility>

#include "core/types/value_tokens.h"
#include "plugins/genom_modules/component_module.h"
#include "plugins/parameters/parameter.h"

namespace runnel::genom_modules {

/// An attribute with inputs only, as a parameter: each new value is a request of the attribute, with its validation and
/// exclusion. It follows calls of the attribute's service, and goes back if the component refuses a value. A default of
/// the description is only shown, as in the original; what a file says is set at the start.
///
/// Threads: as Parameter; the module's cycle is never blocked by those who look.
/// Errors: SetFrom() says why the component refuses a value, unless something that is under way has to end before it can
/// tell: then the log does. Parse() wants all that calls of the service have to say.
template <typename T>
class AttributeParameter final : public ParameterBase, public ModulePart {
 public:
  using Request = genom_execution::Request;

  /// `service`: the port of the attribute's.
  AttributeParameter(ComponentModule& module, std::string name, const genom_execution::ServiceTable& attribute,
                     const Port& service, std::string_view default_text, std::string description,
                     void (*fill)(Request& request, const T& value), void (*read)(Request& request, T& value))
      : ParameterBase(&module, std::move(name),
                      internal::DescriptionOf(ParameterOptions<T>{.default_value = ValueOf<T>(default_text),
                                                                  .description = std::move(description)},
                                              false),
                      nullptr),
        module_(module),
        attribute_(attribute),
        service_(service),
        fill_(fill),
        read_(read),
        accepted_(ValueOf<T>(default_text)),
        value_(accepted_),
        default_text_(TextOf(accepted_)) {
    module.AddPart(*this);
  }

  /// What a structure leaves out stays as it is.
  [[nodiscard]] Result<std::shared_ptr<const void>> Parse(std::string_view text) const override {
    auto parsed = ParameterBase::Parse(text);
    if (!parsed || type().kind() != TypeKind::kStructure) return parsed;
    const auto* const callable = service_.FindAnnotation<Callable>();
    if (callable->arguments()->fields().size() > 1) {  // else it is inside of the only one
      if (auto good = CheckRequired(*callable, TokensOf(text)->root()); !good) return good.error();
    }
    const std::shared_ptr<void> value = Value();
    (void)runnel::SetFromText(type(), text, value.get());
    return std::shared_ptr<const void>(value);
  }
  Result<void> SetFrom(const void* value) override {
    if (auto set = ParameterBase::SetFrom(value); !set) return set;
    std::string refusal;
    module_.AskAtOnce(*this, [&] {
      refusal = refusal_;
      return is_under_way_ || !has_changed_.load(std::memory_order_relaxed);  // else somebody is just looking at it
    });
    if (refusal.empty()) return {};
    return Error{.message = refusal, .path = path()};
  }
  [[nodiscard]] std::shared_ptr<void> Value() const override {
    const Hold hold(is_held_, true);
    return std::make_shared<T>(value_);
  }

  void Prepare(genom_execution::Engine& engine) override {
    if (request_ == nullptr) request_ = std::make_unique<Request>(engine.component(), attribute_);
    const Hold hold(is_held_, true);
    has_changed_.store(false, std::memory_order_relaxed);
    is_due_ = TextOf(value_) != default_text_;
    if (is_due_) fill_(*request_, value_);
  }
  void BeforePasses(genom_execution::Engine& engine, Time /*now*/) override {
    if (is_under_way_) return;
    if (has_changed_.load(std::memory_order_relaxed)) {
      const Hold hold(is_held_, false);
      if (!hold.has()) return;
      fill_(*request_, value_);
      has_changed_.store(false, std::memory_order_relaxed);
      refusal_.clear();
      is_due_ = true;
    }
    if (!is_due_) return;
    is_under_way_ = engine.Send(*request_);
    is_due_ = !is_under_way_;
  }
  void AfterPasses() override {
    if (is_under_way_ && request_->state() == Request::State::kDone) {
      is_under_way_ = false;
      is_behind_ = !request_->outcome().is_success();
      if (is_behind_) {
        refusal_ = "refuses the value: " + request_->outcome().Text(module_.table());
        module_.log().Warn("{} {}", name(), refusal_);
      } else {
        read_(*request_, accepted_);
      }
    }
    if (!is_behind_) return;
    const Hold hold(is_held_, false);
    is_behind_ = !hold.has();
    // What somebody has set since counts.
    if (hold.has() && !has_changed_.load(std::memory_order_relaxed)) value_ = accepted_;
  }
  void AfterCall(Request& request) override {
    if (&request.service() != &attribute_) return;
    read_(request, accepted_);
    is_behind_ = true;
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

  ComponentModule& module_;
  const genom_execution::ServiceTable& attribute_;
  const Port& service_;
  void (*const fill_)(Request& request, const T& value);
  void (*const read_)(Request& request, T& value);
  T accepted_;  // by the component
  mutable std::atomic_flag is_held_ = ATOMIC_FLAG_INIT;
  T value_;                               // by who holds it
  std::atomic<bool> has_changed_{false};  // changed by who holds it
  const std::string default_text_;
  std::unique_ptr<Request> request_;
  std::string refusal_;  // why the last one was refused
  bool is_due_ = false;
  bool is_under_way_ = false;
  bool is_behind_ = false;  // the parameter, of accepted_
};

}  // namespace runnel::genom_modules
