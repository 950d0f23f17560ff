#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "core/types/type_info.h"
#include "core/types/value_tokens.h"
#include "plugins/genom_modules/component_module.h"
#include "plugins/parameters/cycle_lock.h"
#include "plugins/parameters/parameter.h"
#include "plugins/services/callable.h"

namespace runnel::genom_modules {

/// An attribute with inputs only, as a parameter: each new value is a request of the attribute, with its validation and
/// exclusion. It follows calls of the attribute's service, and goes back if the component refuses a value. A default of
/// the description is only shown, as in the original; what a file says is set at the start.
///
/// Threads: as Parameter; the module's cycle is never blocked by those who look.
/// Errors: Outcome() says why the component refuses a value, and the log does. Parse() wants all members of a structure.
template <typename T>
class AttributeParameter final : public ParameterBase, public ModulePart {
 public:
  using Request = genom_execution::Request;

  AttributeParameter(ComponentModule& module, std::string name, const genom_execution::ServiceTable& attribute,
                     std::string_view default_text, std::string description,
                     void (*fill)(Request& request, const T& value), void (*read)(Request& request, T& value))
      : ParameterBase(&module, std::move(name),
                      internal::DescriptionOf(ParameterOptions<T>{.default_value = ValueOf<T>(default_text),
                                                                  .description = std::move(description)},
                                              false),
                      nullptr),
        module_(module),
        attribute_(attribute),
        fill_(fill),
        read_(read),
        accepted_(ValueOf<T>(default_text)),
        value_(accepted_),
        default_text_(TextOf(accepted_)) {
    module.AddPart(*this);
  }

  /// What a structure leaves out would be 0.
  [[nodiscard]] Result<std::shared_ptr<const void>> Parse(std::string_view text) const override {
    auto parsed = ParameterBase::Parse(text);
    if (!parsed || (type().kind() != TypeKind::kStructure && type().kind() != TypeKind::kSequence)) return parsed;
    const auto all = CheckAllAreSaid(type(), TokensOf(text)->root(), true);
    return all ? parsed : all.error();
  }
  [[nodiscard]] std::optional<Result<void>> Outcome() const override {
    std::string refusal;
    {
      const std::lock_guard lock(lock_);
      if (!is_settled_) return {};
      refusal = refusal_;
    }
    return refusal.empty() ? Result<void>() : Error{.message = std::move(refusal), .path = path()};
  }
  [[nodiscard]] std::shared_ptr<void> Value() const override {
    const std::lock_guard lock(lock_);
    return std::make_shared<T>(value_);
  }

  void PrepareFor(genom_execution::Engine& engine) override {
    if (request_ == nullptr) request_ = std::make_unique<Request>(engine.component(), attribute_);
    const std::lock_guard lock(lock_);
    // Where a swap has been taken back, what was set meanwhile is asked for, the default, too.
    is_due_ = (has_begun_.load(std::memory_order_relaxed) && has_changed_.load(std::memory_order_relaxed)) ||
              TextOf(value_) != default_text_;
    has_changed_.store(false, std::memory_order_relaxed);
    if (is_due_) fill_(*request_, value_);
  }
  void BeforePasses(genom_execution::Engine& engine, Time /*now*/) override {
    has_begun_.store(true, std::memory_order_relaxed);
    if (is_under_way_) return;
    if (has_changed_.load(std::memory_order_relaxed)) {
      const std::unique_lock lock(lock_, std::try_to_lock);
      if (!lock) return;
      fill_(*request_, value_);
      has_changed_.store(false, std::memory_order_relaxed);
      is_due_ = true;
    }
    if (!is_due_) return;
    is_under_way_ = engine.Send(*request_);
    is_due_ = !is_under_way_;
  }
  void AfterPasses() override {
    if (is_under_way_ && request_->state() == Request::State::kDone) {
      is_under_way_ = false;
      is_behind_ = true;
      said_.clear();
      if (request_->outcome().is_success()) {
        read_(*request_, accepted_);
      } else {
        said_ = "refuses the value: " + request_->outcome().Text(module_.table());
        module_.log().Warn("{} {}", name(), said_);
      }
    }
    if (!is_behind_) return;
    const std::unique_lock lock(lock_, std::try_to_lock);
    is_behind_ = !lock;
    if (!lock) return;
    // What somebody has set since counts, and is sent now that no other is under way.
    if (has_changed_.load(std::memory_order_relaxed)) return module_.Wake();
    value_ = accepted_;
    refusal_ = said_;
    is_settled_ = !is_under_way_ && !is_due_;
  }
  void AfterCall(Request& request) override {
    if (&request.service() != &attribute_) return;
    read_(request, accepted_);
    is_behind_ = true;
  }

 private:
  bool Assign(const void* value) override {
    T copy = *static_cast<const T*>(value);
    {
      const std::lock_guard lock(lock_);
      value_ = std::move(copy);  // whole or not at all, if memory ends
      has_changed_.store(true, std::memory_order_relaxed);
      refusal_.clear();
      is_settled_ = !has_begun_.load(std::memory_order_relaxed);  // who has not begun asks nobody
    }
    module_.Wake();
    return true;
  }

  ComponentModule& module_;
  const genom_execution::ServiceTable& attribute_;
  void (*const fill_)(Request& request, const T& value);
  void (*const read_)(Request& request, T& value);
  T accepted_;  // by the component
  mutable CycleLock lock_{[this]() noexcept { module_.Wake(); }};
  T value_;                               // guarded by lock_
  std::atomic<bool> has_changed_{false};  // changed under lock_
  std::string refusal_;                   // likewise
  bool is_settled_ = true;                // likewise
  std::atomic<bool> has_begun_{false};
  const std::string default_text_;
  std::unique_ptr<Request> request_;
  std::string said_;  // why the component has refused the last one; "" if it has not
  bool is_due_ = false;
  bool is_under_way_ = false;
  bool is_behind_ = false;  // the parameter, of accepted_
};

}  // namespace runnel::genom_modules
