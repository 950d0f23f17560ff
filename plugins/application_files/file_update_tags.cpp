// Tags and attributes that others have added, and <load>.

#include <algorithm>
#include <optional>

#include "core/types/duration_text.h"
#include "core/xml/xml_reading.h"
#include "plugins/application_files/file_part.h"
#include "plugins/application_files/new_elements.h"
#include "plugins/runtime_construction/path_use.h"

namespace runnel::internal {

namespace {

bool LeadsSomewhere(const PathUse& use) {
  return PathSearch(use.base).Follow(use.path, PathKind::kElement).found != nullptr;
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

// Whether something that the tag names, or one within, is gone.
bool FileUpdate::NamesWhatIsGone(XmlElement tag, FrameworkElement& parent) const {
  const XmlTag* const known = saving_.tools.tags.FindTag(tag.name());
  if (known == nullptr) return false;
  for (const AttributeRule& rule : saving_.tools.tags.Rules(*known)) {
    const XmlAttribute* const attribute = tag.Attribute(rule.name);
    if (!rule.names_element || attribute == nullptr) continue;
    if (!std::ranges::all_of(PathsIn(*attribute, parent), LeadsSomewhere)) return true;
  }
  return std::ranges::any_of(tag.children(),
                             [&](XmlElement child) { return NamesWhatIsGone(child, parent); });
}

// What says itself what has to be there comes later; the rest stays, unless it names what is gone.
void FileUpdate::UpdateOther(XmlElement tag, FrameworkElement& parent) {
  const XmlTag* const known = saving_.tools.tags.FindTag(tag.name());
  if (known == nullptr || known->saved) return;
  if (NamesWhatIsGone(tag, parent)) editor_.Remove(tag);
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
