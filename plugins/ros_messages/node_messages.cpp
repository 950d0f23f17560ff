#include "plugins/ros_messages/node_messages.h"

#include <algorithm>
#include <utility>

#include "core/log/log_sink.h"

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

}  // namespace runnel
