#include "plugins/ros_messages/node_messages.h"

#include <algorithm>
#include <utility>

#include "core/log/log_sink.h"

namespace runnel {

RosLog ToRosLog(const LogMessage& said, Time stamp) {
  std::string name = said.path;
  if (name.starts_with('/')) name.erase(0, 1);
  std::ranges::replace(name, '/', '.');
  RosLog log{.stamp = stamp, .name = std::move(name), .msg = said.TextWithCount(), .file = {}, .function = {}};
  // 10 for debug, 20 for info, and so on.
  log.level = static_cast<std::uint8_t>(said.level == LogLevel::kOff ? 0 : 10 * (static_cast<int>(said.level) + 1));
  return log;
}

}  // namespace runnel
