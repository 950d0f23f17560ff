#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "core/base/characters.h"
#include "core/base/nearest_name.h"
#include "core/element/configurable.h"
#include "core/element/element_path.h"
#include "core/element/file_notes.h"
#include "core/element/tags.h"
#include "core/module/group.h"
#include "core/module/group_parameter.h"
#include "core/paths/late_connections.h"
#include "core/plugin/module_type_name.h"
#include "core/port/driving_ports.h"
#include "core/port/parameter_input.h"
#include "core/port/port_options.h"
#include "core/port/proxy_port.h"
#include "core/types/text_format.h"
#include "core/types/type_info.h"
#include "plugins/structure/element_state.h"
#include "plugins/structure/module_values.h"
#include "plugins/structure/plan.h"
#include "plugins/structure/replacement.h"

namespace runnel::internal {

namespace {

// What the parameter is to be set to; one that it accepts.
Result<std::shared_ptr<const void>> ValueIn(const SetParameter& change, const Configurable& parameter) {
  // What is put back may be so at another module.
  const bool has_text = !change.value.empty() && change.type != &parameter.type();
  if (!change.object || has_text) return parameter.Parse(change.value);
  if (change.type != &parameter.type()) {
    return Error{.message = "a " + parameter.type().name() + " cannot be set to a " + change.type->name()};
  }
  if (auto good = parameter.Check(change.object.get()); !good) return good.error();
  return change.object;
}

Result<void> CheckDescription(const auto& change) {
  const std::string fault = UnwritableCharacter(change.description);
  if (fault.empty()) return {};
  return Error{.message = "the description contains " + fault, .path = change.path};
}

}  // namespace

Result<void> Plan::Check(const CreateModule& change) {
  const auto place = overlay_.PlaceFor(change.path);
  if (!place) return place.error();
  const auto work = MakeModule(
      *place, {.path = change.path, .type = change.type, .settings = change.settings, .state = change.state}, nullptr);
  if (!work) return work.error();
  AddCreation(work->element, nullptr, change.state);
  return {};
}

Result<void> Plan::Check(const CreateGroup& change) {
  const auto place = overlay_.PlaceFor(change.path);
  if (!place) return place.error();
  const auto work = MakeGroup(*place, nullptr, change.state);
  if (!work) return work.error();
  AddCreation(work->element, nullptr, change.state);
  return {};
}

Result<void> Plan::Check(const CreatePort& change) {
  const auto place = overlay_.PlaceFor(change.path);
  if (!place) return place.error();
  const TypeInfo* const type = FindType(change.type);
  if (type == nullptr) {
    return Error{.message = "there is no data type '" + change.type + "'",
                 .path = change.path,
                 .hint = NearestNameHint(change.type, NamesOf(RegisteredTypes(), &TypeInfo::name))};
  }
  if (auto good = CheckDescription(change); !good) return good;
  UnlistedElement made(std::make_unique<ProxyPort>(*place, change.direction, *type, change.description));
  return AddNew(std::move(made), change.state);
}

Result<void> Plan::Check(const CreateParameter& change) {
  const auto place = overlay_.PlaceFor(change.path);
  if (!place) return place.error();
  const std::string around = place->parent.path() + "/";
  std::vector<std::string> targets = change.targets;
  for (std::string& target : targets) {
    const auto found = overlay_.Find(IsAbsolutePath(target) ? target : around + target, PathKind::kParameter);
    if (!found && change.state) continue;  // it has gone, or comes later
    if (!found) return found.error();
    if (dynamic_cast<Configurable*>(*found) == nullptr) {
      return Error{.message = (*found)->path() + " is not a parameter", .path = change.path};
    }
    // The parameter looks for it from its group, where the name of the application cannot be left out.
    if (!IsAbsolutePath(target)) continue;
    target = FindOwner(**found)->path() + "/" + (*found)->name();
    if (target.starts_with(around)) target.erase(0, around.size());
  }
  if (auto good = CheckDescription(change); !good) return good;
  UnlistedElement made(std::make_unique<GroupParameter>(*place, std::move(targets), change.description));
  return AddNew(std::move(made), change.state);
}

namespace {

// Whoever has made it uses it until the run ends: the network, a recording's player. Not so a group as changes make them: threads.
bool HoldsWhatTagsMake(const FrameworkElement& element) {
  if (element.FindAnnotation<NotSaved>() != nullptr && dynamic_cast<const Group*>(&element) == nullptr) return true;
  return element.kind() == ElementKind::kGroup && !IsModule(element) &&
         std::ranges::any_of(element.children(), [](const auto* each) { return HoldsWhatTagsMake(*each); });
}

}  // namespace

Result<void> CheckIsNotOfTags(const FrameworkElement& element, const char* what) {
  if (!HoldsWhatTagsMake(element)) return {};
  return Error{
      .message = std::string("is, or holds, what a tag of the file or a program has made for itself, and cannot be ") +
                 what + " while it runs",
      .path = element.path(),
      .hint = "change the tag in the file, and run it again; or have the program let go of it"};
}

Result<void> Plan::Check(const DeleteElement& change) {
  const auto found = overlay_.Find(change.path);
  if (!found) return found.error();
  FrameworkElement& element = **found;
  if (element.parent() == nullptr) {
    return Error{.message = "the root cannot be deleted", .path = element.path()};
  }
  const FrameworkElement& owner = *element.parent();
  const bool is_part = owner.kind() == ElementKind::kModule || owner.kind() == ElementKind::kPortGroup;
  if (is_part || (element.kind() == ElementKind::kPort && !dynamic_cast<Port&>(element).is_proxy())) {
    return Error{.message = "a part of a module cannot be deleted by itself", .path = element.path()};
  }
  if (auto good = CheckIsNotOfTags(element, "deleted"); !good) return good;
  Concern(element);
  going_.push_back(element.path());
  for (const Connection& tie : ExternalConnectionsOf(element)) {
    Concern(*tie.from);
    Concern(*tie.to);
  }
  for (const LateConnection& each : AwaitedWith(overlay_.late(), element)) {
    if (auto cut = CheckLateTie(each.SourceText(), each.to, std::nullopt); !cut) return cut;
  }
  element.VisitAll<const Port>([&](const Port& port) {
    if (port.FindMark())
      warnings_.push_back(
          {.message =
               "its mark as driving goes with it: STOP does not hold what takes its place, unless that declares it",
           .path = port.path()});
  });
  overlay_.Remove(element);
  AddRemoval(element);
  return {};
}

Result<void> Plan::Check(const SetParameter& change) {
  const auto found = overlay_.Find(change.path, PathKind::kParameter);
  if (!found) return found.error();
  auto* const parameter = dynamic_cast<Configurable*>(*found);
  if (parameter == nullptr) {
    return Error{.message = (*found)->path() + " is not a parameter", .path = (*found)->path()};
  }
  if (const auto* const group = dynamic_cast<const GroupParameter*>(*found)) {
    return CheckAll(*group, change);
  }
  const bool is_settled = parameter->info().is_static && (*found)->life_cycle() == LifeCycle::kReady;
  const auto value = ValueIn(change, *parameter);
  if (!value) return value.error().WithPath((*found)->path());
  if (is_settled) return CheckStatic(**found, *parameter, value->get());
  Concern(**found);
  if (is_way_back_ && parameter->is_fed()) {
    warnings_.push_back(
        {.message = "an output has set it since, and what that gives counts", .path = (*found)->path()});
  }
  AddSetting([parameter] { return parameter->own(); },
             [parameter](const Configurable::Own& each) { return parameter->Put(each); },
             Configurable::Own{*value, change.own.given, change.own.settings},
             [parameter, path = (*found)->path()](auto&) -> ChangeSet {
               // The module has been made by this change set, and goes as a whole.
               if (parameter->info().is_static) return {};
               const Configurable::Own own = parameter->own();
               return {SetParameter{path, parameter->OwnText(), own.value, &parameter->type(), own}};
             });
  return {};
}

// What stands for others is set by setting them, each as its kind is set.
Result<void> Plan::CheckAll(const GroupParameter& group, const SetParameter& change) {
  bool is_set = false;
  const std::vector<std::string> targets = TargetsOf(group);  // modules are made meanwhile, without the lock
  for (const std::string& target : targets) {
    const std::string path = IsAbsolutePath(target) ? target : group.parent()->path() + "/" + target;
    const auto found = overlay_.Find(path, PathKind::kParameter);
    const auto* const parameter = found ? dynamic_cast<const Configurable*>(*found) : nullptr;
    if (parameter == nullptr || *found == &group) continue;
    SetParameter one{(*found)->path(), change.value, change.object, change.type};
    if (change.object && change.type != &parameter->type()) {
      one.value = runnel::ToText(*change.type, change.object.get());
      one.object.reset();
    }
    if (auto set = Check(one); !set) return set;
    is_set = true;
  }
  if (is_set) return {};
  return Error{.message = "nothing is there any more that could be set by it", .path = group.path()};
}

// The module is made anew by its own type, and keeps what fits: connections of ports that it has no more are cut.
Result<void> Plan::CheckStatic(const FrameworkElement& element, const Configurable& parameter, const void* value) {
  const FrameworkElement* const module = FindModuleAround(element);
  const std::string type = module != nullptr ? FindModuleType(*module) : "";
  if (type.empty()) {
    return Error{.message = "can be set only before its module is ready",
                 .path = element.path(),
                 .hint = "its module was made by code, of a class that no change can make anew"};
  }
  const std::string text = runnel::ToText(parameter.type(), value);
  if (text == parameter.ToText()) return {};
  return CheckReplacement({module->path(), type, {{element.name(), text}}}, Misfits::kAreCut);
}

// Cuts the connections that nothing takes over. What waits does so for whatever has the name of its port.
Result<void> Plan::Cut(const std::vector<std::pair<Port*, Port*>>& misfits, const FrameworkElement& module) {
  for (const auto& [port, counterpart] : misfits) {
    for (const auto& [from, to, options, converted] : overlay_.EdgesOf(*port, &module)) {
      if (auto cut = CheckTie(*from, *to, std::nullopt, false); !cut) return cut;
      warnings_.push_back({.message = "is not connected to " + to->path() +
                                      " any more: the module made anew has no port that takes it over",
                           .path = from->path()});
    }
    if (counterpart != nullptr) continue;
    for (const LateConnection& each : AwaitedWith(overlay_.late(), *port)) {
      if (auto cut = CheckLateTie(each.SourceText(), each.to, std::nullopt); !cut) return cut;
      warnings_.push_back(
          {.message = "is not waited for any more: the module made anew has no such port", .path = each.from});
    }
  }
  return {};
}

Result<void> Plan::CheckReplacement(const ReplaceModule& change, Misfits misfits) {
  const auto found = overlay_.Find(change.path);
  if (!found) return found.error();
  FrameworkElement& before = **found;
  if (!IsModule(before)) {
    return Error{.message = "is not a module and cannot be replaced by one", .path = before.path()};
  }
  return CheckReplacement(before, {*before.parent(), before.name(), false}, change, misfits);
}

Result<void> Plan::CheckReplacement(FrameworkElement& before, const Placement& place, const ReplaceModule& change,
                                    Misfits misfits) {
  Result<void> has_places;
  before.VisitAll<const Port>([&](const Port& port) {
    if (has_places) has_places = CheckHasItsPlace(port);
  });
  if (!has_places) return has_places;
  const auto work = MakeModule(place, change, &before);
  if (!work) return work.error();
  FrameworkElement& made = **work->element;
  if (change.state) change.state->NoteWayBack(made);
  PortMatch match = MatchPorts(before, made, overlay_);
  if (misfits == Misfits::kAreCut && match.errors.size() == match.misfits.size()) {
    if (auto cut = Cut(match.misfits, before); !cut) return cut;
    match.errors.clear();
  }
  if (!match.errors.empty()) {
    for (std::size_t i = 1; i < match.errors.size(); ++i) further_errors_.push_back(match.errors[i]);
    return match.errors.front();
  }
  if (auto moves = CheckMovesAlike(before, made, match.ports); !moves) return moves;
  // Made anew by its own type it is to go on where it was. Another type takes over what it can.
  for (const Setting& each : SettingsOf(before)) {
    if (FindConfigurable(made, each.parameter)) continue;
    warnings_.push_back({.message = "its value " + each.value + " of parameter '" + each.parameter +
                                    "' went with it: the new module has no such parameter",
                         .path = before.path()});
  }
  before.VisitAll<Port>([&](Port& port) {
    const auto found = std::ranges::find(match.ports, &port, &std::pair<Port*, Port*>::first);
    const auto* const given = port.FindAnnotation<GivenLimits>();
    if (found != match.ports.end() && found->second->is_proxy() && given != nullptr && given->limits.has_some()) {
      warnings_.push_back({.message = "its limits went with it: an interface port has none", .path = port.path()});
    }
    if (found != match.ports.end()) return;
    if (const std::string what = WhatIsSetAt(port); !what.empty()) {
      warnings_.push_back(
          {.message = what + " went with it: the new module has no port that takes it over", .path = port.path()});
    }
  });
  const bool is_made_anew = FindModuleType(before) == change.type;
  for (Error& each : StateRefusals(before, made)) {
    (is_made_anew ? further_errors_ : warnings_).push_back(std::move(each));
  }
  if (auto replaced = overlay_.Replace(before, made, match.ports); !replaced) return replaced;
  made_.push_back(&made);
  AddReplacement(before, *work, std::move(match.ports), change);
  return {};
}

Result<void> Plan::Check(const TagElement& change) {
  const auto found = overlay_.Find(change.path);
  if (!found) return found.error();
  FrameworkElement& element = **found;
  if (auto may = CheckMayBeSet(element); !may) return may;
  if (const auto good = CheckTags(change.tags); !good) return good.error().WithPath(element.path());
  Concern(element);
  const auto get = [&element] { return TagsOf(element); };
  const auto set = [&element](const std::vector<std::string>& tags) { return SetTags(element, tags); };
  AddSetting(get, set, change.tags, [&element, get](auto&) -> ChangeSet {
    return {TagElement{element.path(), get()}};
  });
  return {};
}

}  // namespace runnel::internal
