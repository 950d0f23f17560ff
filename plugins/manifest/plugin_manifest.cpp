#include "plugins/manifest/plugin_manifest.h"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>
#include <mutex>
#include <sstream>
#include <string_view>

#include <elf.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <link.h>

#include "core/base/error.h"
#include "core/base/number_text.h"
#include "core/xml/xml_document.h"
#include "core/xml/xml_reading.h"
#include "core/xml/xml_writing.h"

namespace runnel {

namespace {

void Add(const char* name, const std::string& value, std::string& text) {
  if (!value.empty()) text += fmt::format(" {}=\"{}\"", name, EscapedAttribute(value));
}

void Add(const char* name, const std::optional<double>& value, std::string& text) {
  if (value) text += fmt::format(" {}=\"{}\"", name, *value);
}

void Add(const char* name, bool value, std::string& text) {
  if (value) text += fmt::format(" {}=\"true\"", name);
}

void AppendPortTag(const ModuleDescription::Port& port, std::string& text) {
  text += "    <port";
  Add("name", port.name, text);
  Add("group", port.group, text);
  Add("is_input", port.is_input, text);
  Add("type", port.type, text);
  Add("is_required", port.is_required, text);
  Add("description", port.description, text);
  text += "/>\n";
}

void AppendParameterTag(const ModuleDescription::Parameter& parameter, std::string& text) {
  text += "    <parameter";
  Add("name", parameter.name, text);
  Add("type", parameter.type, text);
  Add("unit", parameter.unit, text);
  Add("default", parameter.default_value, text);
  Add("bounds", parameter.bounds, text);
  Add("minimum", parameter.minimum, text);
  Add("maximum", parameter.maximum, text);
  Add("choices", fmt::format("{}", fmt::join(parameter.choices, " ")), text);
  Add("is_static", parameter.is_static, text);
  Add("description", parameter.description, text);
  text += "/>\n";
}

bool IsTrue(XmlElement element, std::string_view name) { return element.TextOr(name) == "true"; }

std::vector<std::string> WordsIn(const std::string& text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

ModuleDescription::Port ReadPort(XmlElement element) {
  return {.name = element.TextOr("name"),
          .group = element.TextOr("group"),
          .is_input = IsTrue(element, "is_input"),
          .type = element.TextOr("type"),
          .is_required = IsTrue(element, "is_required"),
          .description = element.TextOr("description")};
}

ModuleDescription::Parameter ReadParameter(XmlElement element) {
  return {.name = element.TextOr("name"),
          .type = element.TextOr("type"),
          .unit = element.TextOr("unit"),
          .default_value = element.TextOr("default"),
          .bounds = element.TextOr("bounds"),
          .minimum = NumberIn<double>(element.TextOr("minimum")),
          .maximum = NumberIn<double>(element.TextOr("maximum")),
          .choices = WordsIn(element.TextOr("choices")),
          .is_static = IsTrue(element, "is_static"),
          .description = element.TextOr("description")};
}

ModuleDescription ReadModule(XmlElement element, const std::string& plugin, Diagnostics& problems) {
  CheckChildren(element, std::vector<std::string>{"parameter", "port"}, problems);
  ModuleDescription module{.type = element.TextOr("type"),
                           .summary = element.TextOr("summary"),
                           .plugin = plugin,
                           .problem = element.TextOr("problem")};
  for (const XmlElement child : element.children()) {
    if (child.name() == "port") module.ports.push_back(ReadPort(child));
    if (child.name() == "parameter") module.parameters.push_back(ReadParameter(child));
  }
  return module;
}

using Segment = ElfW(Phdr);
using Note = ElfW(Nhdr);
constexpr std::size_t kMostBytes = 1 << 16;  // no header or note is longer

/// Reads pieces of a file; what is not there is nothing.
class FileReader {
 public:
  explicit FileReader(const std::filesystem::path& file) : stream_(file, std::ios::binary) {}

  [[nodiscard]] std::string Bytes(std::size_t place, std::size_t count) {
    if (count > kMostBytes) return {};
    std::string bytes(count, '\0');
    stream_.clear();
    stream_.seekg(static_cast<std::streamoff>(place));
    if (!stream_.read(bytes.data(), static_cast<std::streamsize>(count))) return {};
    return bytes;
  }
  template <typename T>
  [[nodiscard]] bool Get(std::size_t place, T& value) {
    const std::string bytes = Bytes(place, sizeof(T));
    if (bytes.empty()) return false;
    std::memcpy(&value, bytes.data(), sizeof(T));
    return true;
  }

 private:
  std::ifstream stream_;
};

std::size_t Aligned(std::size_t size) { return (size + 3) & ~std::size_t{3}; }

// A segment of notes: each a head, a name and what it says, both filled up to words.
std::string BuildIdIn(std::string_view notes) {
  while (notes.size() >= sizeof(Note)) {
    Note note;
    std::memcpy(&note, notes.data(), sizeof(Note));
    notes.remove_prefix(sizeof(Note));
    const std::size_t name = Aligned(note.n_namesz);
    const std::size_t length = Aligned(note.n_descsz);
    if (name > notes.size() || length > notes.size() - name) return {};
    const bool is_of_linker = notes.substr(0, note.n_namesz) == std::string_view("GNU\0", 4);
    if (is_of_linker && note.n_type == NT_GNU_BUILD_ID) {
      const std::string_view id = notes.substr(name, note.n_descsz);
      return fmt::format("{:02x}", fmt::join(std::vector<unsigned char>(id.begin(), id.end()), ""));
    }
    notes.remove_prefix(name + length);
  }
  return {};
}

}  // namespace

std::filesystem::path ManifestFileOf(const std::filesystem::path& library) {
  std::filesystem::path file = library;
  return file.replace_extension(".manifest.xml");
}

std::string ManifestText(const PluginManifest& manifest) {
  std::string text = "<plugin";
  Add("name", manifest.plugin, text);
  Add("build_id", manifest.build_id, text);
  text += ">\n";
  for (const ModuleDescription& module : manifest.modules) {
    text += "  <module";
    Add("type", module.type, text);
    Add("summary", module.summary, text);
    Add("problem", module.problem, text);
    text += ">\n";
    for (const auto& port : module.ports) AppendPortTag(port, text);
    for (const auto& parameter : module.parameters) AppendParameterTag(parameter, text);
    text += "  </module>\n";
  }
  return text + "</plugin>\n";
}

Result<PluginManifest> ReadManifest(const std::filesystem::path& library) {
  const auto document = XmlDocument::Load(ManifestFileOf(library));
  if (!document) return document.error();
  const XmlElement root = document->root();
  PluginManifest manifest{.plugin = root.TextOr("name"), .build_id = root.TextOr("build_id"), .modules = {}};
  const auto build_id = BuildIdOf(library);
  if (!build_id) return build_id.error();
  if (*build_id != manifest.build_id) {
    return Error{.message = "is the manifest of another build of " + library.string(),
                 .position = root.position(),
                 .hint = "write it anew: runnel manifest " + library.string()};
  }
  Diagnostics problems;
  CheckChildren(root, std::vector<std::string>{"module"}, problems);
  for (const XmlElement child : root.children()) {
    manifest.modules.push_back(ReadModule(child, manifest.plugin, problems));
  }
  if (!problems.ok()) return problems.errors().front();
  return manifest;
}

const PluginManifest* ModuleDescriber::ManifestOf(const std::string& plugin) {
  const auto [place, is_new] = manifests_.try_emplace(plugin);
  if (is_new && library_of_) {
    const std::string library = library_of_(plugin);
    if (auto read = library.empty() ? Error{.message = "no library"} : ReadManifest(library)) {
      place->second = std::move(*read);
    }
  }
  return place->second ? &*place->second : nullptr;
}

std::optional<ModuleDescription> ModuleDescriber::Describe(const std::string& name) {
  std::string plugin;
  {
    const std::lock_guard lock(runtime_.structure_mutex());
    const ModuleType* const type = modules_.Find(name);
    if (type == nullptr) return {};
    plugin = type->plugin;
  }
  if (const PluginManifest* const manifest = ManifestOf(plugin)) {
    const auto found = std::ranges::find(manifest->modules, name, &ModuleDescription::type);
    if (found != manifest->modules.end()) return *found;
  }
  return DescribeByMaking(runtime_, modules_, name);
}

Result<std::string> BuildIdOf(const std::filesystem::path& library) {
  FileReader reader(library);
  ElfW(Ehdr) header;
  if (!reader.Get(0, header) || std::memcmp(header.e_ident, ELFMAG, SELFMAG) != 0) {
    return Error{.message = library.string() + " is no library that could be read"};
  }
  for (std::size_t i = 0; i < header.e_phnum; ++i) {
    Segment segment;
    if (!reader.Get(header.e_phoff + i * sizeof(Segment), segment)) break;
    if (segment.p_type != PT_NOTE) continue;
    std::string id = BuildIdIn(reader.Bytes(segment.p_offset, segment.p_filesz));
    if (!id.empty()) return id;
  }
  return Error{.message = library.string() + " has no build id", .hint = "link it with -Wl,--build-id"};
}

}  // namespace runnel
