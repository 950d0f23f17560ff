#include "plugins/ros_messages/node_messages.h"

#include <algorithm>
#include <utility>

#include "core/log/log_sink.h"

namespace runnel {

// Of a message of ROS 2: 10 for debug, 20 for info, and so on.
static std::uint8_t RosLevel(LogLevel level) {
  return static_cast<std::uint8_t>(level == LogLevel::kOff ? 0 : 10 * (static_cast<int>(level) + 1));
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
