#pragma once

#include <string_view>

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

}  // namespace runnel::internal
