#pragma once

#include <string>
#include <string_view>

namespace runnel {

/// The topic that stands for a port where nobody says another: "/base/laser/scan" for the port "/base/laser/output/scan"
/// of the application that is called "base" in the network. What no name in ROS 2 may have becomes "_".
[[nodiscard]] std::string TopicOfPort(const std::string& network_name, std::string_view port_path);
/// The same of a port of another application: "//base/laser/scan".
[[nodiscard]] std::string TopicOfDistantPath(std::string_view path);

/// "/scan" for "rt/scan"; what is no topic of ROS 2 as it is.
[[nodiscard]] std::string ReadableTopic(std::string_view wire_topic);

}  // namespace runnel
