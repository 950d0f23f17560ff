#pragma once

#include <string>
#include <utility>

#include "plugins/genom_modules/component_module.h"
#include "plugins/parameters/parameter.h"

namespace runnel::genom_modules {

/// An attribute with inputs only, as a parameter: each new value is a request of the attribute, with its validation and
/// exclusion. A default of the description is only shown, as in the original; what a file says is set at the start.
///
/// Threads: as Parameter. A value that the component refuses is told in the log, and the ids stay as they are.
template <typename Value>
class AttributeParameter final : public ModulePart {
 public:
  AttributeParameter(ComponentModule& module, std::string name, const genom_execution::ServiceTable& attribute,
                     std::string_view default_text, std::string description,
                     void (*fill)(genom_execution::Request& request, const Value& value))
      : module_(module),
        attribute_(attribute),
        fill_(fill),
        parameter_(&module, std::move(name), Options(default_text, std::move(description))),
        default_text_(TextOf(ValueOf<Value>(default_text))) {
    module.AddPart(*this);
  }

  void Prepare(genom_execution::Engine& engine) override {
    if (request_ == nullptr) request_ = std::make_unique<genom_execution::Request>(engine.component(), attribute_);
    (void)parameter_.HasChanged();
    is_due_ = ToText(TypeOf<Value>(), parameter_.Value().get()) != default_text_;
  }
  void BeforePasses(genom_execution::Engine& engine, Time /*now*/) override {
    is_due_ |= parameter_.HasChanged();
    if (!is_due_ || is_under_way_) return;
    if constexpr (kIsCopiedParameter<Value>) {
      fill_(*request_, parameter_.Get());
    } else {
      fill_(*request_, *parameter_.Get());
    }
    is_under_way_ = engine.Send(*request_);
    is_due_ = !is_under_way_;
  }
  void AfterPasses() override {
    if (!is_under_way_ || request_->state() != genom_execution::Request::State::kDone) return;
    is_under_way_ = false;
    if (request_->outcome().is_success()) return;
    module_.log().Warn("{} refuses the value: {}", parameter_.name(),
                       request_->outcome().Text(module_.engine().component()));
  }

 private:
  static ParameterOptions<Value> Options(std::string_view default_text, std::string description) {
    ParameterOptions<Value> options;
    options.default_value = ValueOf<Value>(default_text);
    options.description = std::move(description);
    return options;
  }

  ComponentModule& module_;
  const genom_execution::ServiceTable& attribute_;
  void (*const fill_)(genom_execution::Request& request, const Value& value);
  Parameter<Value> parameter_;
  const std::string default_text_;
  std::unique_ptr<genom_execution::Request> request_;
  bool is_due_ = false;
  bool is_under_way_ = false;
};

}  // namespace runnel::genom_modules
