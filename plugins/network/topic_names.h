#pragma once

#include <string>
#include <string_view>

#include "core/base/result.h"

namespace runnel {

/// The topic that stands for a port where nobody says another: "/base/laser/scan" for the port "/base/laser/output/scan"
/// of the application that is called "base" in the network. What no name in ROS 2 may have becomes "_".
[[nodiscard]] std::string TopicOfPort(const std::string& network_name, std::string_view port_path);
/// The same of a port of another application: "//base/laser/scan".
[[nodiscard]] std::string TopicOfDistantPath(std::string_view path);

/// "rt/scan" for "/scan". Precondition: it has been checked.
[[nodiscard]] std::string WireTopic(std::string_view topic);
/// "/scan" for "rt/scan"; "" for what is no topic of ROS 2 nor of Runnel.
[[nodiscard]] std::string TopicIn(std::string_view wire_topic);

/// Errors: what is no name of a topic, with one that would do.
[[nodiscard]] Result<void> CheckTopic(std::string_view topic);

}  // namespace runnel
