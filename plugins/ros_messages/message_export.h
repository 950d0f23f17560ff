#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "plugins/ros_messages/message_library.h"

namespace runnel {

/// What files are to have, by their paths below a folder.
using FileTexts = std::map<std::string, std::string>;

/// A package of ROS 2 with the messages, which are all of one package: package.xml, CMakeLists.txt, msg/*.msg. Built by
/// colcon, it makes what Runnel writes known to ros2 topic echo, RViz and nodes.
[[nodiscard]] FileTexts MessagePackageOf(const std::vector<const MessageDefinition*>& messages,
                                         const MessageLibrary& library);

/// A C++ header for each message and for those inside, sensor_msgs/imu.h with sensor_msgs::Imu: a structure and its
/// description, so that ports carry it. Its octets are those of the message.
/// Errors: a message with wide strings, or one without fields (runnel::Signal is there for that).
[[nodiscard]] Result<FileTexts> CppHeadersOf(const std::vector<const MessageDefinition*>& messages,
                                             const MessageLibrary& library);

}  // namespace runnel
