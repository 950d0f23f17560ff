#include "plugins/application_files/file_update.h"

#include <algorithm>

#include "core/plugin/module_type_name.h"
#include "core/types/duration_text.h"
#include "core/types/type_info.h"
#include "core/xml/xml_reading.h"
#include "plugins/application_files/new_elements.h"
#include "plugins/parameters/file_path.h"
#include "plugins/runtime_construction/configurable_search.h"
#include "plugins/runtime_construction/path_walk.h"
#include "plugins/runtime_construction/source_place.h"

namespace runnel::internal {

namespace {

std::string NameOf(XmlElement tag) {
  const XmlAttribute* const name = tag.Attribute("name");
  return name != nullptr ? name->value : "";
}

// Also where a short path leads.
bool LeadsSomewhere(const PathUse& use) {
  const PathWalk walk(use);
  if (walk.missing().empty()) return true;
  if (!walk.misses_only_the_last() || !IsSavedModule(walk.at())) return false;
  const auto is_named = [&](const ConfigurableElement& each) {
    return each.element->name() == walk.missing();
  };
  return std::ranges::any_of(ConfigurablesOf(walk.at()), is_named) ||
         FindPort(use, ConnectionEnd::kTo) != nullptr;
}

}  // namespace

bool MeanTheSame(const AttributeRule& rule, const std::string& one, const std::string& other) {
  if (one == other) return true;
  if (rule.kind == AttributeKind::kDuration) {
    const auto first = ParseDuration(one);
    const auto second = ParseDuration(other);
    return first && second && *first == *second;
  }
  if (rule.kind == AttributeKind::kNumber || rule.kind == AttributeKind::kCount) {
    const auto first = ParseNumber(one);
    const auto second = ParseNumber(other);
    return first && second && *first == *second;
  }
  return false;
}

FileUpdate::FileUpdate(Saving& saving, const ApplicationSource& source, XmlEditor& editor)
    : saving_(saving), source_(source), old_folder_(source.file.parent_path()), editor_(editor) {}

bool FileUpdate::IsMoved() const {
  std::error_code ignored;
  const auto whole = [&](const std::filesystem::path& folder) {
    return std::filesystem::weakly_canonical(std::filesystem::absolute(folder, ignored), ignored);
  };
  return whole(old_folder_) != whole(saving_.folder);
}

void FileUpdate::Run(XmlElement root) {
  if (NameOf(root) != saving_.application.name()) {
    editor_.SetAttribute(root, "name", saving_.application.name());
  }
  UpdateGroup(root, saving_.application);
  for (const SavedEdges::Edge* edge : saving_.edges.Unsaved()) {
    touched_.insert({edge->from, edge->to});
  }
  GiveTypes();
  for (const auto& [tag, group] : groups_) AppendNew(tag, *group);
  AppendLoads(root);
}

void FileUpdate::UpdateGroup(XmlElement tag, FrameworkElement& group) {
  groups_.emplace_back(tag, &group);
  has_tag_.insert(&group);
  UpdateAddedAttributes(tag, group);
  for (const XmlElement child : tag.children()) UpdateChild(child, group);
  UpdateSavedTags(tag, group);
}

void FileUpdate::UpdateChild(XmlElement tag, FrameworkElement& group) {
  FrameworkElement* const element = group.FindChild(NameOf(tag));
  const bool is_saved = element != nullptr && IsSaved(*element);
  if (tag.name() == "module") {
    is_saved&& IsSavedModule(*element) ? UpdateModule(tag, *element) : editor_.Remove(tag);
  } else if (tag.name() == "group") {
    is_saved && !IsSavedModule(*element) ? UpdateGroup(tag, *element) : editor_.Remove(tag);
  } else if (tag.name() == "port") {
    UpdatePort(tag, group);
  } else if (tag.name() == "connect") {
    UpdateConnect(tag, group);
  } else if (tag.name() == "load") {
    UpdateLoad(tag);
  } else {
    UpdateOther(tag, group);
  }
}

void FileUpdate::UpdateModule(XmlElement tag, FrameworkElement& module) {
  has_tag_.insert(&module);
  const std::string type = FindModuleType(module);
  if (type.empty()) {
    saving_.Fail({.message = "this module was made by code, of a class that no file can name",
                  .path = module.path(),
                  .hint = "register its type, and make it by ModuleRegistry::Create()"});
    return;
  }
  if (tag.Attribute("type")->value != type) {
    editor_.SetAttribute(tag, "type", type);
    UseModuleType(type, saving_);
  }
  UpdateAddedAttributes(tag, module);
  std::set<std::string> named;
  for (const XmlElement child : tag.children()) {
    if (child.name() == "parameter") {
      UpdateParameter(child, module, named);
    } else {
      UpdateOther(child, module);
    }
  }
  AddParameters(tag, module, named);
}

void FileUpdate::UpdateParameter(XmlElement tag, FrameworkElement& module,
                                 std::set<std::string>& named) {
  const std::string name = NameOf(tag);
  const std::vector<ConfigurableElement> all = ConfigurablesOf(module);
  const auto found = std::ranges::find_if(
      all, [&](const ConfigurableElement& each) { return each.element->name() == name; });
  if (found == all.end()) return editor_.Remove(tag);
  named.insert(name);
  const Configurable& configurable = *found->configurable;
  const std::string text = configurable.ToText();
  const std::string path = found->element->path();
  saving_.values[path] = text;
  const auto loaded = source_.values.find(path);
  const bool is_as_loaded = loaded != source_.values.end() && loaded->second == text;
  if (!is_as_loaded) return editor_.SetAttribute(tag, "value", SavedValue(configurable, saving_));
  const XmlAttribute* const value = tag.Attribute("value");
  const bool is_file = &configurable.type() == &TypeOf<FilePath>();
  if (value != nullptr && is_file && IsMoved()) {
    editor_.SetAttribute(tag, "value", MovedFileName(value->value, old_folder_, saving_.folder));
  }
}

void FileUpdate::AddParameters(XmlElement tag, FrameworkElement& module,
                               const std::set<std::string>& named) {
  for (const auto& [element, configurable] : ConfigurablesOf(module)) {
    const std::string text = configurable->ToText();
    if (named.contains(element->name()) || text == configurable->info().default_value) continue;
    saving_.values[element->path()] = text;
    editor_.Append(tag, {.name = "parameter",
                         .attributes = {{"name", element->name()},
                                        {"value", SavedValue(*configurable, saving_)}}});
  }
}

void FileUpdate::UpdatePort(XmlElement tag, FrameworkElement& group) {
  const auto* const port = dynamic_cast<const ProxyPort*>(group.FindChild(NameOf(tag)));
  if (port == nullptr) return editor_.Remove(tag);
  has_tag_.insert(port);
  const bool is_input = port->direction() == Port::Direction::kInput;
  editor_.SetAttribute(tag, "direction", is_input ? "input" : "output");
  const XmlAttribute* const type = tag.Attribute("type");
  if (type != nullptr) {
    editor_.SetAttribute(tag, "type", port->type().name());
  } else {
    untyped_.emplace_back(tag, port);
    if (port->FindAnnotation<SourcePlace>() == nullptr) touched_.insert(port);
  }
}

void FileUpdate::UpdateConnect(XmlElement tag, FrameworkElement& group) {
  const XmlAttribute& from_list = *tag.Attribute("from");
  const XmlAttribute& to_list = *tag.Attribute("to");
  Port* const from = FindPort(PathIn(from_list, group), ConnectionEnd::kFrom);
  const std::vector<PathUse> targets = PathsIn(to_list, group);
  std::set<std::size_t> gone;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    Port* const to = FindPort(targets[i], ConnectionEnd::kTo);
    if (!SaysConnection(tag, from, to, targets.size() == 1)) gone.insert(i);
  }
  if (gone.size() == targets.size()) {
    editor_.Remove(tag);
  } else {
    editor_.RemoveWords(to_list, gone);
  }
}

