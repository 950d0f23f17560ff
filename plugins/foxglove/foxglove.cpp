#include "plugins/foxglove/foxglove.h"

#include <chrono>
#include <utility>

#include "plugins/foxglove/internal/foxglove_session.h"
#include "plugins/foxglove/internal/foxglove_shared.h"

namespace runnel {

namespace {

// By which clients know that they talk to another run, and forget what they have of the last.
std::string NewSession() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::to_string(std::chrono::duration_cast<std::chrono::milliseconds>(now).count());
}

}  // namespace

internal::FoxgloveShared::FoxgloveShared(FoxgloveApplication given)
    : application(std::move(given)),
      session(NewSession()),
      directory(application.service.application().runtime),
      tasks(std::make_unique<TaskGroup>(application.service.worker())) {}

internal::FoxgloveShared::~FoxgloveShared() {
  tasks = nullptr;  // they use the rest
  for (const std::string& name : places) DeletePlace(runtime(), name);
}

WebProtocol FoxgloveProtocol(FoxgloveApplication application) {
  return {.names = {"foxglove.websocket.v1", "foxglove.sdk.v1"},
          .start = [shared = std::make_shared<internal::FoxgloveShared>(std::move(application))](WebClient& client)
              -> std::unique_ptr<WebSession> { return std::make_unique<internal::FoxgloveSession>(shared, client); }};
}

}  // namespace runnel
