#include "plugins/ros_messages/message_library.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <set>

#include <fmt/ranges.h>
#include <openssl/sha.h>

#include "core/base/nearest_name.h"
#include "plugins/ros_messages/names.h"

namespace runnel {

namespace {

constexpr std::string_view kStandard[] = {
#include "plugins/ros_messages/definitions/common.inc"
    ,
#include "plugins/ros_messages/definitions/geometry.inc"
    ,
#include "plugins/ros_messages/definitions/sensors.inc"
    ,
#include "plugins/ros_messages/definitions/nodes.inc"
    ,
#include "plugins/ros_messages/definitions/visualization.inc"
};

namespace fs = std::filesystem;

constexpr std::string_view kBetween = "---";  // request and response

// Where the line begins in which nothing else stands; the end if there is none.
std::size_t FindBetween(std::string_view text) {
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    std::string_view line = text.substr(begin, end - begin);
    while (line.ends_with(' ') || line.ends_with('\r')) line.remove_suffix(1);
    if (line == kBetween) return begin;
    begin = end + 1;
  }
  return text.size();
}

// A message, or request and response of a service.
Result<std::vector<MessageDefinition>> ReadDefinitionFile(const fs::path& path) {
  const fs::path folder = fs::absolute(path).lexically_normal().parent_path();
  const std::string package = folder.parent_path().filename(), name = path.stem(),
                    kind = path.extension() == ".srv" ? "srv" : "msg";
  const auto wrong = [&](std::string message, std::string hint) {
    return Error{.message = std::move(message), .position = {path.string()}, .hint = std::move(hint)};
  };
  if (folder.filename() != kind || !IsRosPackageName(package)) {
    return wrong(
        "which package does the message belong to?",
        "put it into a folder <package>/" + kind + ", as in my_messages/" + kind + "/" + path.filename().string());
  }
  if (!IsRosMessageName(name)) {
    return wrong("a message cannot be called '" + name + "'", "call the file " + NearestMessageName(name) + "." + kind);
  }
  std::ifstream stream(path);
  if (!stream) return wrong("the file cannot be read", "look whether it is there, and yours");
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  const std::string full = package + "/" + kind + "/" + name;
  std::vector<std::pair<std::string, std::string>> parts;  // name, text
  if (kind == "msg") {
    parts.emplace_back(full, std::move(text));
  } else {
    const std::size_t between = FindBetween(text);
    if (between == text.size())
      return wrong("a service has a line '---' between request and response",
                   "write one, also if one of them is empty");
    // With as many lines in front as in the file, so that mistakes have theirs.
    const auto lines =
        static_cast<std::size_t>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(between), '\n'));
    parts.emplace_back(full + "_Request", text.substr(0, between));
    parts.emplace_back(full + "_Response", std::string(lines, '\n') + text.substr(between + kBetween.size()));
  }
  std::vector<MessageDefinition> definitions;
  for (const auto& [part, content] : parts) {
    auto parsed = ParseMessage(content, part, path.string());
    if (!parsed) return parsed.error();
    definitions.push_back(std::move(*parsed));
  }
  return definitions;
}

Result<std::vector<fs::path>> FindMessageFiles(const fs::path& place) {
  std::error_code problem;
  if (!fs::exists(place, problem)) {
    return Error{.message = "there is no file and no folder '" + place.string() + "'",
                 .hint = "the path begins at the application's file"};
  }
  if (!fs::is_directory(place, problem)) return std::vector{place};
  std::vector<fs::path> files;
  for (fs::recursive_directory_iterator at(place, problem), end; !problem && at != end; at.increment(problem)) {
    if (at->path().extension() == ".msg" || at->path().extension() == ".srv") files.push_back(at->path());
  }
  if (problem) return Error{.message = problem.message(), .position = {place.string()}};
  if (files.empty())
    return Error{.message = "there is no .msg or .srv file in the folder", .position = {place.string()}};
  std::ranges::sort(files);
  return files;
}

bool IsSameOnTheWire(const MessageDefinition& a, const MessageDefinition& b) {
  return std::ranges::equal(a.fields, b.fields, [](const MessageField& x, const MessageField& y) {
    return x.name == y.name && x.type == y.type && x.nested == y.nested && x.count == y.count &&
           x.capacity == y.capacity && x.text_capacity == y.text_capacity;
  });
}

void AddInside(const MessageLibrary& library, const MessageDefinition& definition, std::set<std::string>& names) {
  for (const MessageField& field : definition.fields) {
    if (field.type != MessageType::kNested || !names.insert(field.nested).second) continue;
    if (const auto* const inside = library.Find(field.nested)) AddInside(library, *inside, names);
  }
}

// As 64 hexadecimal digits.
std::string Sha256(std::string_view bytes) {
  std::array<unsigned char, SHA256_DIGEST_LENGTH> digest{};
  SHA256(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(), digest.data());
  return fmt::format("{:02x}", fmt::join(digest, ""));
}

// With the spaces of Python's json.dumps(), since it is this text of which ROS 2 takes the hash.
std::string DescriptionOf(const MessageField& field) {
  constexpr int kArray = 48, kBounded = 96, kList = 144, kToBoundedString = 4;
  int id = static_cast<int>(field.type);
  if (field.text_capacity > 0) id += kToBoundedString;
  if (field.count == MessageCount::kArray) id += kArray;
  if (field.count == MessageCount::kBounded) id += kBounded;
  if (field.count == MessageCount::kList) id += kList;
  return R"({"name": ")" + field.name + R"(", "type": {"type_id": )" + std::to_string(id) + R"(, "capacity": )" +
         std::to_string(field.capacity) + R"(, "string_capacity": )" + std::to_string(field.text_capacity) +
         R"(, "nested_type_name": ")" + field.nested + R"("}})";
}

