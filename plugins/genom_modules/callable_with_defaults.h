#pragma once

#include <memory>
#include <string>
#include <utility>

#include "core/types/text_format.h"
#include "plugins/services/callable.h"

namespace runnel::genom_modules {

/// A service to those who do not know its types: what a call leaves out is as the description says.
template <typename Inner>
class CallableWithDefaults final : public Callable {
 public:
  /// `defaults`: text of the arguments, "" for none.
  CallableWithDefaults(std::unique_ptr<Inner> inner, std::string defaults)
      : inner_(std::move(inner)), defaults_(std::move(defaults)) {}

  [[nodiscard]] const TypeInfo* arguments() const override { return inner_->arguments(); }
  [[nodiscard]] const TypeInfo* reply() const override { return inner_->reply(); }
  [[nodiscard]] const std::string& description() const override { return inner_->description(); }
  [[nodiscard]] bool is_activity() const override { return inner_->is_activity(); }
  [[nodiscard]] std::unique_ptr<AnyCall> NewCall() override {
    auto call = inner_->NewCall();
    // What cannot be said of a type, a union, is not.
    if (!defaults_.empty()) (void)SetFromText(*inner_->arguments(), defaults_, call->arguments());
    return call;
  }
  [[nodiscard]] ServiceState state() const override { return inner_->state(); }
  bool Abort() override { return inner_->Abort(); }

 private:
  const std::unique_ptr<Inner> inner_;
  const std::string defaults_;
};

}  // namespace runnel::genom_modules
