#include "plugins/network_discovery/topic_names.h"

#include "plugins/ros_messages/names.h"
#include "plugins/values/port_patterns.h"

namespace runnel {

std::string TopicOfPort(const std::string& network_name, std::string_view port_path) {
  return NearestRosName("/" + network_name + ShortPortPath(port_path));
}

std::string TopicOfDistantPath(std::string_view path) {
  path.remove_prefix(1);
  return NearestRosName(PlainPortPath(path));
}

std::string ReadableTopic(std::string_view wire_topic) {
  const std::string topic = RosTopic(wire_topic);
  return topic.empty() ? std::string(wire_topic) : topic;
}

}  // namespace runnel
