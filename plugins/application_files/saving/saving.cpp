#include "plugins/application_files/saving/saving.h"

#include <algorithm>

#include "core/base/characters.h"
#include "core/element/element_path.h"
#include "core/element/file_notes.h"
#include "core/paths/distant_ports.h"
#include "core/paths/late_connections.h"
#include "core/paths/path_search.h"
#include "core/plugin/module_type_name.h"
#include "plugins/parameters/value_to_save.h"
#include "plugins/structure/change.h"

namespace runnel::internal {

namespace {

// Those of one word stand together behind a blank line, and groups each for itself.
void AddSection(std::vector<NewElement> section, bool is_apart, NewElement& parent) {
  for (NewElement& each : section) {
    const bool begins = &each == &section.front() || is_apart;
    each.after_blank_line = begins && !parent.children.empty();
    parent.children.push_back(std::move(each));
  }
}

void AddInside(const XmlTag& tag, FrameworkElement& element, Saving& saving, NewElement& made) {
  for (const AddedAttribute* added : saving.tools.tags.AddedAttributes(tag.name)) {
    if (!added->saved) continue;
    std::string value = added->saved(element);
    if (!value.empty()) made.attributes.emplace_back(added->rule.name, std::move(value));
  }
  for (const XmlTag* inner : TagsWithin(tag.name, saving)) {
    std::vector<NewElement> section;
    if (inner->saved) {
      for (const SavedTag& each : inner->saved(element)) {
        section.push_back(ElementOf(*inner, each, element, saving));
      }
    }
    if (inner->missing) section = inner->missing(nullptr, element, saving, nullptr);
    AddSection(std::move(section), inner->name == "group", made);
  }
}

}  // namespace

std::string SavedValue(const FrameworkElement& element, const Configurable& configurable, const Saving& saving) {
  const std::string text = TextToSave(element, configurable);
  return &configurable.type() == &TypeOf<FilePath>() ? MovedFileName(text, "", saving.folder) : text;
}

void Saving::CheckText(std::string_view text, const FrameworkElement& element) {
  const std::string fault = UnwritableCharacter(text);
  if (fault.empty()) return;
  Fail({.message = "what is to be saved of it contains " + fault + ": no file can carry that", .path = element.path()});
}

void Saving::CheckAttribute(const AttributeRule& rule, const std::string& value, const FrameworkElement& element) {
  CheckText(value, element);
  if (rule.kind != AttributeKind::kModuleType) return;
  if (value.empty()) {
    Fail({.message = "this module was made by code, of a class that no file can name",
          .path = element.path(),
          .hint = "register its type, and make it by ModuleRegistry::Create()"});
  }
  const ModuleType* const type = tools.plugins.modules().Find(value);
  if (type == nullptr) return;
  const std::vector<std::string>& loaded = tools.plugins.loaded();
  // Types that the program itself has brought need no plugin.
  if (std::ranges::find(loaded, type->plugin) != loaded.end()) plugins.insert(type->plugin);
}

bool IsByRule(const FrameworkElement& element) {
  const std::string type = FindModuleType(element);
  if (!type.empty() && MadeByRule::Before(element, type) != type) return true;
  return element.parent() != nullptr && IsByRule(*element.parent());
}

bool HoldsOnlyThreads(const FrameworkElement& group) {
  const auto is_thread = [](const FrameworkElement* child) { return child->kind() == ElementKind::kThread; };
  return !group.children().empty() && std::ranges::all_of(group.children(), is_thread);
}

bool IsSaved(const FrameworkElement& element) {
  if (element.FindAnnotation<NotSaved>() != nullptr) return false;
  return IsModule(element) || (element.kind() == ElementKind::kGroup && !HoldsOnlyThreads(element));
}

NewElement ElementOf(const XmlTag& tag, const SavedTag& saved, const FrameworkElement& about, Saving& saving) {
  const FrameworkElement& said_of = saved.element != nullptr ? *saved.element : about;
  const std::vector<AttributeRule> rules = saving.tools.tags.Rules(tag);
  NewElement made{.name = tag.name};
  for (const SavedAttribute& attribute : saved.attributes) {
    if (attribute.is_default || attribute.is_kept) continue;
    saving.CheckAttribute(*std::ranges::find(rules, attribute.name, &AttributeRule::name), attribute.value, said_of);
    made.attributes.emplace_back(attribute.name, attribute.value);
  }
  if (saved.element != nullptr) AddInside(tag, *saved.element, saving, made);
  return made;
}

std::vector<const XmlTag*> TagsWithin(std::string_view tag, const Saving& saving) {
  std::vector<const XmlTag*> tags;
  for (const std::string& name : saving.tools.tags.TagsIn(tag)) {
    tags.push_back(saving.tools.tags.FindTag(name));
  }
  std::ranges::stable_sort(tags, {}, &XmlTag::place);
  return tags;
}

namespace {

// What stands for a port in its group: the outermost module that it is part of, or, in the
// interface of a group, itself. nullptr if no file says anything of it.
const FrameworkElement* StandsFor(const Port& port, const FrameworkElement& application) {
  const FrameworkElement* anchor = &port;
  for (const FrameworkElement* at = &port; at != &application; at = at->parent()) {
    if (at == nullptr || at->FindAnnotation<NotSaved>() != nullptr) return nullptr;
    if (IsModule(*at)) anchor = at;
  }
  return anchor;
}

bool IsPortOf(const Port& port, const FrameworkElement& module) {
  const FrameworkElement* const parent = port.parent();
  return parent == &module || (parent->kind() == ElementKind::kPortGroup && parent->parent() == &module);
}

// The innermost group that has both, or nullptr. `from`: nullptr is one of another application that has ended.
FrameworkElement* Home(const Port* from, const Port& to, FrameworkElement& application) {
  if (from == nullptr || !DistantPathOf(*from).empty()) return to.IsAtOrBelow(application) ? &application : nullptr;
  const FrameworkElement* const source = StandsFor(*from, application);
  const FrameworkElement* const target = StandsFor(to, application);
  if (source == nullptr || target == nullptr) return nullptr;
  const bool is_inside = source == target && !(IsPortOf(*from, *source) && IsPortOf(to, *source));
  if (is_inside) return nullptr;
  FrameworkElement* home = source->parent();
  while (!target->parent()->IsAtOrBelow(*home)) home = home->parent();
  return home;
}

// The same of paths that nothing may be at; nullptr if that group has gone, too, or is none of the application.
FrameworkElement* HomeOfPaths(const std::string& from, const std::string& to, FrameworkElement& application) {
  std::string common;
  const auto from_names = SplitPath(from);
  const auto to_names = SplitPath(to);
  const auto apart = std::ranges::mismatch(from_names, to_names).in1;
  for (auto each = from_names.begin(); each != apart; ++each) common += "/" + std::string(*each);
  const auto found = application.runtime().root().Find(common);
  if (!found) return nullptr;
  FrameworkElement* home = *found;
  while (home != nullptr && home->kind() != ElementKind::kGroup) home = home->parent();
  return home != nullptr && home->IsAtOrBelow(application) ? home : nullptr;
}

// What a rule has switched for the time being is as people have made it, but for inputs where they have cut what the rule
// has made.
void TakeBack(const ChangeSet& back, FrameworkElement& application, std::vector<SavedEdge>& edges) {
  const PathSearch search(application.runtime());
  std::set<const Port*> of_people;
  for (const Change& each : back) {
    const auto* const cut = std::get_if<DisconnectPorts>(&each);
    const auto* const tie = std::get_if<ConnectPorts>(&each);
    const std::string& from_path = cut != nullptr ? cut->from : tie->from;
    const auto from = search.FindPort(from_path, PathKind::kOutput);
    const auto to = search.FindPort(cut != nullptr ? cut->to : tie->to, PathKind::kInput);
    const bool is_of_ended = tie != nullptr && IsDistantPath(from_path);
    if (!to || (!from && !is_of_ended)) continue;
    Port* const source = from ? *from : nullptr;
    const auto is_it = [&](const SavedEdge& edge) { return edge.from == source && edge.to == *to; };
    const auto known = std::ranges::find_if(edges, is_it);
    FrameworkElement* const home = Home(source, **to, application);
    if (known != edges.end()) {
      if (cut != nullptr) edges.erase(known);
    } else if (cut != nullptr) {
      of_people.insert(*to);
    } else if (home != nullptr && !of_people.contains(*to)) {
      edges.push_back({source, *to, tie->options, home, false, from ? "" : from_path});
    }
  }
}

}  // namespace

std::vector<SavedEdge> EdgesOf(FrameworkElement& application) {
  std::vector<SavedEdge> edges;
  application.VisitAll<const Port>([&](const Port& port) {
    for (const Connection& connection : port.outgoing()) {
      FrameworkElement* const home = Home(connection.from, *connection.to, application);
      if (home == nullptr) continue;
      edges.push_back({connection.from, connection.to, connection.options, home});
    }
  });
  if (const auto* const switched = application.runtime().root().FindAnnotation<SwitchedByRules>()) {
    for (const auto& each : switched->all) {
      for (const ChangeSet& back : each()) TakeBack(back, application, edges);
    }
  }
  const LateConnections* const late = LateConnections::FindIn(application.runtime());
  if (late == nullptr) return edges;
  for (const LateConnection& each : late->all()) {
    if (!each.waits_for) continue;
    const bool is_distant = IsDistantPath(each.from) && each.to.starts_with(application.path() + "/");
    FrameworkElement* const home = is_distant ? &application : HomeOfPaths(each.from, each.to, application);
    if (home == nullptr) continue;
    const auto to = PathSearch(application.runtime()).FindPort(each.to, PathKind::kInput);
    edges.push_back({.from = nullptr,
                     .to = is_distant && to ? *to : nullptr,
                     .options = each.options,
                     .home = home,
                     .from_path = each.from,
                     .to_path = each.to});
  }
  return edges;
}

}  // namespace runnel::internal