std::string DescriptionOf(const MessageDefinition& definition) {
  std::string text = R"({"type_name": ")" + definition.name + R"(", "fields": [)";
  static const MessageField kInstead{.name = "structure_needs_at_least_one_member", .type = MessageType::kUint8};
  if (definition.fields.empty()) text += DescriptionOf(kInstead);
  for (const MessageField& field : definition.fields) {
    if (&field != &definition.fields.front()) text += ", ";
    text += DescriptionOf(field);
  }
  return text + "]}";
}

}  // namespace

const MessageLibrary& MessageLibrary::Standard() {
  static const MessageLibrary library = MakeStandard();
  return library;
}

MessageLibrary MessageLibrary::MakeStandard() {
  constexpr std::string_view kBegin = "MSG: ";
  MessageLibrary library{Empty()};
  for (std::string_view texts : kStandard) {
    while (!texts.empty()) {
      const std::size_t line = texts.find('\n');
      const std::string name(texts.substr(kBegin.size(), line - kBegin.size()));
      const std::size_t end = std::min(texts.find(kBegin, line), texts.size());
      auto definition = ParseMessage(texts.substr(line, end - line), name, name);
      if (!definition) ThrowProgrammingError("a message of ROS 2", definition.error().ToString());
      library.definitions_.emplace(name, std::move(*definition));
      texts.remove_prefix(end);
    }
  }
  return library;
}

Result<void> MessageLibrary::Read(const fs::path& file_or_folder) {
  const auto files = FindMessageFiles(file_or_folder);
  if (!files) return files.error();
  MessageLibrary wanted = *this;
  std::vector<std::pair<std::string, std::string>> read;  // name, file
  for (const fs::path& file : *files) {
    auto definitions = ReadDefinitionFile(file);
    if (!definitions) return definitions.error();
    for (MessageDefinition& definition : *definitions) {
      read.emplace_back(definition.name, file.string());
      if (auto added = wanted.Add(std::move(definition)); !added) return added.error().WithPosition(file.string());
    }
  }
  for (const auto& [name, file] : read) {
    if (auto inside = wanted.CheckInside(*wanted.Find(name), file); !inside) return inside;
  }
  definitions_.merge(wanted.definitions_);
  return {};
}

Result<void> MessageLibrary::Add(MessageDefinition definition) {
  const auto [place, is_new] = definitions_.try_emplace(definition.name, definition);
  if (is_new || IsSameOnTheWire(place->second, definition)) return {};
  return Error{.message = "there is already another message '" + definition.name + "'",
               .hint = "give it a package or a name of its own"};
}

Result<void> MessageLibrary::CheckInside(const MessageDefinition& definition, const std::string& file) const {
  for (const MessageField& field : definition.fields) {
    if (field.type != MessageType::kNested) continue;
    if (auto inside = Get(field.nested); !inside) {
      return inside.error().WithContext("field '" + field.name + "'").WithPosition(file);
    }
  }
  std::set<std::string> inside;
  AddInside(*this, definition, inside);
  if (!inside.contains(definition.name)) return {};
  return Error{.message = "the message '" + definition.name + "' contains itself", .position = {file}};
}

const MessageDefinition* MessageLibrary::Find(std::string_view name) const {
  auto found = definitions_.find(name);
  const std::size_t slash = name.find('/');
  if (found == definitions_.end() && slash != std::string_view::npos) {
    found = definitions_.find(std::string(name.substr(0, slash)) + "/msg" + std::string(name.substr(slash)));
  }
  return found == definitions_.end() ? nullptr : &found->second;
}

Result<const MessageDefinition*> MessageLibrary::Get(std::string_view name) const {
  if (const auto* const found = Find(name)) return found;
  std::vector<std::string> names, same_last_word;
  const std::string_view last = name.substr(name.rfind('/') + 1);
  for (const auto& [each, definition] : definitions_) {
    names.push_back(each);
    if (each.ends_with("/" + std::string(last))) same_last_word.push_back(each);
  }
  const std::string& hint = same_last_word.empty() ? NearestName(name, names) : same_last_word.front();
  return Error{
      .message = "there is no message '" + std::string(name) + "'",
      .hint = hint.empty() ? "read its package: a folder with <package>/msg/*.msg" : "did you mean '" + hint + "'?"};
}

std::vector<const MessageDefinition*> MessageLibrary::InsideOf(const MessageDefinition& definition) const {
  std::set<std::string> names;
  AddInside(*this, definition, names);
  std::vector<const MessageDefinition*> inside;
  for (const std::string& name : names) inside.push_back(Find(name));
  std::erase(inside, nullptr);
  return inside;
}

std::vector<const MessageDefinition*> MessageLibrary::All() const {
  std::vector<const MessageDefinition*> all;
  for (const auto& [name, definition] : definitions_) all.push_back(&definition);
  return all;
}

std::string TypeHashOf(const MessageDefinition& definition, const MessageLibrary& library) {
  const auto inside = NamesOf(library.InsideOf(definition), [](const auto* each) { return DescriptionOf(*each); });
  return "RIHS01_" + Sha256(fmt::format(R"({{"type_description": {}, "referenced_type_descriptions": [{}]}})",
                                        DescriptionOf(definition), fmt::join(inside, ", ")));
}

}  // namespace runnel
