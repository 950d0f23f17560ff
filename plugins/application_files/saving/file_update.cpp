#include "plugins/application_files/saving/file_update.h"

#include <algorithm>
#include <optional>

#include "core/element/source_place.h"
#include "core/paths/distant_ports.h"
#include "core/paths/path_search.h"
#include "core/types/duration_text.h"
#include "core/types/type_info.h"
#include "core/xml/xml_reading.h"
#include "plugins/application_files/part_files.h"
#include "plugins/application_files/path_use.h"

namespace runnel::internal {

namespace {

bool LeadsSomewhere(const PathUse& use) {
  const PathEnd end = PathSearch(use.base).Follow(use.path, PathKind::kElement);
  return end.found != nullptr || IsDistantPath(use.path) || IsByRule(*end.at);
}

}  // namespace

bool MeanTheSame(const AttributeRule& rule, const std::string& one, const std::string& other) {
  const auto come_to_the_same = [&](const auto& parse) {
    const auto first = parse(one);
    const auto second = parse(other);
    return first && second && *first == *second;
  };
  if (one == other) return true;
  if (rule.kind == AttributeKind::kDuration) return come_to_the_same(ParseDuration);
  return (rule.kind == AttributeKind::kNumber || rule.kind == AttributeKind::kCount) && come_to_the_same(ParseNumber);
}

bool FileUpdate::IsMoved() const {
  return part_ == nullptr && Whole(old_folder_) != Whole(saving_.folder);
}

std::string FileUpdate::Moved(const std::string& file) const {
  return IsMoved() ? MovedFileName(file, old_folder_, saving_.folder) : file;
}

void FileUpdate::Run(XmlElement root) {
  if (NameOf(root) != saving_.application.name()) {
    editor_.SetAttribute(root, "name", saving_.application.name());
  }
  UpdateInside(root, saving_.application);
  for (const SavedEdge& edge : saving_.edges) {
    if (!edge.is_saved) touched_.insert({edge.from, edge.to});
  }
  // A port without a type takes it from its connections: with others it might take another, or none.
  for (const auto& [tag, port] : untyped_) {
    if (touched_.contains(port)) editor_.SetAttribute(tag, "type", port->type().name());
  }
  for (Inside& each : insides_) AppendMissing(each);
  FinishParts();
  AppendLoads(root);
}

void FileUpdate::UpdateInside(XmlElement tag, FrameworkElement& element) {
  Inside& inside = insides_.emplace_back(Inside{tag, element});
  for (const XmlTag* known : TagsWithin(tag.name(), saving_)) {
    if (known->saved) inside.lacking[known->name] = known->saved(element);
  }
  UpdateAddedAttributes(tag, element);
  for (const XmlElement child : tag.children()) UpdateTag(child, inside);
}

void FileUpdate::UpdateTag(XmlElement tag, Inside& around) {
  const XmlTag* const known = saving_.tools.tags.FindTag(tag.name());
  if (known == nullptr) return;
  if (known->update) return known->update(tag, around.element, *this);
  if (!known->saved) {
    if (!NamesWhatIsGone(tag, around.element)) return;
    saving_.lost += (saving_.lost.empty() ? "the file has lost <" : ", <") + std::string(tag.name()) + "> of line " +
                    std::to_string(tag.position().line) + ", which names what is gone";
    return editor_.Remove(tag);
  }
  std::vector<SavedTag>& lacking = around.lacking[tag.name()];
  // By their names, if they have any; else in order.
  const auto is_same = [&](const SavedTag& each) {
    const SavedAttribute& first = each.attributes.front();
    return first.name != "name" || first.value == NameOf(tag);
  };
  const auto found = std::ranges::find_if(lacking, is_same);
  if (found == lacking.end()) return editor_.Remove(tag);
  const SavedTag saved = std::move(*found);
  lacking.erase(found);
  UpdateAttributes(tag, *known, saved, around.element);
  if (saved.element == nullptr) return;
  const bool is_instance = saved.element->FindAnnotation<PartInstance>() != nullptr;
  is_instance ? UpdateInstance(tag, *saved.element) : UpdateInside(tag, *saved.element);
}

void FileUpdate::UpdateAttributes(XmlElement tag, const XmlTag& known, const SavedTag& saved,
                                  const FrameworkElement& about) {
  for (const AttributeRule& rule : known.attributes) {
    const auto wanted = std::ranges::find(saved.attributes, rule.name, &SavedAttribute::name);
    const XmlAttribute* const attribute = tag.Attribute(rule.name);
    if (wanted == saved.attributes.end()) {
      editor_.RemoveAttribute(tag, rule.name);
    } else if (rule.kind == AttributeKind::kPortType && attribute == nullptr) {
      // What it is connected to says it, as long as that stays.
      const auto* const port = dynamic_cast<const Port*>(saved.element);
      untyped_.emplace_back(tag, port);
      if (port->FindAnnotation<SourcePlace>() == nullptr) Touch(port);
    } else if (!wanted->is_kept &&
               (attribute != nullptr ? !MeanTheSame(rule, attribute->value, wanted->value)
                                     : !wanted->is_default)) {
      saving_.CheckAttribute(rule, wanted->value,
                             saved.element != nullptr ? *saved.element : about);
      wanted->is_default ? editor_.RemoveAttribute(tag, rule.name)
                         : editor_.SetAttribute(tag, rule.name, wanted->value);
    }
  }
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

void FileUpdate::AppendMissing(Inside& inside) {
  for (const XmlTag* known : TagsWithin(inside.tag.name(), saving_)) {
    for (const SavedTag& each : inside.lacking[known->name]) {
      editor_.Append(inside.tag, ElementOf(*known, each, inside.element, saving_));
    }
    if (!known->missing) continue;
    for (NewElement& each : known->missing(&inside.tag, inside.element, saving_, this)) {
      editor_.Append(inside.tag, std::move(each));
    }
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
