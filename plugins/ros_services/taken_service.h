#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/element/runtime.h"
#include "core/port/port.h"
#include "plugins/ros_services/service_endpoints.h"
#include "plugins/ros_services/service_form.h"
#include "plugins/services/service_endpoint.h"
#include "plugins/services/service_signature.h"

namespace runnel {

/// A service elsewhere that clients of this application call.
struct ServiceTakeOptions {
  std::string service = {};  ///< "/save_map"
  std::string as = {};       ///< "std_srvs/srv/Trigger"; "": made of the clients' types
  bool is_live = false;      ///< also with simulated time, whose runs then are not repeatable
  SourcePosition position = {};
};

/// Where clients put their calls of a service that is elsewhere: what an output, which stands for that service, publishes.
struct DistantService {
  DistantService(std::shared_ptr<const CallForm> of_calls, std::shared_ptr<const ServiceForm> of_service)
      : calls(std::move(of_calls)), form(std::move(of_service)) {}
  ~DistantService() { endpoint.EndAll(CallStatus::kDisconnected, "the network has gone"); }

  std::shared_ptr<const CallForm> calls;
  std::shared_ptr<const ServiceForm> form;
  ServiceEndpoint endpoint{64};

  /// The output is of the type of the clients' ports. Under the structure lock.
  static void PublishBy(Port& output, const std::shared_ptr<DistantService>& service);
};

/// Carries calls of clients to a service elsewhere, and its answers back. What is called before the service is there waits for
/// it, until the client's time-out.
///
/// Threads: all by the network's thread, outside of cycles.
class TakenService {
 public:
  TakenService(Runtime& runtime, std::string path, ServiceTakeOptions options, std::shared_ptr<DistantService> service,
               ServiceDialect dialect, std::uint32_t identity, std::shared_ptr<WakeEvent> wake);
  /// Calls that are under way end disconnected. Not under the structure lock.
  ~TakenService();

  /// Begins, if it has not. Errors: of the engine.
  Result<void> Follow(WireParticipant& participant);
  /// Sends calls and hands answers over. Whether calls are under way: then it is to be called again soon, as their time may
  /// be over.
  bool Work();

  [[nodiscard]] const std::string& path() const noexcept { return path_; }
  [[nodiscard]] const ServiceEndpoints* endpoints() const noexcept { return endpoints_.get(); }
  [[nodiscard]] std::string Text() const;
  [[nodiscard]] std::optional<Error> TakeError() { return std::exchange(error_, {}); }

 private:
  class Ring;
  struct Pending {
    std::int64_t number;  // 0 until it is sent
    CallBase* call;
    Octets request;  // until it is sent
  };
  void TakeCalls();
  void TakeReplies();
  void End(CallBase& call, CallStatus status, std::string_view why) noexcept;

  Runtime& runtime_;
  const std::string path_;
  const ServiceTakeOptions options_;
  const std::shared_ptr<DistantService> service_;
  const ServiceDialect dialect_;
  const std::uint32_t identity_;
  const std::shared_ptr<WakeEvent> wake_;
  const std::shared_ptr<Ring> ring_;
  std::unique_ptr<ServiceEndpoints> endpoints_;
  std::vector<Pending> pending_;
  std::optional<Error> error_;
};

}  // namespace runnel
