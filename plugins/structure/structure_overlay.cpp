#include "plugins/structure/structure_overlay.h"

#include <algorithm>
#include <functional>
#include <set>

#include "core/base/nearest_name.h"
#include "core/element/element_path.h"
#include "core/port/driving_ports.h"
#include "core/port/probe_port.h"

namespace runnel::internal {

bool StructureOverlay::IsGone(const FrameworkElement& element) const {
  return std::ranges::any_of(removed_,
                             [&](const auto* gone) { return element.IsAtOrBelow(*gone); });
}

FrameworkElement* StructureOverlay::Child(const FrameworkElement& parent,
                                          std::string_view name) const {
  for (FrameworkElement* each : added_) {
    if (each->parent() == &parent && each->name() == name && !IsGone(*each)) return each;
  }
  FrameworkElement* const child = parent.FindChild(name);
  return child != nullptr && !IsGone(*child) ? child : nullptr;
}

std::vector<FrameworkElement*> StructureOverlay::Children(const FrameworkElement& parent) const {
  std::vector<FrameworkElement*> children = parent.children();
  for (FrameworkElement* each : added_) {
    if (each->parent() == &parent) children.push_back(each);
  }
  std::erase_if(children, [&](const auto* each) { return IsGone(*each); });
  return children;
}

Result<Placement> StructureOverlay::PlaceFor(std::string_view path) const {
  const std::size_t slash = path.find_last_of('/');
  const std::string name(slash == std::string_view::npos ? path : path.substr(slash + 1));
  if (auto good = CheckElementName(name); !good) return good.error().WithPath(path);
  FrameworkElement* parent = nullptr;
  if (slash == std::string_view::npos || slash == 0) {
    parent = OnlyApplication() != nullptr ? OnlyApplication() : &runtime_.root();
  } else {
    const auto found = Find(path.substr(0, slash));
    if (!found) return found.error();
    parent = *found;
  }
  if (parent->kind() != ElementKind::kGroup && parent->kind() != ElementKind::kRuntime) {
    return Error{.message = parent->path() + " is not a group, and nothing can be made in it",
                 .path = std::string(path)};
  }
  if (Child(*parent, name) != nullptr) {
    return Error{.message = "there is already an element called '" + name + "'",
                 .path = parent->path(),
                 .hint = "choose another name"};
  }
  return Placement{*parent, name, false};
}

void StructureOverlay::Add(FrameworkElement& element) { added_.push_back(&element); }

void StructureOverlay::Remove(FrameworkElement& element) {
  removed_.push_back(&element);
  std::erase_if(connected_, [&](const Edge& edge) {
    return edge.first->IsAtOrBelow(element) || edge.second->IsAtOrBelow(element);
  });
}

Result<void> StructureOverlay::Replace(FrameworkElement& gone, FrameworkElement& element,
                                       const std::vector<std::pair<Port*, Port*>>& ports) {
  for (const auto& [before, after] : ports) {
    replaced_[before] = after;
    for (auto* edges : {&connected_, &disconnected_}) {
      for (Edge& edge : *edges) {
        if (edge.first == before) edge.first = after;
        if (edge.second == before) edge.second = after;
      }
    }
  }
  removed_.push_back(&gone);
  composites_.push_back(&gone);
  Add(element);
  for (const auto& [before, after] : ports) {
    if (!IsInCycle(*after)) continue;
    return Error{.message = "in the place of " + before->path() + " it would close a cycle of interface ports", .path = after->path()};
  }
  return {};
}

Port& StructureOverlay::NowFor(Port& port) const {
  Port* now = &port;
  for (auto found = replaced_.find(now); found != replaced_.end(); found = replaced_.find(now)) {
    now = found->second;
  }
  return *now;
}

std::vector<Port*> StructureOverlay::Targets(const Port& from) const {
  std::vector<Port*> targets;
  const auto add_outgoing = [&](const Port& port) {
    for (const Connection& each : port.outgoing()) {
      Port& now = NowFor(*each.to);
      const bool has_gone = std::ranges::any_of(composites_, [&](const auto* gone) { return IsWithinComposite(*gone, port, *each.to); });
      if (!has_gone && !IsGone(now)) targets.push_back(&now);
    }
  };
  add_outgoing(from);
  for (const auto& [before, after] : replaced_) {
    if (&NowFor(*after) == &from) add_outgoing(*before);
  }
  std::erase_if(targets, [&](Port* to) {
    return std::ranges::any_of(
        disconnected_, [&](const Edge& edge) { return edge.first == &from && edge.second == to; });
  });
  for (const Edge& edge : connected_) {
    if (edge.first == &from) targets.push_back(edge.second);
  }
  return targets;
}

bool StructureOverlay::IsConnected(const Port& port, const FrameworkElement* module) const {
  return std::ranges::any_of(EdgesOf(const_cast<Port&>(port), module), [&](const Edge& edge) {
    return edge.second == &port || dynamic_cast<const ProbePort*>(edge.second) == nullptr;
  });
}

bool StructureOverlay::Reaches(const Port& from, const Port& to) const {
  std::set<const Port*> seen;
  const std::function<bool(const Port&)> leads_there = [&](const Port& at) {
    return std::ranges::any_of(Targets(at), [&](const Port* next) {
      return next == &to || (next->is_proxy() && seen.insert(next).second && leads_there(*next));
    });
  };
  return &from == &to || leads_there(from);
}

// Of interface ports alone.
bool StructureOverlay::IsInCycle(const Port& port) const {
  return port.is_proxy() && std::ranges::any_of(Targets(port), [&](const Port* next) { return next->is_proxy() && Reaches(*next, port); });
}

Result<void> StructureOverlay::Connect(Port& from, Port& to, const ConnectOptions& options) {
  if (auto ends = Port::CheckEnds(from, to, options); !ends) return ends;
  if (std::ranges::count(Targets(from), &to) > 0) {
    return Error{.message = "is connected to " + to.path() + " already", .path = from.path()};
  }
  if (from.is_proxy() && to.is_proxy() && Reaches(to, from)) {
    return Error{
        .message = "connecting to " + to.path() + " would close a cycle of interface ports",
        .path = from.path()};
  }
  connected_.push_back({&from, &to});
  return {};
}

Result<void> StructureOverlay::Disconnect(Port& from, Port& to) {
  if (std::ranges::count(Targets(from), &to) == 0) {
    const std::vector<std::string> names = NamesOf(Targets(from), &Port::path);
    return Error{.message = "is not connected to " + to.path(),
                 .path = from.path(),
                 .hint = names.empty() ? "it is not connected to anything"
                                       : NearestNameHint(to.path(), names)};
  }
  if (std::erase(connected_, Edge{&from, &to}) == 0) disconnected_.push_back({&from, &to});
  return {};
}

std::vector<std::pair<Port*, Port*>> StructureOverlay::EdgesOf(Port& port, const FrameworkElement* module) const {
  std::vector<Edge> edges;
  for (Port* to : Targets(port)) edges.push_back({&port, to});
  const auto add_from = [&](const std::vector<Port*>& sources) {
    for (Port* source : sources) {
      Port& now = NowFor(*source);
      if (!IsGone(now) && std::ranges::count(Targets(now), &port) > 0)
        edges.push_back({&now, &port});
    }
  };
  add_from(port.incoming());
  for (const auto& [before, after] : replaced_) {
    if (&NowFor(*after) == &port) add_from(before->incoming());
  }
  for (const Edge& edge : connected_) {
    if (edge.second == &port && std::ranges::count(edges, edge) == 0) edges.push_back(edge);
  }
  std::erase_if(edges, [&](const Edge& edge) { return module != nullptr && IsWithinComposite(*module, *edge.first, *edge.second); });
  return edges;
}

bool StructureOverlay::HasSource(const Port& port) const {
  const std::vector<Edge> edges = EdgesOf(const_cast<Port&>(port));
  return std::ranges::any_of(edges, [&](const Edge& edge) { return edge.second == &port; });
}

}  // namespace runnel::internal
