#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/clock.h"
#include "core/log/log_sink.h"
#include "core/types/type_of.h"
#include "plugins/ros_messages/parameter_messages.h"

namespace runnel {

/// Messages about an application: what it says, and how it is. Each is a structure with the fields of
/// the message of ROS 2, so that MessageCodec writes and reads it `as` that message; stamps count from 1970, or from the
/// begin of simulated time.

/// rcl_interfaces/msg/Log, of the topic /rosout.
struct RosLog {
  Time stamp{};
  std::uint8_t level = 20;  ///< 10 debug, 20 info, 30 warning, 40 error, 50 fatal
  std::string name;         ///< who says it, by words with '.' between
  std::string msg;
  std::string file;
  std::string function;
  std::uint32_t line = 0;
};

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

// Names with a dot: whoever describes a type of the same message has its name to himself.
inline void Describe(TypeBuilder<RosLog>& type) {
  type.Name("ros.Log")
      .Fields<&RosLog::stamp, &RosLog::level, &RosLog::name, &RosLog::msg, &RosLog::file, &RosLog::function,
              &RosLog::line>();
}
inline void Describe(TypeBuilder<RosHeader>& type) {
  type.Name("ros.Header").Fields<&RosHeader::stamp, &RosHeader::frame_id>();
}
inline void Describe(TypeBuilder<RosKeyValue>& type) {
  type.Name("ros.KeyValue").Fields<&RosKeyValue::key, &RosKeyValue::value>();
}
inline void Describe(TypeBuilder<RosHealth>& type) {
  type.Name("ros.Health").Values<RosHealth::kOk, RosHealth::kWarning, RosHealth::kError, RosHealth::kStale>();
}
inline void Describe(TypeBuilder<RosDiagnosticStatus>& type) {
  type.Name("ros.DiagnosticStatus")
      .Fields<&RosDiagnosticStatus::level, &RosDiagnosticStatus::name, &RosDiagnosticStatus::message,
              &RosDiagnosticStatus::hardware_id, &RosDiagnosticStatus::values>();
}
inline void Describe(TypeBuilder<RosDiagnostics>& type) {
  type.Name("ros.Diagnostics").Fields<&RosDiagnostics::header, &RosDiagnostics::status>();
}

[[nodiscard]] inline RosLog ToRosLog(const LogMessage& said, Time stamp) {
  RosLog log{
      .stamp = stamp, .name = RosParameterName("", said.path), .msg = said.TextWithCount(), .file = {}, .function = {}};
  // 10 for debug, 20 for info, and so on.
  log.level = static_cast<std::uint8_t>(said.level == LogLevel::kOff ? 0 : 10 * (static_cast<int>(said.level) + 1));
  return log;
}

}  // namespace runnel
