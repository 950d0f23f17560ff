#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/clock.h"
#include "core/base/result.h"
#include "core/types/type_info.h"
#include "plugins/cdr_values/cdr_stream.h"
#include "plugins/ros_messages/message_codec.h"
#include "plugins/ros_messages/message_library.h"

namespace runnel::internal {

/// What messages call otherwise than the types of Runnel that have the same meaning (core/types/README.md).
struct MappingRule {
  std::string_view message;
  std::string_view field;   ///< of the message; "linear.x": within a nested one
  std::string_view source;  ///< a field of the value; or one of these
};
inline constexpr std::string_view kItself = ".";            ///< the value itself
inline constexpr std::string_view kInListOfOne = "[.]";     ///< the value itself, as the only element
inline constexpr std::string_view kHeadingOf = "@heading";  ///< its field `heading`, as a quaternion
inline constexpr std::string_view kLastAngleOf = "@last";   ///< of a scan
inline constexpr std::string_view kChildFrame = "@child";   ///< MessageOptions::child_frame

inline constexpr MappingRule kMappingRules[] = {
    {"geometry_msgs/msg/Pose", "position", kItself},
    {"geometry_msgs/msg/Pose", "orientation", kHeadingOf},
    {"geometry_msgs/msg/Transform", "translation", kItself},
    {"geometry_msgs/msg/Transform", "rotation", kHeadingOf},
    {"geometry_msgs/msg/TransformStamped", "transform", kItself},
    {"geometry_msgs/msg/TransformStamped", "child_frame_id", kChildFrame},
    {"geometry_msgs/msg/PoseWithCovariance", "pose", kItself},
    {"geometry_msgs/msg/TwistWithCovariance", "twist", kItself},
    {"geometry_msgs/msg/Pose2D", "theta", "heading"},
    {"geometry_msgs/msg/Twist", "linear.x", "forward"},
    {"geometry_msgs/msg/Twist", "angular.z", "turn"},
    {"nav_msgs/msg/Odometry", "pose", kItself},
    {"nav_msgs/msg/Odometry", "twist", kItself},
    {"nav_msgs/msg/Odometry", "child_frame_id", kChildFrame},
    {"nav_msgs/msg/Path", "poses", "points"},
    {"sensor_msgs/msg/LaserScan", "angle_min", "start_angle"},
    {"sensor_msgs/msg/LaserScan", "angle_max", kLastAngleOf},
    {"sensor_msgs/msg/LaserScan", "angle_increment", "angle_step"},
    {"sensor_msgs/msg/LaserScan", "range_min", "range_minimum"},
    {"sensor_msgs/msg/LaserScan", "range_max", "range_maximum"},
    {"sensor_msgs/msg/Image", "step", "row_stride"},
    {"tf2_msgs/msg/TFMessage", "transforms", kInListOfOne},
};

/// What values of a meaning become if nobody says otherwise.
struct DefaultMessage {
  std::string_view semantic_tag;
  std::string_view message;
};
inline constexpr DefaultMessage kDefaultMessages[] = {
    {"point", "geometry_msgs/msg/PointStamped"},
    {"pose", "geometry_msgs/msg/PoseStamped"},
    {"twist", "geometry_msgs/msg/Twist"},
    {"range_scan", "sensor_msgs/msg/LaserScan"},
    {"path", "nav_msgs/msg/Path"},
    {"image", "sensor_msgs/msg/Image"},
    {"world_map", "nav_msgs/msg/OccupancyGrid"},
};

/// One thing of a message, in the message's order, and where in the value it comes from.
struct Step {
  enum class Kind : std::uint8_t {
    kPlain,      ///< the octets are those of the value's part by its description
    kNumber,     ///< a number of one type in the message, of another in the value
    kStructure,  ///< `inside`
    kElements,   ///< a list in both; inside[0] is an element
    kElement,    ///< that of a list in the message that `index` says; inside[0] is what becomes of it: read only
    kListOfOne,  ///< a list in the message, of which the value is the one element: written only
    kHeading,    ///< a quaternion in the message, an angle about z in the value
    kLastAngle,  ///< of a scan: that of its last ray; computed from the value, skipped in the message
    kStamp,      ///< of the header: not in the value
    // What the value does not have: written as the message's default, skipped when it is read.
    kNoNumber,
    kNoText,  ///< `text`
    kNoList,  ///< `inside`: the elements by default
  };

  Kind kind = Kind::kStructure;
  MessageType type = MessageType::kInt8;  ///< of numbers; of texts kString or kWideString
  MessageCount count = MessageCount::kOne;
  bool is_own_stamp = false;         ///< that of the message's own header
  std::size_t capacity = 0;          ///< of lists
  std::size_t index = 0;             ///< of kElement
  const FieldInfo* field = nullptr;  ///< of the value in which the step stands; nullptr: that value itself
  const TypeInfo* part = nullptr;    ///< the type of what the step is about; nullptr if the value has nothing of it
  std::string name = {};             ///< of the message's field
  long double number = 0;
  std::string text = {};
  std::vector<Step> inside = {};
  std::vector<Step> element = {};  ///< of lists: one, as if the value had nothing of it; else none
};

/// The fewest octets that it takes in a message.
[[nodiscard]] std::size_t FewestOctets(const Step& step);

// Steps of what the value does not have.

/// What the message has by default. Errors: a nested message is not known.
Result<Step> DefaultStep(const MessageField& field, const MessageLibrary& library);
Step NumberStep(MessageType type, long double number);
Step TextStep(std::string text);
Step StampStep(bool is_own);
/// Stamp and frame.
Step HeaderStep(bool is_own, const std::string& frame);

/// One element of a list.
[[nodiscard]] MessageField One(MessageField field);

void WriteBySteps(const Step& root, const void* value, Time stamp, CdrWriter& writer);

/// `fresh`: a value as the type makes it, for what is missing at the end. `stamp` is set if the message has one.
Result<void> ReadBySteps(const Step& root, CdrReader& reader, const void* fresh, void* value,
                         std::optional<Time>& stamp);

/// How all of a message is made of a value and the other way round.
struct Binding {
  Step root;
  std::vector<std::string> left_out;
  std::string why_no_decoding;
};

/// Errors: as MessageCodec::Make().
Result<Binding> Bind(const MessageDefinition& definition, const TypeInfo& type, const MessageOptions& options,
                     const MessageLibrary& library);

/// The same of one field of a message only, "pose.pose.position" or "ranges[0]": what stands before it is passed over, and what
/// comes after it is not looked at. It can be read only.
/// Errors: also, there is no such field, with the nearest name, or no such element.
Result<Binding> BindField(const MessageDefinition& definition, const TypeInfo& type, const MessageOptions& options,
                          const MessageLibrary& library);
/// Of a field by itself, wherever it stands. Errors: it does not become the type.
Result<Binding> BindPart(const MessageField& field, const TypeInfo& type, const MessageOptions& options,
                         const MessageLibrary& library);

/// Whether the type's own description has the same octets.
[[nodiscard]] bool IsSame(const MessageField& field, const TypeInfo& type, const MessageLibrary& library);

}  // namespace runnel::internal
