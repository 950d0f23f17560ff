#include "plugins/network/topic_names.h"

#include <algorithm>

#include "core/element/element_path.h"
#include "plugins/values/port_patterns.h"

namespace runnel {

namespace {

constexpr std::string_view kPrefix = "rt";
constexpr std::size_t kLongest = 247;

bool IsDigit(char each) { return each >= '0' && each <= '9'; }
bool IsAllowed(char each) {
  return (each >= 'a' && each <= 'z') || (each >= 'A' && each <= 'Z') || IsDigit(each) || each == '_';
}

std::string NearestTopic(std::string_view topic) {
  std::string name;
  for (const std::string_view word : SplitPath(topic)) {
    if (word.empty()) continue;
    name += '/';
    if (IsDigit(word.front())) name += '_';
    for (const char each : word) name += IsAllowed(each) ? each : '_';
  }
  return name.empty() ? "/topic" : name.substr(0, kLongest);
}

}  // namespace

std::string TopicOfPort(const std::string& network_name, std::string_view port_path) {
  return NearestTopic(network_name + ShortPortPath(port_path));
}

std::string TopicOfDistantPath(std::string_view path) { return NearestTopic(path); }

std::string WireTopic(std::string_view topic) { return std::string(kPrefix) + std::string(topic); }

std::string TopicIn(std::string_view wire_topic) {
  return wire_topic.starts_with(std::string(kPrefix) + "/") ? std::string(wire_topic.substr(kPrefix.size())) : "";
}

Result<void> CheckTopic(std::string_view topic) {
  const std::string nearest = NearestTopic(topic);
  if (topic == nearest) return {};
  return Error{.message = "'" + std::string(topic) +
                          "' is no name of a topic: '/', then words of letters, digits and '_' divided by '/', none of "
                          "which begins with a digit",
               .hint = "did you mean '" + nearest + "'?"};
}

}  // namespace runnel
