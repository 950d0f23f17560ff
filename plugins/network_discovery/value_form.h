#pragma once

#include <memory>
#include <string>

#include "plugins/ros_messages/message_codec.h"
#include "plugins/wire/wire.h"

namespace runnel {

/// Values of one type as octets on the wire, and back.
struct ValueForm {
  /// `as`: "sensor_msgs/msg/LaserScan"; "": by the type's own description. Errors: there is no such message; the type
  /// cannot become it; a part of the type is opaque. `messages`: which there are; nullptr: those of ROS 2.
  /// `field`: of the message, of which alone values are made (MessageOptions); nothing can be written then.
  static Result<std::shared_ptr<const ValueForm>> Make(const TypeInfo& type, const std::string& as,
                                                       const std::string& frame = {},
                                                       const std::string& child_frame = {},
                                                       const MessageLibrary* messages = nullptr,
                                                       const std::string& field = {});

  std::shared_ptr<const MessageCodec> codec;
  /// What is told of the type besides its name: two of one name fit only if this is the same, or unknown.
  std::string user_data;
};

/// What is inside of values, in one line: "{x:double[m],y:double[m]}".
[[nodiscard]] std::string DescriptionText(const TypeInfo& type);

/// What endpoints say of their messages by USER_DATA, as nodes of ROS 2 from Iron on do: "typehash=RIHS01_…;" for TypeHashOf().
[[nodiscard]] std::string TypeHashText(const std::string& hash);

/// Of the topic "/clock" and the message "rosgraph_msgs/msg/Clock" of ROS 2, with the hash of that.
[[nodiscard]] WireEndpointOptions RosEndpoint(const std::string& topic, const std::string& message, const WireQos& qos);

/// Why values of a writer cannot be read by a reader although their types have one name, from what both say of them; ""
/// if they can, as far as is known.
[[nodiscard]] std::string TypeMisfit(const std::string& writers, const std::string& readers);

/// Why they may be read wrongly: both say hashes of their messages (RIHS01), which differ. ROS 2 matches them all the same, and
/// between distributions, where fields come to an end of a message, it does no harm. "" if not.
[[nodiscard]] std::string TypeDoubt(const std::string& writers, const std::string& readers);

}  // namespace runnel
