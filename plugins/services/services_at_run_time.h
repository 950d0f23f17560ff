#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/port/port.h"
#include "plugins/services/any_call.h"
#include "plugins/services/client_base.h"
#include "plugins/services/service_base.h"
#include "plugins/services/service_signature.h"

namespace runnel {

/// What a service takes and gives, by descriptions.
struct SignatureTypes {
  const TypeInfo* reply = nullptr;  ///< nullptr: nothing but that it has been done
  std::vector<const TypeInfo*> arguments = {};
};

/// "service bool(double)": what the type of the ports by which such services are connected is called.
[[nodiscard]] std::string LinkName(const SignatureTypes& types);

/// Such a signature, and the type of its ports.
struct FoundSignature {
  const TypeInfo* link;
  const ServiceSignature* signature;
};
/// That of modules in C++ which have been made, so that they can be connected; else one is made, always the same for the
/// same types. Errors: a type whose values only a module can make. Any thread; locks.
[[nodiscard]] Result<FoundSignature> SignatureAtRunTime(const SignatureTypes& types);

/// The two ends of such connections.
[[nodiscard]] std::unique_ptr<Port> MakeLinkOutput(const TypeInfo& link, FrameworkElement& group, std::string name,
                                                   OutputOptions options);
[[nodiscard]] std::unique_ptr<Port> MakeLinkInput(const TypeInfo& link, FrameworkElement& group, std::string name,
                                                  InputOptions options);

/// A Service whose types are known at run time only: of modules that are not written in C++. Modules in C++ that have
/// clients of the same signature can be connected.
///
/// Threads, life, errors: as Service; the constructor throws ElementError for types that cannot be had.
class ServiceAtRunTime final : public ServiceBase {
 public:
  /// Reads the arguments and writes the reply, by the form. Its error is the call's; what it throws is the module's fault.
  using Handler = std::function<Result<void>(const CallForm& form, CallBase& call, Activity* activity)>;

  ServiceAtRunTime(FrameworkElement& group, const std::string& name, const SignatureTypes& types,
                   ServiceOptions options, CallableOptions extra, Handler handler);
  ~ServiceAtRunTime() { Close(); }

  [[nodiscard]] const CallForm& form() const noexcept { return *form_; }

 private:
  CallStatus Invoke(CallBase& call, Activity* activity) override;

  const Handler handler_;
  std::shared_ptr<const CallForm> form_;
  std::unique_ptr<Port> port_;
  std::unique_ptr<CallRecorder> records_;
};

/// A Client whose types are known at run time only: of modules that are not written in C++.
///
///     CallBase* const call = client.Acquire();          // nullptr: too many are under way
///     …                                                 // write its arguments, by the form
///     if (client.Begin(*call) == CallStatus::kPending) …  // Poll(), AwaitInCycle(), or nothing
///     CallSlots::Release(*call);
///
/// Threads, life: as Client. The constructor throws ElementError for types that cannot be had.
class ClientAtRunTime final : public ClientBase {
 public:
  /// For calls that are awaited in the cycle.
  using CalledBack = std::function<void(CallBase& call, CallStatus status)>;

  ClientAtRunTime(FrameworkElement& group, const std::string& name, const SignatureTypes& types,
                  const ClientOptions& options, CalledBack called_back);
  ~ClientAtRunTime() { Close(); }

  using ClientBase::Acquire;
  using ClientBase::AwaitInCycle;
  using ClientBase::Begin;
  [[nodiscard]] const std::shared_ptr<const CallForm>& form() const noexcept { return form_; }

 private:
  ClientAtRunTime(FrameworkElement& group, const std::string& name, FoundSignature found, const ClientOptions& options,
                  CalledBack called_back);
  [[nodiscard]] ServiceEndpoint* endpoint() const noexcept override { return EndpointAt(*port_); }
  void CallBack(CallBase& call, CallStatus status) override { called_back_(call, status); }

  const CalledBack called_back_;
  const std::shared_ptr<const CallForm> form_;
  const std::unique_ptr<Port> port_;
};

}  // namespace runnel
