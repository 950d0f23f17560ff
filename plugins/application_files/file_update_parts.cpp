// Groups that other files describe.

#include <algorithm>
#include <utility>

#include "plugins/application_files/file_part.h"
#include "plugins/parameters/file_path.h"
#include "plugins/runtime_construction/part_files.h"

namespace runnel::internal {

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

FileUpdate::~FileUpdate() = default;

void FileUpdate::UpdateInstance(XmlElement tag, FrameworkElement& group) {
  has_tag_.insert(&group);
  UpdateAddedAttributes(tag, group);
  const std::string& file = group.FindAnnotation<PartInstance>()->file;
  const auto text = source_.parts.find(file);
  if (text == source_.parts.end()) {
    return saving_.Fail(
        {.message = "what " + file + " said is not known any more", .path = group.path()});
  }
  auto document = XmlDocument::Parse(text->second, file);
  if (!document) return saving_.Fail(document.error());
  Part& part = *parts_.emplace_back(
      std::make_unique<Part>(std::move(*document), text->second, saving_, source_));
  const XmlElement root = part.document.root();
  SetOverride set = set_override_;
  if (part_ == nullptr) {
    if (IsMoved()) MoveFileNames(tag, root, group);
    set = [this, tag](const std::string& module, const std::string& name,
                      const std::string& value) { Override(tag, module, name, value); };
  }
  part.update.UpdatePart(root, part_ == nullptr ? group : *part_, group, std::move(set));
  loads_.insert(part.update.loads_.begin(), part.update.loads_.end());
}

void FileUpdate::UpdatePart(XmlElement root, FrameworkElement& outermost, FrameworkElement& group,
                            SetOverride set) {
  part_ = &outermost;
  set_override_ = std::move(set);
  UpdateGroup(root, group);
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
  editor_.Append(
      tag, {.name = "parameter", .attributes = {{"of", module}, {"name", name}, {"value", value}}});
}

void FileUpdate::FinishParts() {
  for (const auto& part : parts_) {
    FileUpdate& update = part->update;
    for (const auto& [tag, group] : update.groups_) update.AppendNew(tag, *group);
    update.FinishParts();
    if (!part->editor.has_changes()) continue;
    const FrameworkElement& group = *update.groups_.front().second;
    const std::string& file = group.FindAnnotation<PartInstance>()->file;
    saving_.Fail(
        {.message = "what is in this group has been changed, but " + file +
                    " says what is in all groups of its type",
         .path = group.path(),
         .hint = "values of parameters can be saved for one group; write the rest into " + file});
  }
}

// In an instance that is written into another folder: the names of its file, and of those that it
// gives to modules within.
void FileUpdate::MoveFileNames(XmlElement tag, XmlElement root, FrameworkElement& group) {
  const auto move = [&](XmlElement element, std::string_view name) {
    const XmlAttribute* const known = element.Attribute(name);
    if (known == nullptr) return;
    editor_.SetAttribute(element, name, MovedFileName(known->value, old_folder_, saving_.folder));
  };
  move(tag, "type");
  for (const XmlElement child : tag.children()) {
    const XmlAttribute* const of = child.Attribute("of");
    const std::string name = NameOf(child);
    const bool is_file =
        of != nullptr ? IsFileName(group.Find(of->value), name) : NamesFile(name, root, group);
    if (is_file) move(child, "value");
  }
}

}  // namespace runnel::internal
