#pragma once

#include <string>
#include <string_view>

#include "core/base/result.h"

namespace runnel {

/// What things are called in ROS 2, and what that becomes in DDS. Threads: any. All of it allocates.

/// Of a topic, a service or a node with its namespace: "/", then words of A-Z a-z 0-9 _ divided by "/", none of which
/// begins with a digit; 247 characters at most.
/// Errors: what of that is hurt, and where, with a name that would do.
[[nodiscard]] Result<void> CheckRosName(std::string_view name);
/// The nearest name that is allowed: "/laser 1/scan" becomes "/laser_1/scan".
[[nodiscard]] std::string NearestRosName(std::string_view name);

/// "rt/scan" for "/scan". Preconditions here and below: the names have been checked.
[[nodiscard]] std::string DdsTopic(std::string_view topic);
/// "rq/set_pathRequest" and "rr/set_pathReply" for "/set_path".
[[nodiscard]] std::string DdsRequestTopic(std::string_view service);
[[nodiscard]] std::string DdsReplyTopic(std::string_view service);
/// "/scan" for "rt/scan"; "" for what is no topic of ROS 2.
[[nodiscard]] std::string RosTopic(std::string_view dds_topic);

/// "sensor_msgs::msg::dds_::LaserScan_" for "sensor_msgs/msg/LaserScan".
[[nodiscard]] std::string DdsType(std::string_view ros_type);
/// The way back; "" for what is no type of ROS 2.
[[nodiscard]] std::string RosType(std::string_view dds_type);

/// "sensor_msgs" and "LaserScan" of "sensor_msgs/msg/LaserScan".
[[nodiscard]] std::string PackageOf(std::string_view ros_type);
[[nodiscard]] std::string LastNameOf(std::string_view ros_type);

/// Of a package: lower-case letters, digits, single _, at least two characters, begins with a letter.
/// Of a message: CamelCase, letters and digits.
/// Of a field: lower-case letters, digits, single _, begins with a letter, does not end with _.
[[nodiscard]] bool IsRosPackageName(std::string_view name);
[[nodiscard]] bool IsRosMessageName(std::string_view name);
[[nodiscard]] bool IsRosFieldName(std::string_view name);
/// "planning::Path 2" becomes "PlanningPath2", "maxSpeed" becomes "max_speed".
[[nodiscard]] std::string NearestMessageName(std::string_view name);
[[nodiscard]] std::string NearestFieldName(std::string_view name);

}  // namespace runnel
