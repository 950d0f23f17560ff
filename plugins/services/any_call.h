#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "plugins/services/callable.h"
#include "plugins/services/service_base.h"
#include "plugins/services/service_signature.h"

namespace runnel {

/// What calls from outside are told of a service besides its types.
struct CallableOptions {
  bool is_activity = false;                ///< it is served by a thread of its own
  std::string defaults = {};               ///< text of the arguments, of calls from outside; "": none
  bool are_arguments_optional = false;     ///< each has a default
  std::vector<std::string> required = {};  ///< names of arguments that have none
};

/// What a service is to those who do not know its types. Each call has a slot of its own.
class CallableService final : public Callable {
 public:
  /// `form`: of the arguments and the reply, by the signature.
  CallableService(ServiceBase& service, const ServiceSignature& signature, std::shared_ptr<const CallForm> form,
                  std::string description, CallableOptions options)
      : service_(service),
        signature_(signature),
        form_(std::move(form)),
        description_(std::move(description)),
        options_(std::move(options)) {}

  [[nodiscard]] const TypeInfo* arguments() const override { return form_->arguments(); }
  [[nodiscard]] const TypeInfo* reply() const override { return form_->reply(); }
  [[nodiscard]] bool are_arguments_optional() const override { return options_.are_arguments_optional; }
  [[nodiscard]] std::vector<std::string> required() const override { return options_.required; }
  [[nodiscard]] const std::string& description() const override { return description_; }
  [[nodiscard]] bool is_activity() const override { return options_.is_activity; }
  [[nodiscard]] std::unique_ptr<AnyCall> NewCall() override;
  [[nodiscard]] ServiceState state() const override { return service_.state(); }
  bool Abort() override { return service_.Abort(); }

 private:
  ServiceBase& service_;
  const ServiceSignature& signature_;
  const std::shared_ptr<const CallForm> form_;
  const std::string description_;
  const CallableOptions options_;
};

}  // namespace runnel
