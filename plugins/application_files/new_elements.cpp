#include "plugins/application_files/new_elements.h"

#include <algorithm>

#include "core/plugin/module_type_name.h"
#include "core/types/type_info.h"
#include "plugins/runtime_construction/path_use.h"
#include "plugins/runtime_construction/not_saved.h"

namespace runnel::internal {

namespace {

const char* OnFullName(OnFull on_full) {
  switch (on_full) {
    case OnFull::kDropNewest:
      return "drop_newest";
    case OnFull::kRefuse:
      return "refuse";
    case OnFull::kDropOldest:
      break;
  }
  return "drop_oldest";
}

// As short as it may be, seen from `home`.
std::string PortPath(const Port& port, FrameworkElement& home, PathKind end) {
  const std::string full = port.path().substr(home.path().size() + 1);
  const FrameworkElement* const group = port.parent();
  if (group->kind() != ElementKind::kPortGroup) return full;
  std::string module = group->parent()->path().substr(home.path().size());
  if (!module.empty()) module.erase(0, 1);
  const std::string shorter = module + "/" + port.name();
  return FindPort({home, shorter, {}}, end) == &port ? shorter : full;
}

bool IsSame(const ConnectOptions& one, const ConnectOptions& other) {
  return one.queue == other.queue && (one.queue == 0 || one.on_full == other.on_full);
}

void AddSavedAttributes(std::string_view tag, FrameworkElement& element, Saving& saving,
                        NewElement& made) {
  for (const AddedAttribute* added : saving.tools.tags.AddedAttributes(tag)) {
    if (!added->saved) continue;
    std::string value = added->saved(element);
    if (!value.empty()) made.attributes.emplace_back(added->rule.name, std::move(value));
  }
}

// Behind a blank line, if something stands before them.
void AddSection(std::vector<NewElement> section, NewElement& parent) {
  if (section.empty()) return;
  section.front().after_blank_line = !parent.children.empty();
  std::ranges::move(section, std::back_inserter(parent.children));
}

}  // namespace

bool IsSaved(const FrameworkElement& element) {
  if (element.FindAnnotation<NotSaved>() != nullptr) return false;
  if (IsModule(element)) return true;
  if (element.kind() != ElementKind::kGroup) return false;
  // Those that hold nothing but threads are made with these.
  const auto is_thread = [](const FrameworkElement* child) {
    return child->kind() == ElementKind::kThread;
  };
  return element.children().empty() || !std::ranges::all_of(element.children(), is_thread);
}

Attributes ConnectAttributes(const ConnectOptions& options) {
  Attributes attributes;
  if (options.queue == 0) return attributes;
  attributes.emplace_back("queue", std::to_string(options.queue));
  if (options.on_full != OnFull::kDropOldest) {
    attributes.emplace_back("on_full", OnFullName(options.on_full));
  }
  return attributes;
}

NewElement ModuleElement(FrameworkElement& module, Saving& saving) {
  const std::string type = FindModuleType(module);
  if (type.empty()) {
    saving.Fail({.message = "this module was made by code, of a class that no file can name",
                 .path = module.path(),
                 .hint = "register its type, and make it by ModuleRegistry::Create()"});
  }
  UseModuleType(type, saving);
  NewElement made{.name = "module", .attributes = {{"name", module.name()}, {"type", type}}};
  AddSavedAttributes("module", module, saving, made);
  for (const auto& [element, configurable] : ConfigurablesOf(module)) {
    const std::string text = configurable->ToText();
    if (text == configurable->info().default_value) continue;
    saving.values[element->path()] = text;
    saving.CheckText(text, *element);
    made.children.push_back(
        {.name = "parameter",
         .attributes = {{"name", element->name()}, {"value", SavedValue(*configurable, saving)}}});
  }
  return made;
}

NewElement PortElement(const ProxyPort& port, Saving& saving) {
  saving.CheckText(port.description(), port);
  const bool is_input = port.direction() == Port::Direction::kInput;
  NewElement made{.name = "port",
                  .attributes = {{"name", port.name()},
                                 {"direction", is_input ? "input" : "output"},
                                 {"type", port.type().name()}}};
  if (!port.description().empty()) made.attributes.emplace_back("description", port.description());
  return made;
}

std::vector<NewElement> ConnectElements(FrameworkElement& home, Saving& saving) {
  std::vector<NewElement> elements;
  const SavedEdges::Edge* last = nullptr;
  for (SavedEdges::Edge* edge : saving.edges.Unsaved(home)) {
    edge->is_saved = true;
    const std::string to = PortPath(*edge->to, home, PathKind::kInput);
    if (last != nullptr && last->from == edge->from && IsSame(last->options, edge->options)) {
      elements.back().attributes[1].second += " " + to;
      continue;
    }
    last = edge;
    NewElement& made = elements.emplace_back(NewElement{
        .name = "connect",
        .attributes = {{"from", PortPath(*edge->from, home, PathKind::kOutput)}, {"to", to}}});
    for (auto& attribute : ConnectAttributes(edge->options)) {
      made.attributes.push_back(std::move(attribute));
    }
  }
  return elements;
}

NewElement SavedTagElement(const std::string& name, const SavedTag& tag) {
  NewElement made{.name = name};
  for (const SavedAttribute& attribute : tag) {
    if (!attribute.is_default) made.attributes.emplace_back(attribute.name, attribute.value);
  }
  return made;
}

std::vector<NewElement> SavedTagElements(std::string_view parent_tag, FrameworkElement& parent,
                                         Saving& saving) {
  std::vector<NewElement> elements;
  for (const std::string& name : saving.tools.tags.TagsIn(parent_tag)) {
    const XmlTag& tag = *saving.tools.tags.FindTag(name);
    if (!tag.saved) continue;
    for (const SavedTag& each : tag.saved(parent)) elements.push_back(SavedTagElement(name, each));
  }
  return elements;
}

NewElement GroupElement(std::string_view tag, FrameworkElement& group, Saving& saving) {
  NewElement made{.name = std::string(tag), .attributes = {{"name", group.name()}}};
  AddSavedAttributes(tag, group, saving, made);
  std::vector<NewElement> ports;
  std::vector<NewElement> modules;
  std::vector<NewElement> groups;
  for (FrameworkElement* child : group.children()) {
    if (const auto* port = dynamic_cast<const ProxyPort*>(child)) {
      ports.push_back(PortElement(*port, saving));
      if (tag == "application") {
        saving.Fail({.message = "a file cannot give an application an interface",
                     .path = port->path(),
                     .hint = "put it into a group"});
      }
    } else if (!IsSaved(*child)) {
      continue;
    } else if (IsModule(*child)) {
      modules.push_back(ModuleElement(*child, saving));
    } else {
      groups.push_back(GroupElement("group", *child, saving));
    }
  }
  AddSection(SavedTagElements(tag, group, saving), made);
  AddSection(std::move(ports), made);
  AddSection(std::move(modules), made);
  for (NewElement& each : groups) AddSection({std::move(each)}, made);
  AddSection(ConnectElements(group, saving), made);
  return made;
}

}  // namespace runnel::internal
