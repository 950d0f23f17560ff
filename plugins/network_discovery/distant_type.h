#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/paths/distant_ports.h"

namespace runnel {

class DiscoveryTable;
struct WireMember;

/// What is known of a port of another application.
struct OfferedType {
  DistantType type = {};
  bool is_offered = false;   ///< somebody writes it, so that what it has is known, if not here
  std::string message = {};  ///< that is written there is of this type of ROS 2, if of none of an application of Runnel
};

/// Of "//camera_box/camera/image", by what its writers say. `expected`: taken for it if one of them fits it; optional.
/// `know_types` makes more types known, if there are any; under the structure lock if that calls for it.
[[nodiscard]] OfferedType FindDistantType(const DiscoveryTable& table, const std::string& path, const TypeInfo* expected,
                                          const std::function<void()>& know_types);

/// Who has the first word of a path or a topic: "//my-robot/laser" and "/my_robot/laser" are both of "my-robot".
[[nodiscard]] std::optional<WireMember> MemberOfPath(const DiscoveryTable& table, const std::string& path);
/// What others offer below the first word of a path: "//camera_box/camera/image".
[[nodiscard]] std::vector<std::string> OfferedBeside(const DiscoveryTable& table, const std::string& path);

/// What is said on the wire of plain numbers: "runnel_unit=deg;"; "" of others.
[[nodiscard]] std::string UnitText(const std::string& unit);

}  // namespace runnel
