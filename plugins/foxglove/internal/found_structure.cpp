#include "plugins/foxglove/internal/found_structure.h"

#include <algorithm>

#include "plugins/foxglove_schemas/foxglove_topics.h"

namespace runnel::internal {

namespace {

const FrameworkElement& OwnerOf(const FrameworkElement& port) {
  const FrameworkElement* owner = port.parent();
  while (owner->kind() == ElementKind::kPortGroup && owner->parent() != nullptr) {
    owner = owner->parent();
  }
  return *owner;
}

FoundPort FoundOf(const Port& port) {
  const bool is_output = port.direction() == Port::Direction::kOutput;
  FoundPort found{port.path(),
                  TopicOf(port),
                  &port.type(),
                  is_output || port.is_proxy(),
                  !is_output,
                  OwnerOf(port).path(),
                  {}};
  if (!found.is_shown) return found;
  for (const Port* sink : port.Sinks()) found.readers.push_back(OwnerOf(*sink).path());
  std::ranges::sort(found.readers);
  found.readers.erase(std::unique(found.readers.begin(), found.readers.end()), found.readers.end());
  return found;
}

void Collect(FrameworkElement& element, FoundStructure& found, std::vector<const Port*>& ports) {
  if (element.FindAnnotation<BroughtByClient>() != nullptr) return;
  if (const auto* const port = dynamic_cast<const Port*>(&element)) {
    found.ports.push_back(FoundOf(*port));
    ports.push_back(port);
  } else if (const auto* const parameter = dynamic_cast<const Configurable*>(&element)) {
    found.parameters.push_back({element.path(), TopicOf(element), &parameter->type(), parameter});
  }
  for (FrameworkElement* child : element.children()) Collect(*child, found, ports);
}

}  // namespace

FoundStructure FindStructure(Runtime& runtime) {
  FoundStructure found;
  found.revision = runtime.revision();
  std::vector<const Port*> ports;
  Collect(runtime.root(), found, ports);
  if (const Port* const pose = RobotPose(ports)) {
    found.robot_pose = static_cast<std::size_t>(std::ranges::find(ports, pose) - ports.begin());
  }
  return found;
}

}  // namespace runnel::internal
