#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "core/base/nearest_name.h"
#include "core/element/file_notes.h"
#include "core/module/group_parameter.h"
#include "core/plugin/module_type_name.h"
#include "plugins/application_files/build_context.h"
#include "plugins/application_files/path_use.h"
#include "plugins/application_files/saving/file_update.h"
#include "plugins/application_tags/tag_list.h"
#include "plugins/parameters/configuration.h"
#include "plugins/parameters/configuration_saver.h"
#include "plugins/parameters/file_path.h"
#include "plugins/parameters/value_to_save.h"
#include "plugins/structure/renamed_text.h"

namespace runnel {

namespace {

constexpr auto kNameOfDeclared = &std::pair<const std::string, TagUse>::first;

bool HaveSame(std::string_view attribute, XmlElement one, XmlElement other) {
  const XmlAttribute* const first = one.Attribute(attribute);
  const XmlAttribute* const second = other.Attribute(attribute);
  if (first == nullptr || second == nullptr) return first == second;
  return first->value == second->value;
}

bool IsFirstOfItsName(const TagUse& use) {
  for (const XmlElement sibling : use.xml.parent()->children()) {
    if (sibling == use.xml) return true;
    const XmlAttribute* const name = sibling.Attribute("name");
    if (sibling.name() != use.xml.name() || name == nullptr) continue;
    if (name->value != use.Get("name").value || !HaveSame("of", sibling, use.xml)) continue;
    use.context.Report({.message = "the parameter '" + name->value + "' is set twice",
                        .hint = "the first is in line " + std::to_string(sibling.position().line)},
                       use.Get("name").value_position, use.parent);
    return false;
  }
  return true;
}

void CheckSources(const TagUse& use) {
  const bool sets_something = use.Find("value") || use.Find("config") || use.Find("command_line") || use.Find("from");
  if (!sets_something) {
    use.context.Report({.message = "<parameter> does not say where the value comes from",
                        .hint = "add value=\"…\", config=\"…\" or command_line=\"…\""},
                       use.xml.position(), use.parent);
  }
  const XmlAttribute* const from = use.Find("from");
  if (from != nullptr && use.Find("value")) {
    use.context.Report(
        {.message = "a value and a parameter that it comes from", .hint = "leave out one of value and from"},
        from->position, use.parent);
  }
}

void RefuseAttribute(std::string_view name, std::string hint, const TagUse& use) {
  const XmlAttribute* const attribute = use.xml.Attribute(name);
  if (attribute == nullptr) return;
  use.context.Report({.message = "'" + std::string(name) + "' has no meaning here", .hint = std::move(hint)},
                     attribute->position, use.parent);
}

// In a <group_type>: without a value it has to be given where the file is used.
void Declare(const TagUse& use, PartUse& part) {
  RefuseAttribute("from", "leave it out: where the file is used, it may be said", use);
  RefuseAttribute("of", "leave it out", use);
  RefuseAttribute("to", "leave it out: what takes its value names it by from", use);
  if (!IsFirstOfItsName(use)) return;
  part.declared.emplace(use.Get("name").value, use);
}

// In a group whose type is a file: of one of its parameters, or, with `of`, of a module in it.
void Give(const TagUse& use, PartUse& part) {
  CheckSources(use);
  if (!IsFirstOfItsName(use)) return;
  const XmlAttribute& name = use.Get("name");
  if (const XmlAttribute* of = use.Find("of")) {
    use.context.Defer(BuildStage::kParameters, [use, of] {
      const FrameworkElement* const module = SearchElement(PathIn(*of, use.parent), use.context);
      if (module == nullptr) return;
      if (module->IsAtOrBelow(use.parent)) {
        return internal::SetValue(use, *module, *use.parent.parent());
      }
      // It may even be of another application, which a failed build could not give its value back.
      use.context.Report({.message = module->path() + " is not within this group",
                          .hint = "set its parameters where it stands itself"},
                         of->value_position, use.parent);
    });
    return;
  }
  if (part.declared.contains(name.value)) {
    part.given.emplace(name.value, use);
    return;
  }
  use.context.Report({.message = part.root.position().file + " has no parameter '" + name.value + "'",
                      .hint = NearestNameHint(name.value, NamesOf(part.declared, kNameOfDeclared))},
                     name.value_position, use.parent);
}

// In any other group: stands for parameters of what is within, and may have a value for them. `may_wait`: modules may
// make them yet.
void MakeGroupParameter(const TagUse& use, const XmlAttribute& to, bool may_wait = true) {
  const auto is_missing = [](const PathUse& each) {
    return !PathSearch(each.base).Find(each.path, PathKind::kParameter);
  };
  const std::vector<PathUse> uses = PathsIn(to, use.parent);
  if (may_wait && std::ranges::any_of(uses, is_missing)) {
    return use.context.Defer(BuildStage::kConstruction, [use, &to] { MakeGroupParameter(use, to, false); });
  }
  if (!use.HasFreeName(use.parent)) return;
  std::vector<std::string> targets;
  std::vector<FrameworkElement*> found;
  for (const PathUse& target : uses) {
    FrameworkElement* const element = SearchElement(target, use.context, PathKind::kParameter);
    if (element == nullptr) return;
    if (dynamic_cast<const Configurable*>(element) == nullptr) {
      return use.context.Report({.message = element->path() + " is not a parameter"}, target.position, use.parent);
    }
    targets.push_back(target.path);
    found.push_back(element);
  }
  auto& made = use.context.runtime().Create<GroupParameter>(use.parent, use.Get("name").value, std::move(targets));
  made.Annotate(std::make_unique<SourcePlace>(use.xml.position()));
  const bool has_value = use.Find("value") || use.Find("config") || use.Find("command_line");
  if (!has_value) return;
  internal::SetValue(use, use.parent, use.parent);
  for (FrameworkElement* each : found) internal::NoteLoaded({each, dynamic_cast<Configurable*>(each)});
}

FrameworkElement* HandleParameter(const TagUse& use) {
  if (PartUse* part = use.context.parts().Find(use.parent)) {
    use.xml.parent() == part->root ? Declare(use, *part) : Give(use, *part);
    return &use.parent;
  }
  if (use.parent.kind() == ElementKind::kGroup && !IsModule(use.parent)) {
    const bool has_type = use.xml.parent()->Attribute("type") != nullptr;
    if (has_type) return &use.parent;  // the file could not be read
    if (const XmlAttribute* const to = use.Find("to")) {
      RefuseAttribute("of", "leave it out: `to` says what is meant", use);
      RefuseAttribute("from", "leave it out: `to` says what is meant", use);
      // Behind what the modules within say themselves.
      use.context.Defer(BuildStage::kParameters, [use, to] {
        use.context.Defer(BuildStage::kParameters, [use, to] { MakeGroupParameter(use, *to); });
      });
      return &use.parent;
    }
    use.context.Report({.message = "a parameter of a group without a type says what it stands for",
                        .hint = "add to=\"module/parameter\", or write it into a module"},
                       use.xml.position(), use.parent);
    return &use.parent;
  }
  CheckSources(use);
  RefuseAttribute("to", "leave it out: it belongs to the module round it", use);
  RefuseAttribute("of", "leave it out: the module round it is meant", use);
  if (IsFirstOfItsName(use)) {
    use.context.Defer(BuildStage::kParameters, [use] { internal::SetValue(use, use.parent, use.parent); });
  }
  return &use.parent;
}

// Saving. What came from the command line or a configuration is theirs, as long as it is as it was loaded.

bool IsAsLoaded(const ConfigurableElement& parameter, const std::string* loaded) {
  const std::string text = TextToSave(*parameter.element, *parameter.configurable);
  return text == (loaded != nullptr ? *loaded : parameter.configurable->info().default_value);
}

// The entry of the configuration from which it has its value, if by other names round it the section leads to another
// one.
const std::string* LostEntry(const FrameworkElement& parameter) {
  const auto* const entry = parameter.FindAnnotation<ConfigurationEntry>();
  const FrameworkElement* const section = ConfigurationSection::FindAround(parameter);
  if (entry == nullptr || section == nullptr || LoadedValue::Of(parameter) == nullptr) return nullptr;
  const FrameworkElement* at = parameter.parent();
  while (at != section && NameInFile::Of(*at) == at->name()) at = at->parent();
  return at != section ? &entry->path : nullptr;
}

bool HasTag(XmlElement module_tag, const FrameworkElement& module, const FrameworkElement& parameter) {
  return std::ranges::any_of(module_tag.children(), [&](XmlElement child) {
    return child.name() == "parameter" && FindConfigurable(module, internal::NameOf(child)).element == &parameter;
  });
}

// Of a group that no file describes.
void UpdateGroupParameter(XmlElement tag, FrameworkElement& group, internal::FileUpdate& update) {
  if (tag.Attribute("to") == nullptr || group.FindAnnotation<PartInstance>() != nullptr) return;
  auto* const parameter = dynamic_cast<GroupParameter*>(group.FindChild(internal::NameOf(tag)));
  if (parameter == nullptr) return update.editor().Remove(tag);
  const std::string* const loaded = LoadedValue::Of(*parameter);
  if (loaded == nullptr) return;
  const std::string value = internal::SavedValue(*parameter, *parameter, update.saving());
  update.saving().values[parameter] = TextToSave(*parameter, *parameter);
  if (value != *loaded) update.editor().SetAttribute(tag, "value", value);
}

// Also of one that a file has described, where all is written into one.
std::vector<NewElement> MissingGroupParameters(const XmlElement* tag, FrameworkElement& group) {
  std::vector<NewElement> missing;
  for (const FrameworkElement* child : group.children()) {
    const auto* const parameter = dynamic_cast<const GroupParameter*>(child);
    if (parameter == nullptr) continue;
    if (tag != nullptr && HasTag(*tag, group, *parameter)) continue;
    std::string targets;
    for (const std::string& each : parameter->targets()) targets += (targets.empty() ? "" : " ") + each;
    missing.push_back({.name = "parameter", .attributes = {{"name", child->name()}, {"to", targets}}});
  }
  return missing;
}

void UpdateParameter(XmlElement tag, FrameworkElement& module, internal::FileUpdate& update) {
  if (!IsModule(module)) return UpdateGroupParameter(tag, module, update);
  const ConfigurableElement parameter = FindConfigurable(module, internal::NameOf(tag));
  if (!parameter) return internal::IsByRule(module) ? void() : update.editor().Remove(tag);
  const std::string& name = parameter.element->name();
  if (name != internal::NameOf(tag) && !update.is_of_part()) update.editor().SetAttribute(tag, "name", name);
  const std::string* const loaded = LoadedValue::Of(*parameter.element);
  update.saving().values[parameter.element] = TextToSave(*parameter.element, *parameter.configurable);
  const bool names_entry = tag.Attribute("config") != nullptr || tag.Attribute("from") != nullptr;
  const std::string* const entry = names_entry ? nullptr : LostEntry(*parameter.element);
  if (loaded == nullptr || !IsAsLoaded(parameter, loaded) || (entry != nullptr && update.is_of_part())) {
    const std::string value = internal::SavedValue(*parameter.element, *parameter.configurable, update.saving());
    update.saving().CheckText(value, *parameter.element);
    if (update.OverrideValue(*parameter.element, value)) return;
    return update.editor().SetAttribute(tag, "value", value);
  }
  if (entry != nullptr) update.editor().SetAttribute(tag, "config", *entry);
  const XmlAttribute* const value = tag.Attribute("value");
  const bool is_file = &parameter.configurable->type() == &TypeOf<FilePath>();
  if (value == nullptr || !is_file) return;
  const std::string moved = update.Moved(value->value);
  if (moved != value->value) update.editor().SetAttribute(tag, "value", moved);
}

std::vector<NewElement> MissingParameters(const XmlElement* tag, FrameworkElement& module, internal::Saving& saving,
                                          internal::FileUpdate* update) {
  if (!IsModule(module)) return MissingGroupParameters(tag, module);
  std::vector<NewElement> missing;
  for (const ConfigurableElement& each : ConfigurablesOf(module)) {
    if (tag != nullptr && HasTag(*tag, module, *each.element)) continue;
    // It may have been set from outside of the part that the module is in.
    const std::string* const loaded = update != nullptr ? LoadedValue::Of(*each.element) : nullptr;
    if (loaded == nullptr && internal::IsByRule(module) && each.element->FindAnnotation<MadeByRule>() == nullptr)
      continue;
    const bool is_as_loaded = IsAsLoaded(each, loaded);
    if (loaded != nullptr || !is_as_loaded) saving.values[each.element] = TextToSave(*each.element, *each.configurable);
    const std::string* const entry = is_as_loaded && loaded != nullptr ? LostEntry(*each.element) : nullptr;
    if (is_as_loaded && entry == nullptr) continue;
    const std::string value = internal::SavedValue(*each.element, *each.configurable, saving);
    saving.CheckText(value, *each.element);
    if (update != nullptr && update->OverrideValue(*each.element, value)) continue;
    missing.push_back({.name = "parameter",
                       .attributes = {{"name", each.element->name()},
                                      {entry != nullptr ? "config" : "value", entry != nullptr ? *entry : value}}});
  }
  const auto* const made = internal::IsByRule(module) ? module.FindAnnotation<MadeByRule>() : nullptr;
  const auto tags = tag != nullptr ? tag->children() : decltype(tag->children())();
  for (const auto& [name, value] : made != nullptr ? made->lacking : MadeByRule::Lacking()) {
    if (value.first == value.second || FindConfigurable(module, name)) continue;
    const auto is_it = [&name = name](XmlElement each) {
      return each.name() == "parameter" && internal::NameOf(each) == name;
    };
    const auto said = std::ranges::find_if(tags, is_it);
    said != tags.end()
        ? update->editor().SetAttribute(*said, "value", value.first)
        : missing.push_back({.name = "parameter", .attributes = {{"name", name}, {"value", value.first}}});
  }
  return missing;
}

}  // namespace

XmlTag ParameterTag() {
  return {
      .name = "parameter",
      .summary = "sets a parameter of its module or group",
      .parents = {"module", "group", "group_type"},
      .attributes = {{.name = "name", .kind = AttributeKind::kName, .required = true},
                     KindRule("of", AttributeKind::kPath, "in a group whose type is a file: the module in it"),
                     KindRule("to", AttributeKind::kPathList,
                              "in a group without a type: the parameters within that it stands for"),
                     KindRule("from", AttributeKind::kName, "the parameter of the <group_type> whose value it takes"),
                     {.name = "value",
                      .summary = "in text format; a number may have another unit of the same kind, as in 15 cm"},
                     KindRule("config", AttributeKind::kPath,
                              "the entry of the configuration file that beats the value"),
                     KindRule("command_line", AttributeKind::kName, "the name on the command line that beats both")},
      .handle = HandleParameter,
      .update = UpdateParameter,
      .missing = MissingParameters};
}

}  // namespace runnel
