#include "plugins/inspector/internal/arrangement.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>

#include "core/base/replace_file.h"
#include "plugins/values/json_reader.h"
#include "plugins/values/json_writer.h"

namespace runnel::internal {

std::string Arrangement::FileOf(const std::string& application_file) {
  if (application_file.empty()) return {};
  return std::filesystem::path(application_file).replace_extension(".layout.json").string();
}

Result<void> Arrangement::Read(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return {};
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  const auto json = JsonPart::Parse(text, 2);
  if (!json) return Error{.message = file + " cannot be read: " + json.error().message};
  Entries read;
  for (const auto& [name, value] : json->members()) {
    if (auto each = value.text()) read.emplace(name, std::move(*each));
  }
  return Change(read);
}

Result<void> Arrangement::Change(const Entries& changed) {
  for (const auto& [name, text] : changed) {
    if (name.empty() || name.size() > kLongestName || text.size() > kLongestText) {
      return Error{.message = "an entry of the layout is too long, or has no name",
                   .hint = "at most " + std::to_string(kLongestText) + " bytes"};
    }
  }
  if (entries_.size() + changed.size() > kMostEntries) {
    return Error{.message = "more than " + std::to_string(kMostEntries) + " entries of the layout"};
  }
  if (changed.empty()) return {};
  ++revision_;
  for (const auto& [name, text] : changed) entries_[name] = {text, revision_};
  return {};
}

Arrangement::Entries Arrangement::Since(std::uint64_t revision) const {
  Entries changed;
  for (const auto& [name, entry] : entries_) {
    const bool is_told = revision == 0 ? entry.text.empty() : entry.revision <= revision;
    if (!is_told) changed.emplace(name, entry.text);
  }
  return changed;
}

std::string Arrangement::MessageSince(std::uint64_t revision) const {
  return JsonObjectText([&](JsonObject& json) {
    json.Add("op", "layout");
    JsonObject entries(json.Key("entries"));
    for (const auto& [name, text] : Since(revision)) entries.Add(name, text);
  });
}

std::string Arrangement::Text() const {
  std::string text;
  for (const auto& [name, entry] : entries_) {
    if (entry.text.empty()) continue;
    text += text.empty() ? "{\n  " : ",\n  ";
    AppendJsonString(name, text);
    text += ": ";
    AppendJsonString(entry.text, text);
  }
  return text.empty() ? text : text + "\n}\n";
}

Result<void> Arrangement::Write(const std::string& file, const std::string& text) {
  if (!text.empty()) return ReplaceFile(file, text);
  std::error_code failure;
  std::filesystem::remove(file, failure);
  if (failure) return Error{.message = file + ": " + failure.message()};
  return {};
}

}  // namespace runnel::internal
