#include "plugins/parameters/configuration_saver.h"

#include <algorithm>
#include <mutex>
#include <optional>

#include "core/base/characters.h"
#include "core/base/files.h"
#include "core/base/retry.h"
#include "core/element/configurable.h"
#include "core/element/element_path.h"
#include "core/element/runtime.h"
#include "core/xml/xml_document.h"
#include "core/xml/xml_editor.h"
#include "plugins/parameters/file_path.h"
#include "plugins/parameters/value_to_save.h"

namespace runnel {

namespace {

namespace fs = std::filesystem;

struct Entry {
  std::string path;  ///< "/safety/distance"
  FrameworkElement* parameter;
  std::string text;      ///< the value as it is now
  bool is_file = false;  ///< the name of one
  bool has_changed = false;
};

// In the order of the tree; an entry for several parameters is that of the first that has changed.
Result<std::vector<Entry>> EntriesOf(FrameworkElement& application) {
  std::vector<Entry> entries;
  std::optional<Error> error;
  application.Visit([&](FrameworkElement& element) {
    const auto* const parameter = dynamic_cast<const Configurable*>(&element);
    if (parameter == nullptr) return;
    const auto* const own = element.FindAnnotation<ConfigurationEntry>();
    const std::string path = own != nullptr ? own->path : EntryInSection(element, element.name());
    if (path.empty()) return;
    std::string normalized;
    for (const auto name : SplitPath(path)) normalized.append("/").append(name);
    Entry entry{normalized, &element, TextToSave(element, *parameter), &parameter->type() == &TypeOf<FilePath>()};
    if (const std::string fault = UnwritableCharacter(entry.text); !fault.empty() && !error) {
      error = Error{.message = "its value contains " + fault, .path = element.path()};
    }
    const std::string* const loaded = LoadedValue::Of(element);
    entry.has_changed = entry.text != (loaded != nullptr ? *loaded : parameter->info().default_value);
    const auto same = std::ranges::find(entries, entry.path, &Entry::path);
    if (same == entries.end()) {
      entries.push_back(std::move(entry));
    } else if (!same->has_changed && entry.has_changed) {
      *same = std::move(entry);
    }
  });
  if (error) return *error;
  if (!entries.empty()) return entries;
  return Error{.message = "no parameter of the application names an entry of a configuration",
               .path = application.path(),
               .hint = "add config=\"/…\" to parameters, modules or groups"};
}

// Relative names of files start in the folder of the configuration.
std::string TextIn(const fs::path& folder, const Entry& entry) {
  if (!entry.is_file || entry.text.empty() || fs::path(entry.text).is_absolute()) return entry.text;
  std::error_code ignored;
  const fs::path moved = fs::absolute(entry.text, ignored).lexically_relative(fs::absolute(folder, ignored));
  return moved.empty() ? entry.text : moved.string();
}

std::optional<XmlElement> Child(XmlElement parent, std::string_view name, bool is_section) {
  for (const XmlElement child : parent.children()) {
    const std::string_view kind = child.name();
    const bool is_kind = is_section ? kind == "section" || kind == "node" : kind == "value";
    if (is_kind && child.TextOr("name") == name) return child;
  }
  return {};
}

// As far as the sections of the path are there: the innermost, and how many names have been used.
std::pair<XmlElement, std::size_t> Innermost(XmlElement root, const std::vector<std::string_view>& names) {
  XmlElement at = root;
  std::size_t used = 0;
  while (used + 1 < names.size()) {
    const auto inner = Child(at, names[used], true);
    if (!inner) break;
    at = *inner;
    ++used;
  }
  return {at, used};
}

// Into `parent`, below sections of the names from `from` on: those that are made for one entry serve the next.
void AddTo(std::vector<NewElement>& contents, const std::string& section, const std::vector<std::string_view>& names,
           std::size_t from, const std::string& text) {
  if (from + 1 == names.size()) {
    return contents.push_back({.name = "value", .attributes = {{"name", std::string(names[from])}}, .text = text});
  }
  const auto is_it = [&](const NewElement& each) {
    return each.name == section && each.attributes[0].second == names[from];
  };
  auto found = std::ranges::find_if(contents, is_it);
  if (found == contents.end()) {
    contents.push_back({.name = section, .attributes = {{"name", std::string(names[from])}}});
    found = std::prev(contents.end());
  }
  AddTo(found->children, section, names, from + 1, text);
}

/// One configuration file on its way to what it should be.
class FileChange {
 public:
  static Result<std::unique_ptr<FileChange>> Of(const Configuration::File& source) {
    const auto now = XmlDocument::ReadText(source.name);
    if (!now) return now.error();
    if (*now != source.text) {
      return Error{.message = "the file has been changed since it was loaded",
                   .position = {source.name},
                   .hint = "name another file, and compare the two"};
    }
    auto document = XmlDocument::Parse(source.text, source.name);
    if (!document) return document.error();
    return std::make_unique<FileChange>(source, std::move(*document));
  }
  FileChange(const Configuration::File& source, XmlDocument document)
      : source_(source), document_(std::move(document)), editor_(document_, source_.text) {}

