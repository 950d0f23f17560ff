#include "plugins/scheduling/internal/data_flow.h"

#include <map>

namespace runnel::internal {

namespace {

using ReadersOfGroups = std::map<const FrameworkElement*, std::vector<std::size_t>>;

// Only looked up, never walked through: the order of addresses has no influence.
ReadersOfGroups FindReaders(const std::vector<Task>& tasks) {
  ReadersOfGroups readers;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    for (const FrameworkElement* group : tasks[i].reads) {
      if (group != nullptr) readers[group].push_back(i);
    }
  }
  return readers;
}

}  // namespace

void VisitPorts(const FrameworkElement& group, const std::function<void(Port&)>& visit) {
  for (FrameworkElement* child : group.children()) {
    if (auto* const port = dynamic_cast<Port*>(child)) visit(*port);
    VisitPorts(*child, visit);
  }
}

std::vector<DataEdge> FindDataEdges(const std::vector<Task>& tasks) {
  const ReadersOfGroups readers = FindReaders(tasks);
  std::vector<DataEdge> edges;
  const auto add_edges = [&](std::size_t from, Port& output, Port& input) {
    for (const FrameworkElement* at = &input; at != nullptr; at = at->parent()) {
      const auto found = readers.find(at);
      if (found == readers.end()) continue;
      for (const std::size_t to : found->second) edges.push_back({from, to, &output, &input});
    }
  };
  for (std::size_t from = 0; from < tasks.size(); ++from) {
    for (const FrameworkElement* group : tasks[from].writes) {
      if (group == nullptr) continue;
      VisitPorts(*group, [&](Port& output) {
        if (output.is_proxy() || output.direction() != Port::Direction::kOutput) return;
        for (Port* input : output.Sinks()) add_edges(from, output, *input);
      });
    }
  }
  return edges;
}

}  // namespace runnel::internal