bool FileUpdate::SaysConnection(XmlElement tag, Port* from, Port* to, bool is_only_one) {
  SavedEdges::Edge* const edge =
      from != nullptr && to != nullptr ? saving_.edges.Find(*from, *to) : nullptr;
  if (edge == nullptr || edge->is_saved) {
    touched_.insert({from, to});
    return false;
  }
  const XmlAttribute* const queue = tag.Attribute("queue");
  const XmlAttribute* const on_full = tag.Attribute("on_full");
  const Attributes wanted = ConnectAttributes(edge->options);
  const std::string wanted_queue = wanted.empty() ? "0" : wanted[0].second;
  const std::string wanted_on_full = wanted.size() < 2 ? "drop_oldest" : wanted[1].second;
  const bool is_as_wanted = MeanTheSame({.name = "queue", .kind = AttributeKind::kCount},
                                        queue != nullptr ? queue->value : "0", wanted_queue) &&
                            (on_full != nullptr ? on_full->value : "drop_oldest") == wanted_on_full;
  if (!is_as_wanted) {
    if (!is_only_one) return false;
    if (wanted.empty()) editor_.RemoveAttribute(tag, "queue");
    if (wanted.size() < 2) editor_.RemoveAttribute(tag, "on_full");
    for (const auto& [name, value] : wanted) editor_.SetAttribute(tag, name, value);
  }
  edge->is_saved = true;
  return true;
}

