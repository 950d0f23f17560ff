#pragma once

#include "core/element/robot_stop.h"
#include "tests/plugins/inspector/inspector_fixture.h"

namespace runnel::test {

inline WebServerOptions LookAndDrive() {
  WebServerOptions options{.port = 0};
  for (const WebRole role : {WebRole::kLook, WebRole::kDrive}) {
    options.tokens.push_back({role, "secret-of-" + std::string(WebRoleName(role))});
  }
  return options;
}

inline auto InForce(bool in_force) {
  return [in_force](const Json& each) { return each["op"] == "alive" && each["stop"]["in_force"] == in_force; };
}

/// Viewers of all roles, and the STOP of their robot.
class ViewersStop : public RunningInspectorTest {
 protected:
  [[nodiscard]] Viewer Connect(const std::string& protocol, WebRole role) const {
    return Viewer(server->port(), "runnel.token.secret-of-" + std::string(WebRoleName(role)), protocol);
  }
  [[nodiscard]] bool in_force() { return runtime.robot_stop().in_force(); }
};

}  // namespace runnel::test
