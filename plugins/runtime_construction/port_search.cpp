#include "plugins/runtime_construction/port_search.h"

#include <algorithm>
#include <utility>

#include "core/base/nearest_name.h"
#include "plugins/runtime_construction/path_walk.h"

namespace runnel {

namespace {

bool Suits(const Port& port, ConnectionEnd end) {
  const bool sends = port.direction() == Port::Direction::kOutput;
  return port.is_proxy() || sends == (end == ConnectionEnd::kFrom);
}

// The ports of a module, whatever groups they are in; of a group, its interface.
std::vector<Port*> PortsOf(const FrameworkElement& element) {
  std::vector<Port*> ports;
  for (FrameworkElement* child : element.children()) {
    if (auto* port = dynamic_cast<Port*>(child)) ports.push_back(port);
    if (child->kind() != ElementKind::kPortGroup) continue;
    for (FrameworkElement* inner : child->children()) {
      if (auto* port = dynamic_cast<Port*>(inner)) ports.push_back(port);
    }
  }
  return ports;
}

std::vector<std::string> NamesOf(const std::vector<Port*>& ports, ConnectionEnd end) {
  std::vector<std::string> names;
  for (const Port* port : ports) {
    if (Suits(*port, end)) names.push_back(port->name());
  }
  return names;
}

std::vector<Port*> Named(std::vector<Port*> ports, std::string_view name) {
  std::erase_if(ports, [&](const Port* port) { return port->name() != name; });
  return ports;
}

// What a path comes to without anybody being told.
struct Found {
  Port* port = nullptr;
  Port* rival = nullptr;  // suits as well
};

Found Find(const PathWalk& walk, ConnectionEnd end) {
  if (walk.missing().empty()) return {dynamic_cast<Port*>(&walk.at())};
  if (walk.at().kind() != ElementKind::kModule || !walk.misses_only_the_last()) return {};
  std::vector<Port*> ports = Named(PortsOf(walk.at()), walk.missing());
  // If none suits, any will do: connecting says why not.
  std::ranges::stable_partition(ports, [&](const Port* port) { return Suits(*port, end); });
  if (ports.empty()) return {};
  const bool is_ambiguous = ports.size() > 1 && Suits(*ports[1], end);
  return {ports[0], is_ambiguous ? ports[1] : nullptr};
}

void ReportNoPort(const PathWalk& walk, ConnectionEnd end, BuildContext& context) {
  const std::vector<std::string> names = NamesOf(PortsOf(walk.at()), end);
  std::string hint = end == ConnectionEnd::kFrom ? "it has no outputs" : "it has no inputs";
  if (!names.empty()) hint = "write one of its ports after it, like '" + names.front() + "'";
  walk.Report({.message = walk.at().path() + " is not a port", .hint = std::move(hint)}, context);
}

void ReportMissing(const PathWalk& walk, ConnectionEnd end, BuildContext& context) {
  const bool wants_port = walk.at().kind() == ElementKind::kModule && walk.misses_only_the_last();
  walk.ReportMissing(wants_port ? NamesOf(PortsOf(walk.at()), end) : ChildNames(walk.at()),
                     context);
}

// A connection does not come about: what it was meant for is a module that the path goes into, or
// whatever its name comes nearest to.
void ExcuseTarget(const PathWalk& walk, BuildContext& context) {
  for (const FrameworkElement* each = &walk.at(); each != nullptr; each = each->parent()) {
    if (each->kind() == ElementKind::kModule) context.Excuse(*each);
  }
  if (walk.missing().empty()) return;
  const auto* const meant = walk.at().FindChild(NearestName(walk.missing(), ChildNames(walk.at())));
  if (meant == nullptr) return;
  const bool is_module_or_port =
      meant->kind() == ElementKind::kModule || meant->kind() == ElementKind::kPort;
  if (is_module_or_port) context.Excuse(*meant);
}

}  // namespace

Port* SearchPort(const PathUse& use, ConnectionEnd end, BuildContext& context) {
  const PathWalk walk(use);
  const Found found = Find(walk, end);
  if (found.port != nullptr && found.rival == nullptr) return found.port;
  ExcuseTarget(walk, context);
  if (found.rival != nullptr) {
    walk.Report({.message = use.path + " names more than one port",
                 .hint = "write " + found.port->path() + " or " + found.rival->path()},
                context);
  } else if (walk.missing().empty()) {
    ReportNoPort(walk, end, context);
  } else {
    ReportMissing(walk, end, context);
  }
  return nullptr;
}

Port* FindPort(const PathUse& use, ConnectionEnd end) {
  const Found found = Find(PathWalk(use), end);
  return found.rival == nullptr ? found.port : nullptr;
}

}  // namespace runnel
