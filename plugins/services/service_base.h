#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "core/port/port.h"
#include "plugins/services/activity.h"
#include "plugins/services/callable.h"
#include "plugins/services/cycle_work.h"
#include "plugins/services/service_endpoint.h"
#include "plugins/services/service_worker.h"

namespace runnel {

struct ServiceOptions {
  std::string description = {};
  /// Of the arguments, in their order, for those who write them by name. A single one without a name is written as it is.
  std::vector<std::string> arguments = {};
  std::size_t queue = 16;  ///< how many calls may wait
};

/// The part of a service that does not depend on its types.
class ServiceBase : public CyclePart {
 public:
  ServiceBase(const ServiceBase&) = delete;
  ServiceBase& operator=(const ServiceBase&) = delete;

  /// By a thread of the program's own, for a service that is part of no module: serves what waits. Modules do it by
  /// themselves, before each Update().
  void Serve() { BeforeUpdate(); }
  /// The port by which clients are connected.
  [[nodiscard]] const Port& port() const noexcept { return *port_; }
  [[nodiscard]] Port& port() noexcept { return *port_; }
  [[nodiscard]] virtual ServiceState state() const;
  virtual bool Abort();
  /// Whose queue its clients fill. nullptr: none yet.
  [[nodiscard]] ServiceEndpoint* endpoint() const;

 protected:
  ServiceBase() = default;
  ~ServiceBase() = default;

  /// The port is there, and has its endpoint.
  void Open(Port& port, bool is_activity);
  /// While the port is still there.
  void Close() noexcept;
  /// Calls the handler, writes the reply, publishes the record. Says how it ended; may throw.
  virtual CallStatus Invoke(CallBase& call, Activity* activity) = 0;
  [[nodiscard]] bool is_activity() const noexcept { return worker_ != nullptr; }
  // Of services that serve in a way of their own, too.
  void BeforeUpdate() override;
  void SetWaker(Waker* waker) override;
  void AfterFault(std::string_view what) noexcept override;

 private:
  void Answer(ServiceEndpoint& at, CallBase& call);
  void AnswerByWorker(CallBase& call, Activity& activity) noexcept;

  Port* port_ = nullptr;
  CycleWork* work_ = nullptr;
  ServiceWorker* worker_ = nullptr;             // the module's, or its own
  std::unique_ptr<ServiceWorker> own_worker_;  // of a service that is part of no module
};

}  // namespace runnel
