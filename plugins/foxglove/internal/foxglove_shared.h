#pragma once

#include <chrono>
#include <memory>
#include <set>
#include <string>

#include "plugins/foxglove/foxglove.h"
#include "plugins/foxglove/internal/directory.h"

namespace runnel::internal {

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