  /// Whether the entry is there; then it has the value.
  bool Set(const Entry& entry) {
    const auto names = SplitPath(entry.path);
    const auto [section, used] = Innermost(document_.root(), names);
    if (used + 1 < names.size()) return false;
    const auto value = Child(section, names.back(), false);
    if (value) editor_.SetText(*value, TextIn(folder(), entry));
    return value.has_value();
  }
  void Add(const Entry& entry) {
    const auto names = SplitPath(entry.path);
    const auto [section, used] = Innermost(document_.root(), names);
    auto& lacking = lacking_.try_emplace(section.spans().whole.begin, section, Contents{}).first->second;
    const bool is_of_finroc = document_.root().name() != "configuration";
    AddTo(lacking.second, is_of_finroc ? "node" : "section", names, used, TextIn(folder(), entry));
  }
  std::string Text() {
    for (auto& [place, lacking] : lacking_) {
      for (NewElement& each : lacking.second) editor_.Append(lacking.first, std::move(each));
    }
    return editor_.has_changes() ? editor_.Finish() : source_.text;
  }

 private:
  using Contents = std::vector<NewElement>;
  [[nodiscard]] fs::path folder() const { return fs::path(source_.name).parent_path(); }

  Configuration::File source_;
  XmlDocument document_;
  XmlEditor editor_;
  std::map<std::size_t, std::pair<XmlElement, Contents>> lacking_;
};

Result<void> Write(const fs::path& file, const std::string& text) {
  if (auto kept = KeepBackup(file); !kept) return kept;
  return ReplaceFile(file, text);
}

Result<std::string> WriteAll(const std::vector<Entry>& entries, const fs::path& to) {
  NewElement root{.name = "configuration"};
  for (const Entry& each : entries) {
    AddTo(root.children, "section", SplitPath(each.path), 0, TextIn(to.parent_path(), each));
  }
  std::string done = "saved " + std::to_string(entries.size()) + " values to " + to.string();
  if (auto written = Write(to, ElementText(root)); !written) return written.error();
  return done;
}

}  // namespace

Result<std::string> SaveConfiguration(FrameworkElement& application, const fs::path& to) {
  const std::lock_guard lock(application.runtime().structure_mutex());
  const auto entries = EntriesOf(application);
  if (!entries) return entries.error();
  if (!to.empty()) return WriteAll(*entries, to);
  auto* const source = application.FindAnnotation<ConfigurationSource>();
  if (source == nullptr || source->files.empty()) {
    return Error{.message = "the application was loaded without a configuration file",
                 .path = application.path(),
                 .hint = "name the file that is to be written"};
  }
  std::vector<std::unique_ptr<FileChange>> files;
  for (const Configuration::File& each : source->files) {
    auto change = FileChange::Of(each);
    if (!change) return change.error();
    files.push_back(std::move(*change));
  }
  std::size_t count = 0;
  for (const Entry& each : *entries) {
    if (!each.has_changed) continue;
    ++count;
    // Of several files that have the entry, the last has been read last.
    const bool is_set = std::any_of(files.rbegin(), files.rend(), [&](const auto& file) { return file->Set(each); });
    if (!is_set) files.back()->Add(each);
  }
  // All that needs memory comes before a file is another one.
  std::vector<std::string> texts;
  std::string names;
  for (std::size_t i = 0; i < files.size(); ++i) {
    texts.push_back(files[i]->Text());
    const Configuration::File& file = source->files[i];
    if (texts[i] != file.text) names += (names.empty() ? "" : ", ") + file.name;
  }
  std::string done = count == 0
                         ? "no value has changed"
                         : "saved " + std::to_string(count) + (count == 1 ? " value" : " values") + " to " + names;
  for (std::size_t i = 0; i < files.size(); ++i) {
    Configuration::File& file = source->files[i];
    if (texts[i] == file.text) continue;
    if (auto written = Write(file.name, texts[i]); !written) return written.error();
    file.text = std::move(texts[i]);
  }
  for (const Entry& each : *entries) {
    if (!each.has_changed) continue;
    Retry([&] {
      each.parameter->Annotate(std::make_unique<LoadedValue>(each.text));
      each.parameter->Annotate(std::make_unique<ConfigurationEntry>(each.path));
    });
  }
  return done;
}

}  // namespace runnel
