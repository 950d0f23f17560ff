#include "plugins/ros_messages/node_messages.h"

#include <algorithm>
#include <utility>

#include "core/log/log_sink.h"
#include "core/types/type_of.h"

namespace runnel {

// Of a message of ROS 2.
static std::uint8_t RosLevel(LogLevel level) {
  switch (level) {
    case LogLevel::kDebug:
      return 10;
    case LogLevel::kInfo:
      return 20;
    case LogLevel::kWarning:
      return 30;
    case LogLevel::kError:
      return 40;
    case LogLevel::kOff:
      break;
  }
  return 0;
}

RosLog ToRosLog(const LogMessage& said, Time stamp) {
  std::string name = said.path;
  if (name.starts_with('/')) name.erase(0, 1);
  std::ranges::replace(name, '/', '.');
  RosLog log{.stamp = stamp, .name = std::move(name), .msg = said.TextWithCount(), .file = {}, .function = {}};
  log.level = RosLevel(said.level);
  return log;
}

// Names with a dot: whoever describes a type of the same message has its name to himself.
void Describe(TypeBuilder<RosLog>& type) {
  type.Name("ros.Log")
      .Field("stamp", &RosLog::stamp)
      .Field("level", &RosLog::level)
      .Field("name", &RosLog::name)
      .Field("msg", &RosLog::msg)
      .Field("file", &RosLog::file)
      .Field("function", &RosLog::function)
      .Field("line", &RosLog::line);
}
void Describe(TypeBuilder<RosHeader>& type) {
  type.Name("ros.Header").Field("stamp", &RosHeader::stamp).Field("frame_id", &RosHeader::frame_id);
}
void Describe(TypeBuilder<RosKeyValue>& type) {
  type.Name("ros.KeyValue").Field("key", &RosKeyValue::key).Field("value", &RosKeyValue::value);
}
void Describe(TypeBuilder<RosHealth>& type) {
  type.Name("ros.Health")
      .Value("ok", RosHealth::kOk)
      .Value("warning", RosHealth::kWarning)
      .Value("error", RosHealth::kError)
      .Value("stale", RosHealth::kStale);
}
void Describe(TypeBuilder<RosDiagnosticStatus>& type) {
  type.Name("ros.DiagnosticStatus")
      .Field("level", &RosDiagnosticStatus::level)
      .Field("name", &RosDiagnosticStatus::name)
      .Field("message", &RosDiagnosticStatus::message)
      .Field("hardware_id", &RosDiagnosticStatus::hardware_id)
      .Field("values", &RosDiagnosticStatus::values);
}
void Describe(TypeBuilder<RosDiagnostics>& type) {
  type.Name("ros.Diagnostics")
      .Field("header", &RosDiagnostics::header)
      .Field("status", &RosDiagnostics::status);
}

}  // namespace runnel
