#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/element/runtime.h"
#include "plugins/ros_services/service_endpoints.h"
#include "plugins/ros_services/service_form.h"
#include "plugins/services/callable.h"

namespace runnel {

class MessageLibrary;
class Port;
class WakeEvent;

/// A service of this application that nodes elsewhere may call.
struct ServiceOfferOptions {
  std::string port = {};     ///< by its path from the root, which may become another one
  std::string service = {};  ///< "/save_map"
  std::string as = {};       ///< "std_srvs/srv/Trigger"; "": made of its types
  SourcePosition position = {};

  bool operator==(const ServiceOfferOptions&) const = default;
};

/// Carries calls from the network to a service of the application and its answers back. The service is called as from a
/// terminal: in its module's cycle or by its own thread. Whoever calls waits as long as it likes; when it has gone, the call is
/// given up.
///
/// Threads: all by the network's thread; but Forget() and Text(), by who has the structure lock. Outside of cycles.
class OfferedService {
 public:
  static constexpr std::size_t kMostCalls = 64;  ///< under way at once

  /// `identity`: as ServiceEndpoints. `wake` wakes the thread that calls Work(). `table`: ServiceTopics::table. `path`: what the
  /// port is called now, under the structure lock; nullptr: as `options` say.
  OfferedService(Runtime& runtime, ServiceOfferOptions options, const MessageLibrary& library, ServiceDialect dialect,
                 std::uint32_t identity, std::shared_ptr<WakeEvent> wake, const DiscoveryTable* table = nullptr,
                 std::function<const std::string&()> path = {});

  [[nodiscard]] const ServiceOfferOptions& options() const noexcept { return options_; }
  /// The structure has changed, or who is there: offers the service while it is there. Errors: what it cannot be offered as.
  Result<void> Follow(WireParticipant& participant, const std::function<bool(std::uint64_t writer)>& is_there);
  /// The element is about to go. Under the structure lock.
  void Forget(const FrameworkElement& element) noexcept;
  /// Begins calls and answers those that have ended. Whether some are under way: then it is to be called again soon.
  bool Work();

  /// nullptr: it is not offered now.
  [[nodiscard]] const ServiceEndpoints* endpoints() const noexcept { return endpoints_.get(); }
  [[nodiscard]] std::string Text() const;
  /// What went wrong since the last call.
  [[nodiscard]] std::optional<Error> TakeError() { return std::exchange(error_, {}); }

 private:
  struct Pending {
    CallId id;
    std::shared_ptr<const ServiceForm> form;
    std::unique_ptr<AnyCall> call;
  };

  // Under the structure lock.
  void SetEndpoints(std::unique_ptr<ServiceEndpoints> next);
  Result<Callable*> Find();
  Result<std::unique_ptr<AnyCall>> Begin(const ServiceMessage& request);
  void Serve(const ServiceMessage& request);
  void Answer(const CallId& id, const ServiceForm& form, const ServiceForm::Outcome& outcome, const void* reply);

  Runtime& runtime_;
  ServiceOfferOptions options_;  // `port` changed by the thread, under the structure lock
  const MessageLibrary& library_;
  const ServiceDialect dialect_;
  const std::uint32_t identity_;
  const std::shared_ptr<WakeEvent> wake_;
  const DiscoveryTable* const table_;
  const std::function<const std::string&()> path_;
  // Of the service as it is now; changed under the structure lock.
  Port* port_ = nullptr;
  Callable* callable_ = nullptr;
  std::shared_ptr<const ServiceForm> form_;
  // The thread's own.
  std::unique_ptr<ServiceEndpoints> endpoints_;
  std::vector<Pending> pending_;
  std::atomic<std::uint64_t> answered_{0};  // statistics, both
  std::atomic<std::uint64_t> failed_{0};
  Octets octets_;
  std::optional<Error> error_;
};

}  // namespace runnel
