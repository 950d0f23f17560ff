#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "core/base/clock.h"
#include "core/element/framework_element.h"
#include "core/lockfree/wake_event.h"
#include "core/port/port.h"
#include "plugins/services/call.h"
#include "plugins/services/callable.h"
#include "plugins/services/cycle_work.h"
#include "plugins/services/service_endpoint.h"

namespace runnel {

/// What a call that takes long says of itself, and is told. A handler that takes one as its first argument is run by a
/// thread of the service's own.
///
/// Threads: Report() and is_abort_asked() by the handler; the rest any.
class Activity {
 public:
  /// `fraction` from 0 to 1; `doing` is a literal, or lives as long.
  void Report(double fraction, const char* doing = "") noexcept {
    progress_.store(fraction, std::memory_order_relaxed);
    doing_.store(doing, std::memory_order_relaxed);
    call_->progress.store(fraction, std::memory_order_relaxed);
    call_->doing.store(doing, std::memory_order_relaxed);
  }
  /// The caller wants no answer any more, somebody has asked for an end, or the module is about to go, and waits for
  /// the handler: it should come to its end soon, with an error.
  [[nodiscard]] bool is_abort_asked() const noexcept {
    return is_abort_asked_.load(std::memory_order_relaxed) || call_->is_given_up.load(std::memory_order_relaxed);
  }

  void Abort() noexcept { is_abort_asked_.store(true, std::memory_order_relaxed); }
  [[nodiscard]] double progress() const noexcept { return progress_.load(std::memory_order_relaxed); }
  [[nodiscard]] const char* doing() const noexcept { return doing_.load(std::memory_order_relaxed); }
  [[nodiscard]] std::uint64_t number() const noexcept { return number_.load(std::memory_order_relaxed); }
  [[nodiscard]] bool has_abort() const noexcept { return is_abort_asked_.load(std::memory_order_relaxed); }

  /// The service: the handler is about to be called.
  void Begin(CallBase& call) noexcept {
    call_ = &call;
    number_.store(call.number, std::memory_order_relaxed);
    is_abort_asked_.store(false, std::memory_order_relaxed);
    Report(0);
  }

 private:
  CallBase* call_ = nullptr;  // the handler's thread's
  std::atomic<std::uint64_t> number_{0};
  std::atomic<double> progress_{0};
  std::atomic<const char*> doing_{""};
  std::atomic<bool> is_abort_asked_{false};
};

/// The thread of a service whose calls take long. It begins when the module gets ready. When the module is taken out the
/// handler is asked to end; it is waited for when the module is destroyed, before any of the module's members goes, and
/// not under the structure lock, which the handler may want.
///
/// Threads: Begin() by the module's cycle; activity() from any.
class ServiceWorker final : public FrameworkElement {
 public:
  /// `tell_free`: called when a call is over and the next may begin.
  ServiceWorker(const Placement& placement, std::function<void(CallBase&, Activity&)> serve,
                std::function<void()> tell_free);
  ~ServiceWorker() override;

  // acquire: pairs with the release in Work(): the call before is over.
  [[nodiscard]] bool is_free() const noexcept { return current_.load(std::memory_order_acquire) == nullptr; }
  /// Precondition: is_free().
  void Begin(CallBase& call) noexcept;
  [[nodiscard]] const Activity& activity() const noexcept { return activity_; }
  void Abort() noexcept { activity_.Abort(); }
  /// The module owns it; `service` knows where it is, as long as it is there.
  void set_known_by(ServiceWorker** service) noexcept { known_by_ = service; }
  /// Asks the handler to end, and waits for it.
  void Stop() noexcept;

 private:
  Result<void> Prepare() override;
  void Detach() noexcept override { AskToEnd(); }
  void AskToEnd() noexcept;
  void Work() noexcept;

  const std::function<void(CallBase&, Activity&)> serve_;
  const std::function<void()> tell_free_;
  Activity activity_;
  std::atomic<CallBase*> current_{nullptr};
  std::atomic<bool> is_stopping_{false};
  WakeEvent event_;
  std::thread thread_;
  ServiceWorker** known_by_ = nullptr;
};

struct ServiceOptions {
  std::string description = {};
  /// Of the arguments, in their order, for those who write them by name. A single one without a name is written as it is.
  std::vector<std::string> arguments = {};
  std::size_t queue = 16;  ///< how many calls may wait
};

/// The part of a service that does not depend on its types.
class ServiceBase : public CyclePart {
 public:
  /// By a thread of the program's own, for a service that is part of no module: serves what waits. Modules do it by
  /// themselves, before each Update().
  void Serve() { BeforeUpdate(); }
  /// The port by which clients are connected.
  [[nodiscard]] const Port& port() const noexcept { return *port_; }
  [[nodiscard]] Port& port() noexcept { return *port_; }
  [[nodiscard]] virtual ServiceState state() const;
  virtual bool Abort();
  /// Whose queue its clients fill. nullptr: none yet. Always that of the channel which the port has now: a swap exchanges
  /// channels, and those who have put their calls into one find the module that serves it.
  [[nodiscard]] ServiceEndpoint* endpoint() const { return EndpointAt(*port_); }

 protected:
  /// Also where Open() has thrown: no module calls what is not there.
  ~ServiceBase() { Leave(); }

  /// The port is there, and has its endpoint. Last in a constructor: what throws leaves nothing behind then.
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
  void Leave() noexcept;
  void Answer(ServiceEndpoint& at, CallBase& call);
  void AnswerByWorker(CallBase& call, Activity& activity) noexcept;

  Port* port_ = nullptr;
  CycleWork* work_ = nullptr;
  ServiceWorker* worker_ = nullptr;            // the module's, or its own
  std::unique_ptr<ServiceWorker> own_worker_;  // of a service that is part of no module
};

}  // namespace runnel
