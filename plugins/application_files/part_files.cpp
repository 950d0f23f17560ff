#include "plugins/application_files/part_files.h"

#include <algorithm>

#include "core/element/file_notes.h"

namespace runnel {

namespace {

namespace fs = std::filesystem;

// A file of ten groups of ten groups … is short, and would never come to an end.
constexpr std::size_t kMostUses = 100'000;

bool IsSameFile(const std::string& one, const std::string& other) {
  std::error_code ignored;
  return one == other || fs::equivalent(one, other, ignored);
}

}  // namespace

std::string PlaceText(const SourcePosition& place) {
  return place.file + ":" + std::to_string(place.line) + ":" + std::to_string(place.column);
}

std::string UseChain(const std::string& file, const FrameworkElement& element) {
  std::string chain;
  for (const FrameworkElement* at = &element; at != nullptr; at = at->parent()) {
    const auto* const part = at->FindAnnotation<PartInstance>();
    if (part == nullptr || (chain.empty() && part->file != file)) continue;
    chain += (chain.empty() ? "instantiated at " : ", which is instantiated at ") + PlaceText(FindSourcePlace(*at));
  }
  return chain;
}

fs::path PartFiles::FolderOf(const std::string& file) const {
  return files_.contains(file) ? fs::path(file).parent_path() : folder_;
}

Result<ApplicationFile> ApplicationFile::Read(const fs::path& file) {
  auto text = XmlDocument::ReadText(file);
  if (!text) return text.error();
  auto document = XmlDocument::Parse(*text, file.string());
  if (!document) return document.error();
  return ApplicationFile{file, std::move(*text), std::move(*document)};
}

Result<const ApplicationFile*> PartFiles::Read(const std::string& name) {
  if (const auto known = files_.find(name); known != files_.end()) return &known->second;
  auto file = ApplicationFile::Read(name);
  if (!file) return file.error();
  return &files_.emplace(name, std::move(*file)).first->second;
}

std::optional<Error> PartFiles::FindCircle(const std::string& name, const SourcePosition& position) const {
  const auto same = std::ranges::find_if(open_, [&](const Opened& each) { return IsSameFile(each.name, name); });
  if (same == open_.end()) return std::nullopt;
  std::string chain = PlaceText(same->used_at);
  for (auto each = same + 1; each != open_.end(); ++each) chain += ", " + PlaceText(each->used_at);
  return Error{.message = name + " contains itself", .position = position, .hint = "through " + chain + " and here"};
}

Result<PartUse*> PartFiles::Open(const XmlAttribute& type, XmlElement tag, FrameworkElement& group) {
  const SourcePosition& place = type.value_position;
  const std::string name = (FolderOf(place.file) / type.value).lexically_normal().string();
  if (auto circle = FindCircle(name, place)) return std::move(*circle);
  if (uses_.size() >= kMostUses) {
    return Error{
        .message = "the application has more than " + std::to_string(kMostUses) + " groups that other files describe",
        .position = place};
  }
  const auto file = Read(name);
  if (!file) {
    if (file.error().position.line > 0) return file.error();
    Error error = file.error().WithContext(name);  // not what is in it is wrong
    error.position = place;
    return error;
  }
  const XmlElement root = (*file)->document.root();
  if (root.name() != "group_type") {
    return Error{.message = name + " begins with <" + root.name() + ">, and describes no group",
                 .position = place,
                 .hint = "a file for <group type=\"…\"> begins with <group_type>"};
  }
  open_.push_back({name, tag.position()});
  return &uses_.try_emplace(&group, PartUse{group, tag, root}).first->second;
}

PartUse* PartFiles::Find(const FrameworkElement& group) {
  const auto found = uses_.find(&group);
  return found == uses_.end() ? nullptr : &found->second;
}

PartUse* PartFiles::FindAround(const FrameworkElement* element) {
  for (; element != nullptr; element = element->parent()) {
    if (PartUse* use = Find(*element)) return use;
  }
  return nullptr;
}

std::vector<XmlElement> PartFiles::Roots() const {
  std::vector<XmlElement> roots;
  for (const auto& [name, file] : files_) roots.push_back(file.document.root());
  return roots;
}

std::map<std::string, std::string> PartFiles::TakeTexts() {
  std::map<std::string, std::string> texts;
  for (auto& [name, file] : files_) texts[name] = std::move(file.text);
  return texts;
}

}  // namespace runnel
