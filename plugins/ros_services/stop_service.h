#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include "core/element/runtime.h"
#include "plugins/ros_services/service_endpoints.h"

namespace runnel {

/// The STOP of the robot as a service of its node, `~/stop` (std_srvs/srv/SetBool): true presses it, false releases it if
/// that is allowed. Its answer says what has happened; without success also where STOP is in force and stops nothing. It
/// waits for `is_kept`, and says if the next process would not know of it.
///
/// Threads:  requests are served by a thread of the engine, so nothing that the application does delays them; the rest any.
/// Ownership: participant and runtime must outlive it.
class StopService {
 public:
  /// `table`: ServiceTopics::table. Errors: of the engine.
  static Result<std::unique_ptr<StopService>> Start(Runtime& runtime, bool may_release, const std::string& node,
                                                    WireParticipant& participant, ServiceDialect dialect,
                                                    std::function<bool()> is_kept = {},
                                                    std::function<Result<void>()> check = {},
                                                    const DiscoveryTable* table = nullptr);

  [[nodiscard]] const ServiceEndpoints& endpoints() const noexcept { return *endpoints_; }

  /// Does and answers what has come, then answers those whom an answer is kept for. Any thread.
  void Serve() noexcept;
  /// Serves again, where there was no memory for an answer that is kept. Any thread.
  void ServeLeft() noexcept {
    if (is_left_.exchange(false, std::memory_order_relaxed)) Serve();
  }

 private:
  StopService(Runtime& runtime, bool may_release, std::string name, std::function<bool()> is_kept,
              std::function<Result<void>()> check)
      : runtime_(runtime),
        may_release_(may_release),
        name_(std::move(name)),
        is_kept_(std::move(is_kept)),
        check_(std::move(check)) {}
  struct Answer {
    bool success;
    std::string message;
  };
  Answer Do(const ServiceMessage& request);
  void Serve(const ServiceMessage& request) noexcept;

  Runtime& runtime_;
  const bool may_release_;
  const std::string name_;  // "/base/stop"
  const std::function<bool()> is_kept_;
  const std::function<Result<void>()> check_;  // RosHooks::check_stop
  std::mutex serving_;
  std::atomic<bool> is_left_{false};
  std::atomic<ServiceEndpoints*> known_{nullptr};  // by then they may take requests
  std::unique_ptr<ServiceEndpoints> endpoints_;
};

}  // namespace runnel
