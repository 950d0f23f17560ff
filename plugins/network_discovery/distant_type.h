#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
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
[[nodiscard]] OfferedType FindDistantType(const DiscoveryTable& table, const std::string& path,
                                          const TypeInfo* expected, const std::function<void()>& know_types);

/// Who has the first word of a path or a topic: "//my-robot/laser" and "/my_robot/laser" are both of "my-robot".
[[nodiscard]] std::optional<WireMember> MemberOfPath(const DiscoveryTable& table, const std::string& path);
/// What others offer below the first word of a path: "//camera_box/camera/image".
[[nodiscard]] std::vector<std::string> OfferedBeside(const DiscoveryTable& table, const std::string& path);

/// What is said on the wire of plain numbers: "runnel_unit=deg;"; "" of others.
[[nodiscard]] std::string UnitText(const std::string& unit);

/// The topic that stands for a port where nobody says another: "/base/laser/scan" for the port "/base/laser/output/scan"
/// of the application that is called "base" in the network. What no name in ROS 2 may have becomes "_".
[[nodiscard]] std::string TopicOfPort(const std::string& network_name, std::string_view port_path);
/// The same of a port of another application: "//base/laser/scan".
[[nodiscard]] std::string TopicOfDistantPath(std::string_view path);

/// "/scan" for "rt/scan"; what is no topic of ROS 2 as it is.
[[nodiscard]] std::string ReadableTopic(std::string_view wire_topic);

}  // namespace runnel
