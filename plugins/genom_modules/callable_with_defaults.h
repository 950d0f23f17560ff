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
  /// `defaults`: text of the arguments, "" for none. `are_all_there`: each argument has one.
  CallableWithDefaults(std::unique_ptr<Inner> inner, std::string defaults, bool are_all_there)
      : inner_(std::move(inner)), defaults_(std::move(defaults)), are_all_there_(are_all_there) {}

  [[nodiscard]] const TypeInfo* arguments() const override { return inner_->arguments(); }
  [[nodiscard]] const TypeInfo* reply() const override { return inner_->reply(); }
  [[nodiscard]] bool are_arguments_optional() const override { return are_all_there_; }
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
  const bool are_all_there_;
};

}  // namespace runnel::genom_modules
