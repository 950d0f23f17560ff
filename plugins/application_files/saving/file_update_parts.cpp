// Groups that other files describe.

#include <algorithm>
#include <utility>

#include "core/plugin/module_type_name.h"
#include "core/paths/path_search.h"
#include "plugins/application_files/part_files.h"
#include "plugins/application_files/saving/file_update.h"
#include "plugins/parameters/file_path.h"

namespace runnel::internal {

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
  editor_.Append(
      tag, {.name = "parameter", .attributes = {{"of", module}, {"name", name}, {"value", value}}});
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
    if (known != nullptr) editor_.SetAttribute(element, name, Moved(known->value));
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
