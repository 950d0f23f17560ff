#include "plugins/application/extension_description.h"

#include <algorithm>
#include <array>
#include <map>

#include "core/base/error.h"
#include "core/base/files.h"
#include "core/xml/xml_document.h"
#include "core/xml/xml_reading.h"

namespace runnel {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kEnding = ".extension.xml";
const std::vector<std::string> kParts{"command", "option", "tag"};
// In the order of ExtensionOption::Kind.
const std::vector<std::string> kKinds{"flag", "optional_value", "value", "list", "argument"};

// What the file names from its own place.
std::string PathFrom(const fs::path& file, const std::string& text) {
  return text.empty() ? "" : fs::absolute(file.parent_path() / text).lexically_normal().string();
}

ExtensionOption ReadOption(XmlElement element, const std::string& name, const fs::path& file, Diagnostics& problems) {
  const std::string kind = element.TextOr("kind", kKinds.front());
  const auto known = std::ranges::find(kKinds, kind);
  if (known == kKinds.end()) {
    problems.Add({.message = "'" + kind + "' is no kind of option",
                  .position = element.Attribute("kind")->value_position,
                  .hint = "flag, optional_value, value, list or argument"});
  }
  return {.name = name,
          .kind = static_cast<ExtensionOption::Kind>(known - kKinds.begin()),
          .value_name = element.TextOr("value", "VALUE"),
          .summary = element.TextOr("summary"),
          .command = element.TextOr("command"),
          .preload = PathFrom(file, element.TextOr("preload")),
          .is_output = element.TextOr("writes", "false") == "true"};
}

void ReadPart(XmlElement element, const fs::path& file, ExtensionDescription& extension, Diagnostics& problems) {
  const bool is_option = element.name() == "option";
  CheckAttributes(element,
                  is_option
                      ? std::vector<std::string>{"command", "kind", "name", "preload", "summary", "value", "writes"}
                      : std::vector<std::string>{"name"},
                  problems);
  const std::string* const name = ReadText(element, "name", problems);
  if (name == nullptr) return;
  if (is_option) extension.options.push_back(ReadOption(element, *name, file, problems));
  if (element.name() == "tag") extension.tags.push_back(*name);
  if (element.name() == "command") extension.commands.push_back(*name);
}

Result<ExtensionDescription> ReadDescription(const fs::path& file, std::string name) {
  const auto document = XmlDocument::Load(file);
  if (!document) return document.error();
  const XmlElement root = document->root();
  if (root.name() != "extension") {
    return Error{.message = "<" + root.name() + "> does not describe an extension",
                 .position = root.position(),
                 .hint = "such a file begins with <extension>"};
  }
  ExtensionDescription extension{.name = std::move(name), .summary = {}};
  Diagnostics problems;
  CheckAttributes(root, std::array<std::string, 1>{"summary"}, problems);
  CheckChildren(root, kParts, problems);
  if (const std::string* const text = ReadText(root, "summary", problems)) extension.summary = *text;
  for (const XmlElement child : root.children()) ReadPart(child, file, extension, problems);
  if (!problems.ok()) return problems.errors().front();
  return extension;
}

const ExtensionDescription* FindIn(const std::vector<ExtensionDescription>& all,
                                   std::vector<std::string> ExtensionDescription::*words, std::string_view word) {
  const auto found = std::ranges::find_if(all, [&](const ExtensionDescription& each) {
    return std::ranges::find(each.*words, word) != (each.*words).end();
  });
  return found != all.end() ? &*found : nullptr;
}

}  // namespace

Result<ExtensionCatalogue> ExtensionCatalogue::Read(const std::vector<fs::path>& folders) {
  std::map<std::string, fs::path> files;
  for (const fs::path& folder : folders) {
    for (const std::string& name : NamesInFolder(folder)) {
      if (!name.ends_with(kEnding)) continue;
      files.try_emplace(name.substr(0, name.size() - kEnding.size()), folder / name);
    }
  }
  ExtensionCatalogue catalogue;
  for (const auto& [name, file] : files) {
    auto extension = ReadDescription(file, name);
    if (!extension) return extension.error();
    catalogue.all_.push_back(std::move(*extension));
  }
  return catalogue;
}

const ExtensionDescription* ExtensionCatalogue::Find(std::string_view name) const {
  const auto found = std::ranges::find(all_, name, &ExtensionDescription::name);
  return found != all_.end() ? &*found : nullptr;
}

const ExtensionDescription* ExtensionCatalogue::FindTag(std::string_view tag) const {
  return FindIn(all_, &ExtensionDescription::tags, tag);
}

const ExtensionDescription* ExtensionCatalogue::FindCommand(std::string_view command) const {
  return FindIn(all_, &ExtensionDescription::commands, command);
}

std::string FileOfNextRun(const std::string& file) {
  const fs::path first(file);
  fs::path next;
  std::error_code ignored;
  for (int run = 2; next.empty() || fs::exists(next, ignored); ++run) {
    next = first.parent_path() / (first.stem().string() + "_" + std::to_string(run) + first.extension().string());
  }
  return next.string();
}

}  // namespace runnel
