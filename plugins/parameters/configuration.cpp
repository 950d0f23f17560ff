#include "plugins/parameters/configuration.h"

#include <array>

#include "core/base/nearest_name.h"
#include "core/element/element_path.h"
#include "core/module/group_parameter.h"
#include "core/xml/xml_document.h"
#include "core/xml/xml_reading.h"

namespace runnel {

namespace {

using Entries = std::map<std::string, Configuration::Entry, std::less<>>;

const std::array<std::string, 1> kName{"name"};

// What FINROC calls sections, it calls nodes; its files begin with <root> or <node>.
bool IsOfFinroc(XmlElement root) { return root.name() == "root" || root.name() == "node"; }

std::string Normalized(std::string_view path) {
  std::string normalized;
  for (const std::string_view name : SplitPath(path)) normalized.append("/").append(name);
  return normalized;
}

// Reads one file into entries of its own, so that a wrong file adds nothing.
class FileReader {
 public:
  explicit FileReader(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  void ReadRoot(XmlElement root) {
    if (IsOfFinroc(root)) {
      contents_.front() = "node";
    } else if (root.name() != "configuration") {
      diagnostics_.Add({.message = "<" + root.name() + "> is not a configuration",
                        .position = root.position(),
                        .hint = "a configuration file begins with <configuration>, or, if it is one "
                                "of FINROC, with <root>"});
      return;
    }
    CheckAttributes(root, {}, diagnostics_);
    ReadContents(root, "");
  }
  [[nodiscard]] Entries& entries() noexcept { return entries_; }

 private:
  void ReadContents(XmlElement element, const std::string& path) {
    CheckChildren(element, contents_, diagnostics_);
    for (const XmlElement child : element.children()) {
      if (child.name() == contents_.front()) ReadSection(child, path);
      if (child.name() == "value") ReadValue(child, path);
    }
  }

  void ReadSection(XmlElement section, const std::string& path) {
    const std::string* const name = ReadName(section);
    // What is wrong inside a section without a good name is told all the same.
    ReadContents(section, path + "/" + (name != nullptr ? *name : "?"));
  }

  void ReadValue(XmlElement value, const std::string& path) {
    for (const XmlElement child : value.children()) {
      diagnostics_.Add({.message = "no <" + child.name() + "> may stand in <value>",
                        .position = child.position(),
                        .hint = "a value is a text"});
    }
    const std::string* const name = ReadName(value);
    if (name == nullptr) return;
    const std::string full = path + "/" + *name;
    if (const auto known = entries_.find(full); known != entries_.end()) {
      diagnostics_.Add({.message = "there are two values called '" + full + "'",
                        .position = value.position(),
                        .hint = "the first is in line " + std::to_string(known->second.position.line)});
      return;
    }
    entries_[full] = {value.text(), value.position()};
  }

  // Entries are no elements: spaces, as FINROC's have, may be in their names.
  const std::string* ReadName(XmlElement element) {
    CheckAttributes(element, kName, diagnostics_);
    const std::string* const name = ReadText(element, "name", diagnostics_);
    if (name == nullptr) return nullptr;
    if (!name->empty() && name->find('/') == std::string::npos) return name;
    diagnostics_.Add(
        {.message = name->empty() ? "a name must not be empty" : "the name '" + *name + "' contains a '/'",
         .position = element.Attribute("name")->value_position,
         .hint = name->empty() ? "" : "a <" + contents_.front() + "> stands for each name before the last"});
    return nullptr;
  }

  Diagnostics& diagnostics_;
  Entries entries_;
  std::array<std::string, 2> contents_{"section", "value"};
};

}  // namespace

void Configuration::Load(const std::string& file, Diagnostics& diagnostics) {
  const auto text = XmlDocument::ReadText(file);
  if (!text) {
    diagnostics.Add(text.error());
    return;
  }
  const auto document = XmlDocument::Parse(*text, file);
  if (!document) {
    diagnostics.Add(document.error());
    return;
  }
  Diagnostics problems;
  FileReader reader(problems);
  reader.ReadRoot(document->root());
  // FINROC overlooks what it does not understand; here that is told, and the rest is taken.
  const bool is_warning = IsOfFinroc(document->root());
  for (const Error& error : problems.errors()) {
    is_warning ? diagnostics.AddWarning(error) : diagnostics.Add(error);
  }
  if (!problems.ok() && !is_warning) return;
  files_.push_back({file, *text});
  reader.entries().merge(entries_);  // needs no memory
  entries_.swap(reader.entries());
}

Result<void> Configuration::AddArgument(std::string_view argument) {
  const SourcePosition position{"command line"};
  const std::size_t equals = argument.find('=');
  if (equals == std::string_view::npos || equals == 0) {
    return Error{
        .message = "'" + std::string(argument) + "' sets nothing", .position = position, .hint = "write name=value"};
  }
  std::string name(argument.substr(0, equals));
  if (arguments_.contains(name)) {
    return Error{.message = "'" + name + "' is given twice", .position = position};
  }
  arguments_[std::move(name)] = {std::string(argument.substr(equals + 1)), position};
  return {};
}

const Configuration::Entry* Configuration::FindEntry(std::string_view path) {
  const auto found = entries_.find(Normalized(path));
  if (found == entries_.end()) return nullptr;
  found->second.used = true;
  return &found->second;
}

const Configuration::Entry* Configuration::FindArgument(std::string_view name) {
  const auto found = arguments_.find(name);
  if (found == arguments_.end()) return nullptr;
  found->second.used = true;
  return &found->second;
}

std::vector<std::string> Configuration::UnusedArguments() const {
  std::vector<std::string> names;
  for (const auto& [name, entry] : arguments_) {
    if (!entry.used) names.push_back(name);
  }
  return names;
}

const FrameworkElement* ConfigurationSection::FindAround(const FrameworkElement& element) {
  const FrameworkElement* at = &element;
  while (at != nullptr && at->FindAnnotation<ConfigurationSection>() == nullptr) at = at->parent();
  return at;
}

std::string EntryInSection(const FrameworkElement& parameter, const std::string& name) {
  const FrameworkElement* const section = ConfigurationSection::FindAround(parameter);
  if (section == nullptr || dynamic_cast<const GroupParameter*>(&parameter) != nullptr) return {};
  std::string path = "/" + name;
  for (const FrameworkElement* at = parameter.parent(); at != section; at = at->parent()) {
    if (at->kind() != ElementKind::kPortGroup) path = "/" + at->name() + path;
  }
  return section->FindAnnotation<ConfigurationSection>()->path + path;
}

std::vector<std::string> Configuration::EntryPaths() const {
  return NamesOf(entries_, &std::pair<const std::string, Entry>::first);
}

}  // namespace runnel
