#include "plugins/ros_messages/node_messages.h"

#include "core/log/log_sink.h"
#include "plugins/ros_messages/parameter_messages.h"

namespace runnel {

RosLog ToRosLog(const LogMessage& said, Time stamp) {
  RosLog log{
      .stamp = stamp, .name = RosParameterName("", said.path), .msg = said.TextWithCount(), .file = {}, .function = {}};
  // 10 for debug, 20 for info, and so on.
  log.level = static_cast<std::uint8_t>(said.level == LogLevel::kOff ? 0 : 10 * (static_cast<int>(said.level) + 1));
  return log;
}

}  // namespace runnel
