// Modules and groups that get another name, and others like them.

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "core/element/element_path.h"
#include "core/element/file_notes.h"
#include "core/module/group.h"
#include "core/module/group_parameter.h"
#include "core/paths/late_connections.h"
#include "core/paths/path_search.h"
#include "core/plugin/module_type_name.h"
#include "core/port/proxy_port.h"
#include "core/types/type_info.h"
#include "plugins/structure/element_state.h"
#include "plugins/structure/plan.h"
#include "plugins/structure/renamed_text.h"

namespace runnel::internal {

namespace {

// Who can be renamed and copied.
Result<void> CheckWhatItIs(const FrameworkElement& element, const char* what) {
  const auto refusal = [&](const std::string& why) { return Error{.message = why, .path = element.path()}; };
  if (element.kind() != ElementKind::kModule && element.kind() != ElementKind::kGroup) {
    return refusal(std::string("is neither a module nor a group, and cannot be ") + what);
  }
  if (element.parent() == nullptr || element.parent()->kind() == ElementKind::kRuntime) {
    return refusal(std::string("is the whole application, which cannot be ") + what + " while it runs");
  }
  if (const FrameworkElement* const module = FindModuleAround(*element.parent())) {
    return refusal("is a part of the module " + module->path() + ", and cannot be " + what + " by itself");
  }
  return CheckIsNotOfTags(element, what);
}

std::string Sibling(const FrameworkElement& element, const std::string& name) {
  return element.parent()->path() + "/" + name;
}

// Where in the file it stands.
void KeepPlace(FrameworkElement& made, const FrameworkElement& before) {
  const auto* const place = before.FindAnnotation<SourcePlace>();
  if (place != nullptr) made.Annotate(std::make_unique<SourcePlace>(place->position));
}

}  // namespace

Result<void> Plan::Check(const CopyElement& change) {
  const auto found = overlay_.Find(change.path);
  if (!found) return found.error();
  FrameworkElement& element = **found;
  if (auto good = CheckWhatItIs(element, "copied"); !good) return good;
  std::string name = change.name.empty() ? element.name() : change.name;
  for (int i = 2; change.name.empty() && overlay_.Find(Sibling(element, name)); ++i) {
    name = element.name() + "_" + std::to_string(i);
  }
  if (name.find('/') != std::string::npos) {
    return Error{.message = "'" + name + "' is a path, where the name of the copy is wanted", .path = element.path()};
  }
  std::optional<Error> why_not;
  const ChangeSet changes = MakeLike(element, Sibling(element, name), why_not);
  if (why_not) return *why_not;
  const auto ties = ExternalConnectionsOf(element);
  const bool is_recorded = std::ranges::any_of(ties, [](const Connection& tie) { return IsRecorded(*tie.from); });
  if (!ties.empty()) {
    warnings_.push_back({.message = std::string("is not connected with others, as ") + element.path() + " is" +
                                    (is_recorded ? ", nor recorded by that name" : ""),
                         .path = Sibling(element, name)});
  }
  element.VisitAll<const Port>([&](const Port& port) {
    if (!IsOffered(port)) return;
    warnings_.push_back({.message = "is not offered, as " + port.path() + " is", .path = Sibling(element, name)});
  });
  return CheckEach(changes);
}

Result<void> Plan::Check(const RenameElement& change) {
  const auto found = overlay_.Find(change.path);
  if (!found) return found.error();
  FrameworkElement& element = **found;
  if (auto good = CheckWhatItIs(element, "renamed"); !good) return good;
  if (change.name.find('/') != std::string::npos) {
    return Error{.message = "'" + change.name + "' is a path, where the new name is wanted", .path = element.path()};
  }
  const std::string before = element.path();
  const std::string after = Sibling(element, change.name);
  const auto place = overlay_.PlaceFor(after);
  if (!place) return place.error();
  const std::size_t first = steps_.size();
  // Those that wait for their ends are noted by their paths.
  std::vector<LateConnection> late;
  for (const LateConnection& each : overlay_.late()) {
    if (IsAtOrBelow(each.from, before) || IsAtOrBelow(each.to, before)) late.push_back(each);
  }
  for (const LateConnection& each : late) {
    if (auto cut = Check(DisconnectPorts{each.from, each.to}); !cut) return cut;
  }
  MoveExtensions(element, change.name);
  if (auto moved = MoveTo(*place, element); !moved) return moved;
  MoveTargets(element, change.name);
  for (const LateConnection& each : late) {
    ConnectPorts tie{each.from, each.to, each.options};
    MovePath(tie.from, before, after);
    MovePath(tie.to, before, after);
    if (auto tied = TieAgain(tie); !tied) return tied;
  }
  // The name of before takes all of it back.
  for (std::size_t i = first; i < steps_.size(); ++i) {
    steps_[i].inverse = [](auto&) { return ChangeSet(); };
  }
  steps_[first].inverse = [after, name = element.name()](auto&) -> ChangeSet { return {RenameElement{after, name}}; };
  return {};
}

Result<void> Plan::MoveTo(const Placement& place, FrameworkElement& element) {
  if (IsModule(element)) {
    const std::string type = FindModuleType(element);
    if (type.empty()) {
      return Error{.message = "was made by code, of a class that no change can make anew under another name",
                   .path = element.path()};
    }
    if (element.kind() == ElementKind::kGroup) {
      warnings_.push_back({.message = "is a composite, and begins afresh under its new name", .path = element.path()});
    }
    return CheckReplacement(element, place, {.path = element.path(), .type = type, .probation_cycles = 0},
                            Misfits::kAreRefused);
  }
  if (auto* const port = dynamic_cast<Port*>(&element)) return MovePort(place, *port);
  if (const auto* const parameter = dynamic_cast<const GroupParameter*>(&element)) {
    auto made = std::make_unique<GroupParameter>(place, TargetsOf(*parameter), parameter->info().description);
    AddInheritance(*made, element);
    return AddNew(UnlistedElement(std::move(made)));
  }
  if (element.kind() == ElementKind::kGroup) return MoveGroup(place, element);
  return Error{.message = "cannot be moved with its group", .path = element.path()};
}

// One after the other goes into a new group; what ties them stays.
Result<void> Plan::MoveGroup(const Placement& place, FrameworkElement& group) {
  const auto work = MakeGroup(place, &group, {});
  if (!work) return work.error();
  FrameworkElement& after = **work->element;
  KeepPlace(after, group);
  AddInheritance(after, group);
  AddCreation(work->element, &place.parent == group.parent() ? &group : nullptr);
  for (FrameworkElement* child : overlay_.Children(group)) {
    if (auto moved = MoveTo({after, child->name(), false}, *child); !moved) return moved;
  }
  going_.push_back(group.path());
  overlay_.Remove(group);
  AddRemoval(group);
  return {};
}

// What has been said of it by then, also by this change set.
void Plan::AddInheritance(FrameworkElement& made, const FrameworkElement& before) {
  steps_.push_back({[&made, &before]() -> Result<void> {
                      made.InheritAnnotations(before);
                      return {};
                    },
                    [] {}});
}

Result<void> Plan::MovePort(const Placement& place, Port& port) {
  if (!port.is_proxy()) return Error{.message = "cannot be moved with its group", .path = port.path()};
  auto kept = std::make_shared<UnlistedElement>(
      std::make_unique<ProxyPort>(place, port.direction(), port.type(), port.description()));
  auto& made = dynamic_cast<Port&>(**kept);
  KeepPlace(made, port);
  if (auto prepared = Runtime::Prepare(*kept); !prepared) return prepared;
  Concern(port);
  if (auto replaced = overlay_.Replace(port, made, {{&port, &made}}); !replaced) return replaced;
  auto has_taken = std::make_shared<bool>(false);
  AddInheritance(made, port);
  steps_.push_back({[=, this, &port, &made]() -> Result<void> {
                      if (auto listed = runtime_.List(std::move(*kept)); !listed) return listed.error();
                      made.TakeOver(port);
                      *has_taken = true;
                      return {};
                    },
                    [=, this, &port, &made] {
                      if (*has_taken) port.TakeOver(made);
                      *has_taken = false;
                      if (!*kept) *kept = runtime_.Unlist(made).value();
                    }});
  return {};
}

// Parameters of groups that stand for some within it, those that have come with it, too.
void Plan::MoveTargets(const FrameworkElement& renamed, const std::string& name) {
  const auto move = [&, names = NewNames{{renamed.path(), name}}](GroupParameter& each) {
    std::vector<std::string> paths = TargetsOf(each);
    for (std::string& path : paths) path = RenamedPath(path, each.parent()->path(), names);
    if (paths == TargetsOf(each)) return;
    targets_[&each] = paths;
    AddSetting([&each] { return each.targets(); },
               [&each](const std::vector<std::string>& now) -> Result<void> {
                 each.SetPaths(now);
                 return {};
               },
               std::move(paths), [](auto&) { return ChangeSet(); });
  };
  runtime_.root().VisitAll<GroupParameter>(move);
  for (FrameworkElement* made : made_) made->VisitAll<GroupParameter>(move);
}

const std::vector<std::string>& Plan::TargetsOf(const GroupParameter& parameter) const {
  const auto moved = targets_.find(&parameter);
  return moved != targets_.end() ? moved->second : parameter.targets();
}

}  // namespace runnel::internal