void FileUpdate::UpdateAddedAttributes(XmlElement tag, FrameworkElement& element) {
  for (const AddedAttribute* added : saving_.tools.tags.AddedAttributes(tag.name())) {
    if (!added->saved) continue;
    const std::string value = added->saved(element);
    const XmlAttribute* const known = tag.Attribute(added->rule.name);
    if (value.empty()) {
      editor_.RemoveAttribute(tag, added->rule.name);
    } else if (known == nullptr || !MeanTheSame(added->rule, known->value, value)) {
      editor_.SetAttribute(tag, added->rule.name, value);
    }
  }
}

// What says itself what has to be there comes later; the rest stays, unless what it names is gone.
void FileUpdate::UpdateOther(XmlElement tag, FrameworkElement& parent) {
  const XmlTag* const known = saving_.tools.tags.FindTag(tag.name());
  if (known == nullptr || known->saved) return;
  for (const AttributeRule& rule : saving_.tools.tags.Rules(*known)) {
    const XmlAttribute* const attribute = tag.Attribute(rule.name);
    if (!rule.names_element || attribute == nullptr) continue;
    if (!std::ranges::all_of(PathsIn(*attribute, parent), LeadsSomewhere)) {
      return editor_.Remove(tag);
    }
  }
}

void FileUpdate::UpdateSavedTags(XmlElement tag, FrameworkElement& parent) {
  for (const std::string& name : saving_.tools.tags.TagsIn(tag.name())) {
    const XmlTag& known = *saving_.tools.tags.FindTag(name);
    if (!known.saved) continue;
    std::vector<SavedTag> wanted = known.saved(parent);
    for (const XmlElement child : tag.children()) {
      if (child.name() != name) continue;
      // By their names, if they have any; else in order.
      const auto is_same = [&](const SavedTag& each) {
        return each.front().name != "name" || each.front().value == NameOf(child);
      };
      const auto found = std::ranges::find_if(wanted, is_same);
      if (found == wanted.end()) {
        editor_.Remove(child);
      } else {
        UpdateSavedTag(child, *found);
        wanted.erase(found);
      }
    }
    for (const SavedTag& each : wanted) editor_.Append(tag, SavedTagElement(name, each));
  }
}

void FileUpdate::UpdateSavedTag(XmlElement tag, const SavedTag& saved) {
  const XmlTag& known = *saving_.tools.tags.FindTag(tag.name());
  for (const AttributeRule& rule : saving_.tools.tags.Rules(known)) {
    const auto wanted = std::ranges::find(saved, rule.name, &SavedAttribute::name);
    const XmlAttribute* const attribute = tag.Attribute(rule.name);
    if (wanted == saved.end()) {
      editor_.RemoveAttribute(tag, rule.name);
    } else if (attribute != nullptr ? !MeanTheSame(rule, attribute->value, wanted->value)
                                    : !wanted->is_default) {
      editor_.SetAttribute(tag, rule.name, wanted->value);
    }
  }
}

void FileUpdate::UpdateLoad(XmlElement tag) {
  const std::string& plugin = tag.Attribute("plugin")->value;
  const bool is_file = plugin.find('/') != std::string::npos;
  loads_.insert(is_file ? std::filesystem::path(plugin).stem().string() : plugin);
  if (!is_file || !IsMoved()) return;
  std::string moved = MovedFileName(plugin, old_folder_, saving_.folder);
  if (moved.find('/') == std::string::npos) moved.insert(0, "./");
  editor_.SetAttribute(tag, "plugin", moved);
}

void FileUpdate::AppendNew(XmlElement tag, FrameworkElement& group) {
  for (FrameworkElement* child : group.children()) {
    if (has_tag_.contains(child)) continue;
    if (const auto* port = dynamic_cast<const ProxyPort*>(child)) {
      editor_.Append(tag, PortElement(*port));
    } else if (IsSaved(*child)) {
      editor_.Append(tag, IsSavedModule(*child) ? ModuleElement(*child, saving_)
                                                : GroupElement("group", *child, saving_));
    }
  }
  for (NewElement& connect : ConnectElements(group, saving_)) {
    editor_.Append(tag, std::move(connect));
  }
}

// A port without a type takes it from its connections: with others it might take another, or none.
void FileUpdate::GiveTypes() {
  for (const auto& [tag, port] : untyped_) {
    if (touched_.contains(port)) editor_.SetAttribute(tag, "type", port->type().name());
  }
}

void FileUpdate::AppendLoads(XmlElement root) {
  std::optional<XmlElement> last;
  for (const XmlElement child : root.children()) {
    if (child.name() == "load") last = child;
  }
  for (const std::string& plugin : saving_.plugins) {
    if (loads_.contains(plugin)) continue;
    const NewElement load{.name = "load", .attributes = {{"plugin", plugin}}};
    if (last) {
      editor_.InsertAfter(*last, load);
    } else {
      editor_.InsertFirst(root, load);
    }
  }
}

}  // namespace runnel::internal
