#pragma once

#include <chrono>
#include <cstddef>
#include <deque>
#include <memory>
#include <set>
#include <string>
#include <utility>

#include "plugins/foxglove/foxglove.h"
#include "plugins/foxglove/internal/directory.h"
#include "plugins/web_server/web_session.h"

namespace runnel::internal {

/// Text messages on their way to a client that may be slow: none is lost, and they stay in order. The
/// caller makes no more of them while is_long().
class SendQueue {
 public:
  explicit SendQueue(WebClient& client) : client_(client) {}

  void Send(std::string message) {
    waiting_.push_back(std::move(message));
    Continue();
  }
  /// Whether all has gone out.
  bool Continue() {
    while (!waiting_.empty() && client_.SendText(waiting_.front())) waiting_.pop_front();
    return waiting_.empty();
  }
  [[nodiscard]] bool is_long() const noexcept { return waiting_.size() >= kLong; }
  [[nodiscard]] bool is_empty() const noexcept { return waiting_.empty(); }

 private:
  static constexpr std::size_t kLong = 100;

  WebClient& client_;
  std::deque<std::string> waiting_;
};

/// What the sessions with all clients share.
///
/// Threads:  the server's.
struct FoxgloveShared {
  explicit FoxgloveShared(FoxgloveApplication given);
  ~FoxgloveShared();

  [[nodiscard]] Runtime& runtime() const noexcept { return application.service.application().runtime; }

  [[nodiscard]] WebRole RoleOf(const WebClient& client) const {
    return application.is_read_only ? WebRole::kLook : client.role();
  }

  [[nodiscard]] WebSession::SteadyTime Now() const {
    const Clock* const clock = application.steady_clock;
    return clock != nullptr ? WebSession::SteadyTime(clock->Now().time_since_epoch())
                            : std::chrono::steady_clock::now();
  }

  const FoxgloveApplication application;
  const std::string session;  ///< another one with each start
  Directory directory;
  std::set<std::string> places;  ///< names of what clients have brought; the worker's
  std::unique_ptr<TaskGroup> tasks;
};

/// Deletes what a client has brought, if it is still there. Waits. False: for want of memory it is there still.
bool DeletePlace(Runtime& runtime, const std::string& name) noexcept;

}  // namespace runnel::internal
