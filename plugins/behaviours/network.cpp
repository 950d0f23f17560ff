#include "plugins/behaviours/network.h"

#include <algorithm>
#include <functional>
#include <map>
#include <set>

#include "core/port/input_base.h"
#include "plugins/scheduling/thread_container.h"

namespace runnel {

namespace {

using Places = std::map<const Behaviour*, std::size_t>;

Places PlacesOf(const std::vector<Behaviour*>& behaviours) {
  Places places;
  for (std::size_t i = 0; i < behaviours.size(); ++i) places[behaviours[i]] = i;
  return places;
}

const Behaviour* OwnerOf(const FrameworkElement& port) {
  for (const FrameworkElement* at = &port; at != nullptr; at = at->parent()) {
    if (const auto* const behaviour = dynamic_cast<const Behaviour*>(at)) return behaviour;
  }
  return nullptr;
}

void AddOnce(std::vector<std::size_t>& list, std::size_t place) {
  if (std::ranges::find(list, place) == list.end()) list.push_back(place);
}

bool IsFedBy(const Port& port, const Port& source) {
  const auto sources = port.Sources();
  return std::ranges::find(sources, &source) != sources.end();
}

// Whether a connection by which `source` feeds the port, through whatever groups, is late.
bool IsLate(const Port& port, const Port& source) {
  for (const Port* const from : port.incoming()) {
    const bool is_late = from->IsLateTo(port);
    if ((from == &source && is_late) ||
        (from->is_proxy() && IsFedBy(*from, source) && (is_late || IsLate(*from, source))))
      return true;
  }
  return false;
}

void AddLateSources(const Port& port, const Places& places, NetworkNode& node) {
  for (const Port* const source : port.Sources()) {
    const auto place = places.find(OwnerOf(*source));
    if (place == places.end()) continue;
    if (AssignedThread(*place->first) != AssignedThread(*node.behaviour)) {
      AddOnce(node.elsewhere, place->second);
    } else if (IsLate(port, *source)) {
      AddOnce(node.late, place->second);
    }
  }
}

// The behaviours that feed the port. True: something else does, too.
bool AddSources(const Port& port, const Places& places, std::vector<std::size_t>& sources) {
  bool is_foreign = false;
  for (const Port* const source : port.Sources()) {
    const auto place = places.find(OwnerOf(*source));
    if (place != places.end()) {
      AddOnce(sources, place->second);
    } else {
      is_foreign = true;
    }
  }
  return is_foreign;
}

std::string NameOf(const Behaviour& behaviour, const FrameworkElement& application) {
  const std::string& path = behaviour.path();
  return path.starts_with(application.path() + "/") ? path.substr(application.path().size() + 1) : path;
}

// Ports whose activities decide; if something else comes there, nothing is known.
std::vector<std::size_t> SourcesOfAll(const std::vector<const Port*>& ports, const Places& places) {
  std::vector<std::size_t> sources;
  for (const Port* const each : ports) {
    if (AddSources(*each, places, sources)) return {};
  }
  return sources;
}

NetworkNode ReadNode(Behaviour& behaviour, const FrameworkElement& application, const Places& places) {
  NetworkNode node{
      .behaviour = &behaviour, .name = NameOf(behaviour, application), .mode = behaviour.stimulation_mode.Get()};
  if (node.mode == StimulationMode::kAuto) {
    node.has_foreign_stimulation = AddSources(behaviour.stimulation, places, node.stimulators);
  }
  for (std::size_t i = 0; i < behaviour.inhibition_count(); ++i) {
    (void)AddSources(behaviour.inhibition(i), places, node.inhibitors);
  }
  const ActivityNeeds needs = behaviour.Needs();
  for (const Port* const each : needs.all_of) {
    const auto sources = SourcesOfAll({each}, places);
    if (sources.size() == 1) AddOnce(node.needs_all, sources.front());
  }
  node.needs_any = SourcesOfAll(needs.any_of, places);
  AddLateSources(behaviour.stimulation, places, node);
  for (std::size_t i = 0; i < behaviour.inhibition_count(); ++i) AddLateSources(behaviour.inhibition(i), places, node);
  for (const auto* const list : {&needs.all_of, &needs.any_of}) {
    for (const Port* const each : *list) AddLateSources(*each, places, node);
  }
  return node;
}

// Those that it depends on come first, as far as there is no loop.
std::vector<Behaviour*> InOrder(std::vector<Behaviour*> behaviours, const FrameworkElement& application) {
  const Places places = PlacesOf(behaviours);
  std::vector<Behaviour*> ordered;
  std::set<std::size_t> visited;
  const std::function<void(std::size_t)> visit = [&](std::size_t place) {
    if (!visited.insert(place).second) return;
    const NetworkNode node = ReadNode(*behaviours[place], application, places);
    for (const auto* const list : {&node.stimulators, &node.inhibitors, &node.needs_all, &node.needs_any}) {
      for (const std::size_t each : *list) visit(each);
    }
    ordered.push_back(behaviours[place]);
  };
  for (std::size_t i = 0; i < behaviours.size(); ++i) visit(i);
  return ordered;
}

void ReadActuators(FrameworkElement& application, const Places& places, BehaviourNetwork& network) {
  application.VisitAll<const InputBase>([&](const InputBase& input) {
    if (OwnerOf(input) != nullptr) return;
    SharedActuator actuator{.path = input.path(), .behaviours = {}};
    (void)AddSources(input, places, actuator.behaviours);
    if (actuator.behaviours.size() > 1) network.shared.push_back(std::move(actuator));
  });
}

}  // namespace

BehaviourNetwork ReadNetwork(FrameworkElement& application) {
  std::vector<Behaviour*> behaviours;
  application.VisitAll<Behaviour>([&](Behaviour& behaviour) { behaviours.push_back(&behaviour); });
  behaviours = InOrder(std::move(behaviours), application);
  const Places places = PlacesOf(behaviours);
  BehaviourNetwork network;
  for (Behaviour* const each : behaviours) network.nodes.push_back(ReadNode(*each, application, places));
  ReadActuators(application, places, network);
  return network;
}

}  // namespace runnel
