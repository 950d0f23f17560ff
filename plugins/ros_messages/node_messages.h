#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/clock.h"
#include "core/types/type_of.h"

namespace runnel {

struct LogMessage;

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

// Names with a dot: whoever describes a type of the same message has its name to himself.
inline void Describe(TypeBuilder<RosLog>& type) {
  type.Name("ros.Log")
      .Field("stamp", &RosLog::stamp)
      .Field("level", &RosLog::level)
      .Field("name", &RosLog::name)
      .Field("msg", &RosLog::msg)
      .Field("file", &RosLog::file)
      .Field("function", &RosLog::function)
      .Field("line", &RosLog::line);
}
inline void Describe(TypeBuilder<RosHeader>& type) {
  type.Name("ros.Header").Field("stamp", &RosHeader::stamp).Field("frame_id", &RosHeader::frame_id);
}
inline void Describe(TypeBuilder<RosKeyValue>& type) {
  type.Name("ros.KeyValue").Field("key", &RosKeyValue::key).Field("value", &RosKeyValue::value);
}
inline void Describe(TypeBuilder<RosHealth>& type) {
  type.Name("ros.Health")
      .Value("ok", RosHealth::kOk)
      .Value("warning", RosHealth::kWarning)
      .Value("error", RosHealth::kError)
      .Value("stale", RosHealth::kStale);
}
inline void Describe(TypeBuilder<RosDiagnosticStatus>& type) {
  type.Name("ros.DiagnosticStatus")
      .Field("level", &RosDiagnosticStatus::level)
      .Field("name", &RosDiagnosticStatus::name)
      .Field("message", &RosDiagnosticStatus::message)
      .Field("hardware_id", &RosDiagnosticStatus::hardware_id)
      .Field("values", &RosDiagnosticStatus::values);
}
inline void Describe(TypeBuilder<RosDiagnostics>& type) {
  type.Name("ros.Diagnostics").Field("header", &RosDiagnostics::header).Field("status", &RosDiagnostics::status);
}

}  // namespace runnel
