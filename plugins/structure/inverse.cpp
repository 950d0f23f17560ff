#include "plugins/structure/inverse.h"

#include <set>
#include <utility>

#include "core/element/element_path.h"
#include "core/element/runtime.h"
#include "core/module/group_parameter.h"
#include "core/plugin/module_type_name.h"
#include "core/port/driving_ports.h"
#include "core/port/port.h"
#include "plugins/scheduling/thread_container.h"
#include "plugins/structure/element_state.h"
#include "plugins/structure/module_values.h"
#include "plugins/structure/plan.h"

namespace runnel::internal {

namespace {

Error CannotBeMade(const FrameworkElement& element) {
  return {.message = "could not be made again by a change: it is of no registered type", .path = element.path()};
}

// Nothing for what comes with a module.
void AddCreation(const FrameworkElement& element, FrameworkElement::Inherit how, ChangeSet& changes,
                 std::optional<Error>& why_not) {
  using Below = ElementState::Below;
  const bool is_group = FindModuleType(element).empty() && element.kind() == ElementKind::kGroup;
  const auto state = std::make_shared<const ElementState>(element, how, is_group ? Below::kLeftOut : Below::kIncluded);
  const std::string type = FindModuleType(element);
  const auto* const port = dynamic_cast<const Port*>(&element);
  if (!type.empty()) {
    changes.push_back(CreateModule{element.path(), type, SettingsOf(element), state});
  } else if (const auto* const container = dynamic_cast<const ThreadContainer*>(&element)) {
    AddThreadAgain(*container, changes);
  } else if (is_group) {
    changes.push_back(CreateGroup{element.path(), state});
  } else if (port != nullptr && port->is_proxy()) {
    changes.push_back(CreatePort{element.path(), port->direction(), port->type().name(), port->description(), state});
  } else if (const auto* const group = dynamic_cast<const GroupParameter*>(&element)) {
    changes.push_back(CreateParameter{group->path(), group->targets(), group->info().description, state});
  } else if (!why_not) {
    why_not = CannotBeMade(element);
  }
  const std::string thread = OwnThreadPath(element);
  if (!thread.empty()) changes.push_back(AssignToThread{element.path(), thread});
  if (!is_group) return;
  for (const FrameworkElement* each : element.children()) AddCreation(*each, how, changes, why_not);
}

// Whether a composite has made it, and makes it again by itself.
bool IsWithinOne(const Connection& edge) {
  const FrameworkElement* const composite = FindModuleAround(*edge.from);
  return composite != nullptr && IsWithinComposite(*composite, *edge.from, *edge.to);
}

void AddConnection(const Connection& edge, ChangeSet& changes) {
  if (IsWithinOne(edge)) return;
  changes.push_back(ConnectPorts{edge.from->path(), LastingPath(*edge.to), edge.options});
}

void AddInnerConnections(FrameworkElement& element, ChangeSet& changes) {
  element.VisitAll<const Port>([&](const Port& port) {
    for (const Connection& edge : port.outgoing()) {
      if (edge.to->IsAtOrBelow(element)) AddConnection(edge, changes);
    }
  });
}

// Has the change be about what is at or below `to`, as it has been about what is at or below `from`.
struct Rebase {
  const std::string& from;
  const std::string& to;

