#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/base/clock.h"
#include "core/types/type_builder.h"

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

void Describe(TypeBuilder<RosLog>& type);
void Describe(TypeBuilder<RosHeader>& type);
void Describe(TypeBuilder<RosKeyValue>& type);
void Describe(TypeBuilder<RosHealth>& type);
void Describe(TypeBuilder<RosDiagnosticStatus>& type);
void Describe(TypeBuilder<RosDiagnostics>& type);

}  // namespace runnel
