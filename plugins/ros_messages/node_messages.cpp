#include "plugins/ros_messages/node_messages.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/log/log_message.h"
#include "core/types/type_of.h"

namespace runnel {

namespace {

}  // namespace

std::uint8_t RosLevel(LogLevel level) {
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

RosTransformStamped ToRosTransform(Time stamp, std::string frame, std::string child, double x, double y,
                                   double heading) {
  return {.header = {.stamp = stamp, .frame_id = std::move(frame)},
          .child_frame_id = std::move(child),
          .transform = {.translation = {.x = x, .y = y},
                        .rotation = {.z = std::sin(heading / 2), .w = std::cos(heading / 2)}}};
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
void Describe(TypeBuilder<RosVector3>& type) {
  type.Name("ros.Vector3")
      .Field("x", &RosVector3::x, {.unit = "m"})
      .Field("y", &RosVector3::y, {.unit = "m"})
      .Field("z", &RosVector3::z, {.unit = "m"});
}
void Describe(TypeBuilder<RosQuaternion>& type) {
  type.Name("ros.Quaternion")
      .Field("x", &RosQuaternion::x)
      .Field("y", &RosQuaternion::y)
      .Field("z", &RosQuaternion::z)
      .Field("w", &RosQuaternion::w);
}
void Describe(TypeBuilder<RosTransform>& type) {
  type.Name("ros.Transform")
      .Field("translation", &RosTransform::translation)
      .Field("rotation", &RosTransform::rotation);
}
void Describe(TypeBuilder<RosTransformStamped>& type) {
  type.Name("ros.TransformStamped")
      .Field("header", &RosTransformStamped::header)
      .Field("child_frame_id", &RosTransformStamped::child_frame_id)
      .Field("transform", &RosTransformStamped::transform);
}
void Describe(TypeBuilder<RosTransforms>& type) {
  type.Name("ros.Transforms").Field("transforms", &RosTransforms::transforms);
}

}  // namespace runnel
