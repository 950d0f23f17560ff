#include "plugins/structure/structure_overlay.h"

#include <algorithm>
#include <functional>
#include <set>

#include "core/base/nearest_name.h"
#include "core/element/element_path.h"
#include "core/port/driving_ports.h"
#include "core/port/probe_port.h"

namespace runnel::internal {

namespace {

auto Joins(const Port& from, const Port& to) {
  return [&from, &to](const Connection& edge) { return edge.from == &from && edge.to == &to; };
}

bool HasEdge(const std::vector<Connection>& edges, const Port& from, const Port& to) {
  return std::ranges::any_of(edges, Joins(from, to));
}

}  // namespace

std::vector<LateConnection>& StructureOverlay::Late() const {
  if (late_) return *late_;
  const LateConnections* const late = LateConnections::FindIn(runtime_);
  return late_.emplace(late != nullptr ? late->all() : std::vector<LateConnection>());
}

bool StructureOverlay::IsGone(const FrameworkElement& element) const {
  return std::ranges::any_of(removed_, [&](const auto* gone) { return element.IsAtOrBelow(*gone); });
}

FrameworkElement* StructureOverlay::Child(const FrameworkElement& parent, std::string_view name) const {
  for (FrameworkElement* each : added_) {
    if (each->parent() == &parent && each->name() == name && !IsGone(*each)) return each;
  }
  FrameworkElement* const child = parent.FindChild(name);
  return child != nullptr && !IsGone(*child) ? child : nullptr;
}

std::vector<FrameworkElement*> StructureOverlay::Children(const FrameworkElement& parent) const {
  std::vector<FrameworkElement*> children = parent.children();
  for (FrameworkElement* each : added_) {
    if (each->parent() != &parent) continue;
    const auto before = std::ranges::find_if(children, [&](const auto* child) {
      const auto successor = successors_.find(child);
      return successor != successors_.end() && successor->second == each;
    });
    before != children.end() ? void(*before = each) : children.push_back(each);
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
  for (LateConnection& each : Late()) {
    if (IsAtOrBelow(each.from, element.path()) || IsAtOrBelow(each.to, element.path())) each.waits_for = "its end";
  }
  removed_.push_back(&element);
  std::erase_if(connected_, [&](const Connection& edge) {
    return edge.from->IsAtOrBelow(element) || edge.to->IsAtOrBelow(element);
  });
}

Result<void> StructureOverlay::Replace(FrameworkElement& gone, FrameworkElement& element,
                                       const std::vector<std::pair<Port*, Port*>>& ports) {
  for (const auto& [before, after] : ports) {
    replaced_[before] = after;
    for (auto* edges : {&connected_, &disconnected_}) {
      for (Connection& edge : *edges) {
        if (edge.from == before) edge.from = after;
        if (edge.to == before) edge.to = after;
      }
    }
  }
  removed_.push_back(&gone);
  successors_[&gone] = &element;
  composites_.push_back(&gone);
  Add(element);
  for (const auto& [before, after] : ports) {
    if (!IsInCycle(*after)) continue;
    return Error{.message = "in the place of " + before->path() + " it would close a cycle of interface ports",
                 .path = after->path()};
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

std::vector<Connection> StructureOverlay::Targets(Port& from) const {
  std::vector<Connection> targets;
  const auto add_outgoing = [&](const Port& port) {
    for (const Connection& each : port.outgoing()) {
      Port& now = NowFor(*each.to);
      const bool has_gone =
          std::ranges::any_of(composites_, [&](const auto* gone) { return IsWithinComposite(*gone, port, *each.to); });
      if (!has_gone && !IsGone(now)) targets.push_back({&from, &now, each.options});
    }
  };
  add_outgoing(from);
  for (const auto& [before, after] : replaced_) {
    if (&NowFor(*after) == &from) add_outgoing(*before);
  }
  std::erase_if(targets, [&](const Connection& target) { return HasEdge(disconnected_, from, *target.to); });
  for (const Connection& edge : connected_) {
    if (edge.from == &from) targets.push_back(edge);
  }
  return targets;
}

bool StructureOverlay::IsConnected(const Port& port, const FrameworkElement* module) const {
  return std::ranges::any_of(EdgesOf(const_cast<Port&>(port), module), [&](const Connection& edge) {
    return edge.to == &port || dynamic_cast<const ProbePort*>(edge.to) == nullptr;
  });
}

bool StructureOverlay::Reaches(Port& from, const Port& to) const {
  std::set<const Port*> seen;
  const std::function<bool(Port&)> leads_there = [&](Port& at) {
    return std::ranges::any_of(Targets(at), [&](const Connection& edge) {
      Port* const next = edge.to;
      return next == &to || (next->is_proxy() && seen.insert(next).second && leads_there(*next));
    });
  };
  return &from == &to || leads_there(from);
}

// Of interface ports alone.
bool StructureOverlay::IsInCycle(Port& port) const {
  return port.is_proxy() && std::ranges::any_of(Targets(port), [&](const Connection& edge) {
           return edge.to->is_proxy() && Reaches(*edge.to, port);
         });
}

Result<void> StructureOverlay::Connect(Port& from, Port& to, const ConnectOptions& options) {
  if (auto ends = Port::CheckEnds(from, to, options); !ends) return ends;
  if (HasEdge(Targets(from), from, to)) {
    return Error{.message = "is connected to " + to.path() + " already", .path = from.path()};
  }
  if (from.is_proxy() && to.is_proxy() && Reaches(to, from)) {
    return Error{.message = "connecting to " + to.path() + " would close a cycle of interface ports",
                 .path = from.path()};
  }
  connected_.push_back({&from, &to, options});
  const bool was_noted = DisconnectLate(from.path(), to.path());
  if (was_noted || options.when_present) Late().push_back({LastingPath(from), LastingPath(to), options, {}});
  return {};
}

Result<void> StructureOverlay::Disconnect(Port& from, Port& to, bool stays_cut) {
  if (!HasEdge(Targets(from), from, to)) {
    const std::vector<std::string> names =
        NamesOf(Targets(from), [](const Connection& edge) { return edge.to->path(); });
    return Error{.message = "is not connected to " + to.path(),
                 .path = from.path(),
                 .hint = names.empty() ? "it is not connected to anything" : NearestNameHint(to.path(), names)};
  }
  if (stays_cut) {
    (void)DisconnectLate(from.path(), to.path());  // most are not noted
  } else if (auto* const late = const_cast<LateConnection*>(FindLate(from.path(), to.path()))) {
    late->waits_for = "its end";
  }
  if (std::erase_if(connected_, Joins(from, to)) == 0) disconnected_.push_back({&from, &to, {}});
  return {};
}

const LateConnection* StructureOverlay::FindLate(std::string_view from, std::string_view to) const {
  return runnel::FindLate(Late(), *this, from, to);
}

void StructureOverlay::ConnectLate(const std::string& from, const std::string& to, const ConnectOptions& options) {
  Late().push_back(
      {EndPath(*this, from, PathKind::kOutput), EndPath(*this, to, PathKind::kInput), options, "its ends"});
}

bool StructureOverlay::DisconnectLate(std::string_view from, std::string_view to) {
  const LateConnection* const late = FindLate(from, to);
  if (late == nullptr) return false;
  late_->erase(late_->begin() + (late - late_->data()));
  return true;
}

std::vector<Connection> StructureOverlay::EdgesOf(Port& port, const FrameworkElement* module) const {
  std::vector<Connection> edges = Targets(port);
  const auto add_from = [&](const std::vector<Port*>& sources) {
    for (Port* source : sources) {
      Port& now = NowFor(*source);
      if (IsGone(now)) continue;
      for (const Connection& edge : Targets(now)) {
        if (edge.to == &port && !HasEdge(edges, now, port)) edges.push_back(edge);
      }
    }
  };
  add_from(port.incoming());
  for (const auto& [before, after] : replaced_) {
    if (&NowFor(*after) == &port) add_from(before->incoming());
  }
  for (const Connection& edge : connected_) {
    if (edge.to == &port && !HasEdge(edges, *edge.from, port)) edges.push_back(edge);
  }
  std::erase_if(edges, [&](const Connection& edge) {
    return module != nullptr && IsWithinComposite(*module, *edge.from, *edge.to);
  });
  return edges;
}

bool StructureOverlay::HasSource(const Port& port) const {
  return std::ranges::any_of(EdgesOf(const_cast<Port&>(port)),
                             [&](const Connection& edge) { return edge.to == &port; });
}

}  // namespace runnel::internal
