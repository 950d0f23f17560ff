#include "plugins/application_files/saving/file_update.h"

#include <algorithm>
#include <optional>

#include "core/element/file_notes.h"
#include "core/paths/distant_ports.h"
#include "core/paths/path_search.h"
#include "core/plugin/module_type_name.h"
#include "core/types/duration_text.h"
#include "core/types/type_info.h"
#include "core/xml/xml_reading.h"
#include "plugins/application_files/part_files.h"
#include "plugins/application_files/path_use.h"
#include "plugins/parameters/file_path.h"

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

bool FileUpdate::IsMoved() const { return part_ == nullptr && Whole(old_folder_) != Whole(saving_.folder); }

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
               (attribute != nullptr ? !MeanTheSame(rule, attribute->value, wanted->value) : !wanted->is_default)) {
      saving_.CheckAttribute(rule, wanted->value, saved.element != nullptr ? *saved.element : about);
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
  return std::ranges::any_of(tag.children(), [&](XmlElement child) { return NamesWhatIsGone(child, parent); });
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

// Groups that other files describe.

/// The inside of one group that another file describes.
struct FileUpdate::Part {
  Part(XmlDocument parsed, const std::string& text, Saving& saving, const ApplicationSource& source)
      : document(std::move(parsed)), editor(document, text), update(saving, source, editor) {}

  XmlDocument document;
  XmlEditor editor;
  FileUpdate update;
};

FileUpdate::FileUpdate(Saving& saving, const ApplicationSource& source, XmlEditor& editor)
    : saving_(saving), source_(source), old_folder_(source.file.parent_path()), editor_(editor) {}

FileUpdate::~FileUpdate() = default;

namespace {

bool IsFileName(const Result<FrameworkElement*>& module, const std::string& name) {
  if (!module) return false;
  return std::ranges::any_of(ConfigurablesOf(**module), [&](const ConfigurableElement& each) {
    return each.element->name() == name && &each.configurable->type() == &TypeOf<FilePath>();
  });
}

// Whether something within takes the name of a file from the parameter of its part.
bool NamesFile(const std::string& parameter, XmlElement tag, FrameworkElement& element) {
  for (const XmlElement child : tag.children()) {
    const XmlAttribute* const from = child.Attribute("from");
    if (from != nullptr && from->value == parameter && IsFileName(&element, NameOf(child))) {
      return true;
    }
    FrameworkElement* const inner = element.FindChild(NameOf(child));
    if (inner != nullptr && NamesFile(parameter, child, *inner)) return true;
  }
  return false;
}

}  // namespace

void FileUpdate::UpdateInstance(XmlElement tag, FrameworkElement& group) {
  UpdateAddedAttributes(tag, group);
  const std::string& file = group.FindAnnotation<PartInstance>()->file;
  const auto text = source_.parts.find(file);
  if (text == source_.parts.end()) {
    return saving_.Fail({.message = "what " + file + " said is not known any more", .path = group.path()});
  }
  auto document = XmlDocument::Parse(text->second, file);
  if (!document) return saving_.Fail(document.error());
  Part& part = *parts_.emplace_back(std::make_unique<Part>(std::move(*document), text->second, saving_, source_));
  const XmlElement root = part.document.root();
  SetOverride set = set_override_;
  if (part_ == nullptr) {
    if (IsMoved()) MoveFileNames(tag, root, group);
    set = [this, tag](const std::string& module, const std::string& name, const std::string& value) {
      Override(tag, module, name, value);
    };
  }
  part.update.part_ = part_ == nullptr ? &group : part_;
  part.update.set_override_ = std::move(set);
  part.update.UpdateInside(root, group);
  loads_.insert(part.update.loads_.begin(), part.update.loads_.end());
}

bool FileUpdate::OverrideValue(const FrameworkElement& parameter, const std::string& value) {
  if (part_ == nullptr) return false;
  const FrameworkElement* module = parameter.parent();
  if (!IsModule(*module)) module = module->parent();
  set_override_(module->path().substr(part_->path().size() + 1), parameter.name(), value);
  return true;
}

// Under the outermost group that a file describes, where it beats what that file says.
void FileUpdate::Override(XmlElement tag, const std::string& module, const std::string& name,
                          const std::string& value) {
  for (const XmlElement child : tag.children()) {
    const XmlAttribute* const of = child.Attribute("of");
    if (of == nullptr || of->value != module || NameOf(child) != name) continue;
    editor_.RemoveAttribute(child, "from");
    editor_.SetAttribute(child, "value", value);
    return;
  }
  editor_.Append(tag, {.name = "parameter", .attributes = {{"of", module}, {"name", name}, {"value", value}}});
}

void FileUpdate::FinishParts() {
  for (const auto& part : parts_) {
    FileUpdate& update = part->update;
    for (Inside& each : update.insides_) update.AppendMissing(each);
    update.FinishParts();
    if (!part->editor.has_changes()) continue;
    const FrameworkElement& group = update.insides_.front().element;
    const std::string& file = group.FindAnnotation<PartInstance>()->file;
    saving_.Fail(
        {.message = "what is in this group has been changed, but " + file + " says what is in all groups of its type",
         .path = group.path(),
         .hint = "values of parameters can be saved for one group; write the rest into " + file});
  }
}

// In an instance that is written into another folder: the names of its file, and of those that it
// gives to modules within.
void FileUpdate::MoveFileNames(XmlElement tag, XmlElement root, FrameworkElement& group) {
  const auto move = [&](XmlElement element, std::string_view name) {
    const XmlAttribute* const known = element.Attribute(name);
    if (known != nullptr) editor_.SetAttribute(element, name, Moved(known->value));
  };
  move(tag, "type");
  for (const XmlElement child : tag.children()) {
    const XmlAttribute* const of = child.Attribute("of");
    const std::string name = NameOf(child);
    const bool is_file = of != nullptr ? IsFileName(group.Find(of->value), name) : NamesFile(name, root, group);
    if (is_file) move(child, "value");
  }
}

}  // namespace runnel::internal
