#include "plugins/values/foxglove_topics.h"

#include <vector>

#include "core/types/type_info.h"

namespace runnel {

std::string TopicOf(const FrameworkElement& element) {
  std::vector<const std::string*> names;
  for (const FrameworkElement* at = &element; at->parent() != nullptr; at = at->parent()) {
    if (at->kind() != ElementKind::kPortGroup) names.push_back(&at->name());
  }
  if (names.size() > 1) names.pop_back();  // the application
  std::string topic;
  for (auto name = names.rbegin(); name != names.rend(); ++name) topic += "/" + **name;
  return topic;
}

const Port* RobotPose(std::span<const Port* const> ports) {
  const Port* best = nullptr;
  std::size_t most = 0;
  for (const Port* port : ports) {
    if (port->is_proxy() || port->direction() != Port::Direction::kOutput) continue;
    if (port->type().semantic_tag() != "pose") continue;
    const std::size_t readers = port->Sinks().size();
    if (best != nullptr && readers <= most) continue;
    best = port;
    most = readers;
  }
  return best;
}

}  // namespace runnel
