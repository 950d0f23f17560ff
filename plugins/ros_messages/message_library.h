#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "plugins/ros_messages/message_definition.h"

namespace runnel {

class TypeInfo;

/// The messages that are known: those of ROS 2's own packages (as in Jazzy), and what is read or added.
///
/// Threads: as a container. Definitions stay where they are as long as the library lives.
class MessageLibrary {
 public:
  /// Those of ROS 2. Made at the first call; any thread.
  static const MessageLibrary& Standard();
  /// Begins with those of ROS 2.
  MessageLibrary() : MessageLibrary(Standard()) {}

  /// Reads a .msg file in a folder <package>/msg, a .srv file in <package>/srv (requests and responses are messages,
  /// "<package>/srv/<name>_Request"), or all such files below a folder, and checks that the messages inside are known. Errors: with file and line; nothing has been added then.
  Result<void> Read(const std::filesystem::path& file_or_folder);
  /// Errors: there is another of that name.
  Result<void> Add(MessageDefinition definition);
  /// The message that describes a type of Runnel (MessageNameOf()), and those inside. Errors: a part is opaque, or there is
  /// another of a name.
  Result<const MessageDefinition*> AddDescribed(const TypeInfo& type);

  /// By "sensor_msgs/msg/LaserScan" or "sensor_msgs/LaserScan"; nullptr if there is none.
  [[nodiscard]] const MessageDefinition* Find(std::string_view name) const;
  /// Errors: there is none, with the nearest name.
  [[nodiscard]] Result<const MessageDefinition*> Get(std::string_view name) const;
  /// The messages inside of one another, without itself, sorted by name. Precondition: they are known.
  [[nodiscard]] std::vector<const MessageDefinition*> InsideOf(const MessageDefinition& definition) const;
  [[nodiscard]] std::vector<const MessageDefinition*> All() const;

 private:
  struct Empty {};
  explicit MessageLibrary(Empty /*tag*/) {}
  static MessageLibrary MakeStandard();
  Result<void> CheckInside(const MessageDefinition& definition, const std::string& file) const;

  std::map<std::string, MessageDefinition, std::less<>> definitions_;
};

/// "RIHS01_" and 64 digits: the hash by which ROS 2 tells versions of a message apart. Precondition: the messages
/// inside are known.
[[nodiscard]] std::string TypeHashOf(const MessageDefinition& definition, const MessageLibrary& library);

/// What a type of Runnel is called as a message, of which the package is `runnel_msgs`: "runnel_msgs/msg/PlannerStatus" for
/// "PlannerStatus", "runnel_msgs/msg/Pose2List" for "Pose2[]". A type whose name is that of a message
/// ("sensor_msgs/msg/Imu") keeps it, and numbers and texts are those of std_msgs.
///
/// The fields are those of the description, with the same octets as WriteCdr() has (plugins/cdr_values): enumerations are
/// numbers, lists in lists are messages of their own, units and meanings stand in comments.
/// MessageLibrary::AddDescribed() makes it.
[[nodiscard]] std::string MessageNameOf(const TypeInfo& type);

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