  void Move(std::string& path) const { MovePath(path, from, to); }
  void operator()(ConnectPorts& change) const {
    Move(change.from);
    Move(change.to);
  }
  void operator()(CreateParameter& change) const {
    Move(change.path);
    for (std::string& each : change.targets) Move(each);
  }
  // Of all others that something is made again by.
  template <typename Other>
  void operator()(Other& change) const {
    if constexpr (requires { change.path; }) Move(change.path);
  }
};

// In which it would show if somebody had made something else of it.
std::string WhatItIs(const FrameworkElement& element) {
  const std::string type = FindModuleType(element);
  if (!type.empty()) return type;
  if (element.kind() == ElementKind::kParameter) return "parameter";
  if (element.kind() == ElementKind::kThread) return "thread";
  return element.kind() == ElementKind::kGroup ? "group" : "port";
}

// The path of what a change deletes, replaces or renames; nullptr for other changes.
const std::string* Takes(const Change& change) {
  if (const auto* const each = std::get_if<DeleteElement>(&change)) return &each->path;
  if (const auto* const each = std::get_if<ReplaceModule>(&change)) return &each->path;
  if (const auto* const each = std::get_if<RenameElement>(&change)) return &each->path;
  return nullptr;
}

}  // namespace

std::string OwnThreadPath(const FrameworkElement& element) {
  const ThreadContainer* const thread = OwnThread(element);
  return thread != nullptr ? thread->path() : "";
}

ChangeSet MakeAgain(FrameworkElement& element, std::optional<Error>& why_not) {
  ChangeSet changes;
  AddCreation(element, FrameworkElement::Inherit::kAsReplacement, changes, why_not);
  AddInnerConnections(element, changes);
  for (const Connection& tie : ExternalConnectionsOf(element)) {
    // Recorders and offers, which are beside the tree, tie themselves to what comes.
    const auto to = element.runtime().root().Find(tie.to->path());
    if (to && *to == tie.to) AddConnection(tie, changes);
  }
  return changes;
}

ChangeSet MakeLike(FrameworkElement& element, const std::string& path, std::optional<Error>& why_not) {
  ChangeSet changes;
  AddCreation(element, FrameworkElement::Inherit::kAsCopy, changes, why_not);
  AddInnerConnections(element, changes);
  const Rebase rebase{element.path(), path};
  for (Change& each : changes) std::visit(rebase, each);
  return changes;
}

ChangeSet ReplaceBack(const FrameworkElement& before, const FrameworkElement& after, const ReplaceModule& change,
                      std::optional<Error>& why_not) {
  const std::string type = FindModuleType(before);
  if (type.empty()) {
    if (!why_not) why_not = CannotBeMade(before);
    return {};
  }
  auto state = std::make_shared<const ElementState>(before, FrameworkElement::Inherit::kAsReplacement);
  auto records = RecordsToComeBack(before, after, change);
  return {ReplaceModule{before.path(), type, {}, change.probation_cycles, std::move(state), std::move(records)}};
}

UndoRecord UndoRecordOf(const std::vector<ChangeSet>& inverses, std::optional<Error> why_not, FrameworkElement& root) {
  UndoRecord undo_record{{}, {}, std::move(why_not)};
  // The last step first.
  for (auto step = inverses.rbegin(); step != inverses.rend(); ++step) {
    undo_record.changes.insert(undo_record.changes.end(), step->begin(), step->end());
  }
  for (const Change& each : undo_record.changes) {
    const std::string* const path = Takes(each);
    if (path == nullptr) continue;
    if (const auto found = root.Find(*path)) undo_record.expected[*path] = WhatItIs(**found);
  }
  return undo_record;
}

Result<void> CheckExpected(const UndoRecord& undo_record, FrameworkElement& root) {
  std::set<std::string> deleted;
  for (const Change& each : undo_record.changes) {
    if (const auto* const change = std::get_if<DeleteElement>(&each)) deleted.insert(change->path);
  }
  for (const auto& [path, what] : undo_record.expected) {
    const auto found = root.Find(path);
    if (!found) return found.error();
    if (WhatItIs(**found) != what) {
      return Error{.message = "is not what it was any more: " + WhatItIs(**found) + " instead of " + what,
                   .path = path};
    }
    if (what != "group" || !deleted.contains(path)) continue;
    for (const FrameworkElement* child : (*found)->children()) {
      if (deleted.contains(child->path())) continue;
      return Error{.message = "has got '" + child->name() + "' meanwhile", .path = path};
    }
  }
  return {};
}

}  // namespace runnel::internal
