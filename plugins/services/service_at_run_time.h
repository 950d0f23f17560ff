#pragma once

#include <functional>
#include <memory>
#include <string>

#include "plugins/services/service_base.h"
#include "plugins/services/signature_at_run_time.h"

namespace runnel {

/// A Service whose types are known at run time only: of modules that are not written in C++. Modules in C++ that have
/// clients of the same signature can be connected.
///
/// Threads, life, errors: as Service; the constructor throws ElementError for types that cannot be had.
class ServiceAtRunTime final : public ServiceBase {
 public:
  /// Reads the arguments and writes the reply, by the form. Its error is the call's; what it throws is the module's fault.
  using Handler = std::function<Result<void>(const CallForm& form, CallBase& call, Activity* activity)>;

  struct Extra {
    bool is_activity = false;             ///< it is served by a thread of its own
    std::string defaults = {};            ///< text of the arguments, of calls from outside; "": none
    bool are_arguments_optional = false;  ///< each has a default
  };

  ServiceAtRunTime(FrameworkElement& group, const std::string& name, const SignatureTypes& types, ServiceOptions options,
                   Extra extra, Handler handler);
  ~ServiceAtRunTime();

  [[nodiscard]] const CallForm& form() const noexcept { return *form_; }

 private:
  class Offer;
  CallStatus Invoke(CallBase& call, Activity* activity) override;

  const Handler handler_;
  std::shared_ptr<const CallForm> form_;
  std::unique_ptr<Port> port_;
  std::unique_ptr<CallRecorder> records_;
};

}  // namespace runnel
