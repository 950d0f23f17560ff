#include <algorithm>

#include "core/plugin/module_type_name.h"
#include "core/types/type_info.h"
#include "plugins/application_files/file_part.h"
#include "plugins/application_files/new_elements.h"
#include "plugins/parameters/file_path.h"
#include "plugins/runtime_construction/path_use.h"
#include "plugins/runtime_construction/part_files.h"
#include "plugins/runtime_construction/source_place.h"

namespace runnel::internal {

FileUpdate::FileUpdate(Saving& saving, const ApplicationSource& source, XmlEditor& editor)
    : saving_(saving), source_(source), old_folder_(source.file.parent_path()), editor_(editor) {}

bool FileUpdate::IsMoved() const {
  if (part_ != nullptr) return false;
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
  FinishParts();
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
    is_saved&& IsModule(*element) ? UpdateModule(tag, *element) : editor_.Remove(tag);
  } else if (tag.name() == "group") {
    const bool is_instance = tag.Attribute("type") != nullptr;
    const bool fits = is_saved && !IsModule(*element) &&
                      is_instance == (element->FindAnnotation<PartInstance>() != nullptr);
    if (!fits) return editor_.Remove(tag);
    is_instance ? UpdateInstance(tag, *element) : UpdateGroup(tag, *element);
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
  if (!is_as_loaded) return WriteValue(*tag.parent(), &tag, *found);
  const XmlAttribute* const value = tag.Attribute("value");
  const bool is_file = &configurable.type() == &TypeOf<FilePath>();
  if (value != nullptr && is_file && IsMoved()) {
    editor_.SetAttribute(tag, "value", MovedFileName(value->value, old_folder_, saving_.folder));
  }
}

void FileUpdate::AddParameters(XmlElement tag, FrameworkElement& module,
                               const std::set<std::string>& named) {
  for (const ConfigurableElement& each : ConfigurablesOf(module)) {
    const std::string text = each.configurable->ToText();
    const std::string path = each.element->path();
    if (named.contains(each.element->name())) continue;
    const auto loaded = source_.values.find(path);
    const bool is_as_loaded = loaded != source_.values.end()
                                  ? loaded->second == text  // set from outside of the part
                                  : text == each.configurable->info().default_value;
    if (loaded != source_.values.end() || !is_as_loaded) saving_.values[path] = text;
    if (!is_as_loaded) WriteValue(tag, nullptr, each);
  }
}

// `tag`: of the parameter, nullptr if it has none.
void FileUpdate::WriteValue(XmlElement module_tag, const XmlElement* tag,
                            const ConfigurableElement& parameter) {
  const std::string value = SavedValue(*parameter.configurable, saving_);
  saving_.CheckText(value, *parameter.element);
  const std::string& name = parameter.element->name();
  if (part_ != nullptr) {
    const FrameworkElement* module = parameter.element->parent();
    if (!IsModule(*module)) module = module->parent();
    set_override_(module->path().substr(part_->path().size() + 1), name, value);
  } else if (tag != nullptr) {
    editor_.SetAttribute(*tag, "value", value);
  } else {
    editor_.Append(module_tag,
                   {.name = "parameter", .attributes = {{"name", name}, {"value", value}}});
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
  Port* const from = FindPort(PathIn(from_list, group), PathKind::kOutput);
  const std::vector<PathUse> targets = PathsIn(to_list, group);
  std::set<std::size_t> gone;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    Port* const to = FindPort(targets[i], PathKind::kInput);
    if (!SaysConnection(tag, from, to, targets.size() == 1)) gone.insert(i);
  }
  if (gone.size() == targets.size()) {
    editor_.Remove(tag);
  } else {
    editor_.RemoveWords(to_list, gone);
  }
}

namespace {

bool AreConnected(const Port* from, const Port* to) {
  if (from == nullptr || to == nullptr) return false;
  return std::ranges::find(from->outgoing(), to, &Connection::to) != from->outgoing().end();
}

}  // namespace

bool FileUpdate::SaysConnection(XmlElement tag, Port* from, Port* to, bool is_only_one) {
  SavedEdges::Edge* const edge =
      from != nullptr && to != nullptr ? saving_.edges.Find(*from, *to) : nullptr;
  // One that leads out of the application is left to whoever wrote it.
  if (edge == nullptr && AreConnected(from, to)) return true;
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

void FileUpdate::AppendNew(XmlElement tag, FrameworkElement& group) {
  for (FrameworkElement* child : group.children()) {
    if (has_tag_.contains(child)) continue;
    if (const auto* port = dynamic_cast<const ProxyPort*>(child)) {
      editor_.Append(tag, PortElement(*port, saving_));
    } else if (IsSaved(*child)) {
      editor_.Append(tag, IsModule(*child) ? ModuleElement(*child, saving_)
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

}  // namespace runnel::internal
