#pragma once

#include <string>

namespace runnel {

class TypeInfo;

/// What a type of Runnel is called as a message, of which the package is `runnel_msgs`: "runnel_msgs/msg/PlannerStatus" for
/// "PlannerStatus", "runnel_msgs/msg/Pose2List" for "Pose2[]". A type whose name is that of a message
/// ("sensor_msgs/msg/Imu") keeps it, and numbers and texts are those of std_msgs.
///
/// The fields are those of the description, with the same octets as WriteCdr() has (plugins/cdr_values): enumerations are
/// numbers, lists in lists are messages of their own, units and meanings stand in comments.
/// MessageLibrary::AddDescribed() makes it.
[[nodiscard]] std::string MessageNameOf(const TypeInfo& type);

}  // namespace runnel
