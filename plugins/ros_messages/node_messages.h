#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/clock.h"
#include "core/log/log_level.h"
#include "core/types/type_builder.h"

namespace runnel {

struct LogMessage;

/// Messages about an application: what it says, how it is, where its parts are. Each is a structure with the fields of
/// the message of ROS 2, so that MessageCodec writes and reads it `as` that message; stamps count from 1970, or from the
/// begin of simulated time.

/// rcl_interfaces/msg/Log, of the topic /rosout (FindQuality("rosout")).
struct RosLog {
  Time stamp{};
  std::uint8_t level = 20;  ///< 10 debug, 20 info, 30 warning, 40 error, 50 fatal
  std::string name;         ///< who says it, by words with '.' between
  std::string msg;
  std::string file;
  std::string function;
  std::uint32_t line = 0;
};
/// What `level` of such a message is.
[[nodiscard]] std::uint8_t RosLevel(LogLevel level);
[[nodiscard]] RosLog ToRosLog(const LogMessage& said, Time stamp);

struct RosHeader {
  Time stamp{};
  std::string frame_id;
};

struct RosKeyValue {
  std::string key;
  std::string value;
};

enum class RosHealth : std::uint8_t { kOk, kWarning, kError, kStale };

struct RosDiagnosticStatus {
  RosHealth level = RosHealth::kOk;
  std::string name;     ///< "application: planner"
  std::string message;  ///< in a few words
  std::string hardware_id;
  std::vector<RosKeyValue> values;
};

/// diagnostic_msgs/msg/DiagnosticArray, of the topic /diagnostics, once a second.
struct RosDiagnostics {
  RosHeader header;
  std::vector<RosDiagnosticStatus> status;
};

struct RosVector3 {
  double x = 0, y = 0, z = 0;
};
struct RosQuaternion {
  double x = 0, y = 0, z = 0, w = 1;
};
struct RosTransform {
  RosVector3 translation;
  RosQuaternion rotation;
};
struct RosTransformStamped {
  RosHeader header;  ///< of the frame in which the other is
  std::string child_frame_id;
  RosTransform transform;
};

/// tf2_msgs/msg/TFMessage, of the topics /tf and /tf_static (FindQuality("latched")).
struct RosTransforms {
  std::vector<RosTransformStamped> transforms;
};
/// The frame `child` at a place in the plane of `frame`; m, rad.
[[nodiscard]] RosTransformStamped ToRosTransform(Time stamp, std::string frame, std::string child, double x,
                                                 double y, double heading);

void Describe(TypeBuilder<RosLog>& type);
void Describe(TypeBuilder<RosHeader>& type);
void Describe(TypeBuilder<RosKeyValue>& type);
void Describe(TypeBuilder<RosHealth>& type);
void Describe(TypeBuilder<RosDiagnosticStatus>& type);
void Describe(TypeBuilder<RosDiagnostics>& type);
void Describe(TypeBuilder<RosVector3>& type);
void Describe(TypeBuilder<RosQuaternion>& type);
void Describe(TypeBuilder<RosTransform>& type);
void Describe(TypeBuilder<RosTransformStamped>& type);
void Describe(TypeBuilder<RosTransforms>& type);

}  // namespace runnel
