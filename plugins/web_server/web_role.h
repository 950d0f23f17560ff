#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace runnel {

/// What a client may do; each role may do what those before it may.
enum class WebRole {
  kLook,    ///< sees everything, changes nothing
  kDrive,   ///< moves the robot by hand: publishes, pauses
  kChange,  ///< whatever the owner of the application may
};

/// By number: "look", "drive", "change".
constexpr std::array<std::string_view, 3> kWebRoleNames{"look", "drive", "change"};

[[nodiscard]] constexpr std::string_view WebRoleName(WebRole role) {
  return kWebRoleNames[static_cast<std::size_t>(role)];
}
/// Nothing: there is no such role.
[[nodiscard]] constexpr std::optional<WebRole> WebRoleNamed(std::string_view name) {
  for (std::size_t i = 0; i < kWebRoleNames.size(); ++i) {
    if (kWebRoleNames[i] == name) return static_cast<WebRole>(i);
  }
  return {};
}

}  // namespace runnel
