#include "plugins/application_files/saving/saving.h"

#include <algorithm>

#include "core/base/characters.h"
#include "core/element/file_notes.h"
#include "core/plugin/module_type_name.h"
#include "plugins/parameters/value_to_save.h"

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

}  // namespace runnel::internal
