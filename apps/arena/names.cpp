#include "apps/arena/names.h"

#include <algorithm>

#include "core/base/files.h"
#include "core/base/nearest_name.h"
#include "core/plugin/plugin_manager.h"
#include "core/xml/xml_document.h"
#include "core/xml/xml_writing.h"
#include "modules/simulation/world_file/world_file.h"

namespace runnel::arena {

namespace {

constexpr std::string_view kFamily = "planning/";
// Put together from parameters: not a variant, before somebody has done so.
constexpr std::string_view kComposed = "planning/bug";
// What is compared with the family besides: a network of behaviours.
constexpr std::string_view kNetwork = "behaviours/navigator";

Result<Variant> ReadVariant(const std::filesystem::path& file) {
  const auto document = XmlDocument::Load(file);
  if (!document) return document.error();
  const XmlElement root = document->root();
  const XmlAttribute* const type = root.Attribute("type");
  if (root.name() != "module" || type == nullptr) {
    return Error{.message = "a variant is a <module> tag with a type, as in an application",
                 .position = root.position()};
  }
  Variant variant{.name = file.stem().string(), .type = type->value};
  for (const XmlElement child : root.children()) {
    std::string tag = "<" + child.name();
    for (const XmlAttribute& attribute : child.attributes()) {
      tag += " " + attribute.name + "=\"" + EscapedAttribute(attribute.value, '"') + "\"";
    }
    variant.parameters += tag + "/>";
  }
  return variant;
}

std::vector<std::string> FamilyNames(const std::vector<std::string>& types) {
  std::vector<std::string> names;
  for (const std::string& type : types) {
    if (type.starts_with(kFamily)) names.push_back(type.substr(kFamily.size()));
  }
  return names;
}

bool Has(const std::vector<std::string>& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

Result<Variant> FindVariant(const std::string& word, const std::vector<std::string>& types) {
  if (word.ends_with(".xml")) {
    auto variant = ReadVariant(word);
    // What is known of one of the family, its bound say, is known of its name.
    if (!variant || !Has(FamilyNames(types), variant->name)) return variant;
    return Error{.message = "'" + variant->name + "' is the name of " + std::string(kFamily) + variant->name,
                 .position = {word},
                 .hint = "give the file another name"};
  }
  const bool is_type = word.find('/') != std::string::npos;
  const std::string type = is_type ? word : std::string(kFamily) + word;
  const std::string name = type.starts_with(kFamily) ? type.substr(kFamily.size()) : type;
  // Types that nobody lists, as those in Python, are known to any registry once their plugin is loaded.
  const auto late = ModuleRegistry().Get(type);
  if (Has(types, type) || late) return Variant{.name = name, .type = type};
  return Error{.message = "there is no variant '" + word + "'" + (is_type ? ": " + late.error().message : ""),
               .hint = NearestNameHint(word, is_type ? types : FamilyNames(types))};
}

}  // namespace

std::string PluginOf(std::string_view type) { return std::string(type.substr(0, type.find('/'))); }

Product FindProduct() {
  const auto folder = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  return {folder / "runnel", XmlFolder() / "apps" / "arena"};
}

std::vector<Variant> FindVariants(const std::vector<std::string>& words, const std::vector<std::string>& types,
                                  Diagnostics& diagnostics) {
  std::vector<Variant> variants;
  const auto add = [&](const Variant& variant) {
    const auto same = std::ranges::find(variants, variant.name, &Variant::name);
    if (same == variants.end()) {
      variants.push_back(variant);
    } else if (same->type != variant.type || same->parameters != variant.parameters) {
      diagnostics.Add({.message = "two variants are called '" + variant.name + "'"});
    }
  };
  for (const std::string& word : words) {
    if (word == "all") {
      for (const std::string& name : FamilyNames(types)) {
        const std::string type = std::string(kFamily) + name;
        if (type != kComposed) add({.name = name, .type = type});
      }
      const std::string network(kNetwork);
      if (Has(types, network)) add({.name = network, .type = network});
    } else if (const auto variant = FindVariant(word, types)) {
      add(*variant);
    } else {
      diagnostics.Add(variant.error());
    }
  }
  return variants;
}

std::vector<std::string> FindTypes(const std::vector<std::string>& plugins, Diagnostics& diagnostics) {
  PluginManager manager;
  if (auto loaded = manager.Load("planning"); !loaded) diagnostics.Add(loaded.error());
  const std::string network = PluginOf(kNetwork);
  if (Has(manager.Available(), network)) {
    if (auto loaded = manager.Load(network); !loaded) diagnostics.Add(loaded.error());
  }
  for (const std::string& plugin : plugins) {
    if (auto loaded = manager.Load(plugin); !loaded) diagnostics.Add(loaded.error());
  }
  return NamesOf(manager.modules().All(), &ModuleType::name);
}

void CheckNames(const std::vector<std::string>& words, const std::vector<std::string>& known, const std::string& what,
                Diagnostics& diagnostics) {
  for (const std::string& word : words) {
    if (Has(known, word)) continue;
    diagnostics.Add({.message = "there is no " + what + " '" + word + "'", .hint = NearestNameHint(word, known)});
  }
}

namespace {

constexpr std::string_view kPlanner = "<module name=\"planner\" type=\"planning/bug2\">";
constexpr std::string_view kPlugin = "<load plugin=\"planning\"/>";

Result<void> ReplaceOnce(std::string& text, std::string_view what, const std::string& by) {
  const auto at = text.find(what);
  if (at == std::string::npos || text.find(what, at + 1) != std::string::npos) {
    return Error{.message =
                     "an application of the arena needs the tag '" + std::string(what) + "' once, written like that"};
  }
  text.replace(at, what.size(), by);
  return {};
}

}  // namespace

Result<std::string> ApplicationText(const std::filesystem::path& file, const Variant& variant,
                                    const std::vector<std::string>& plugins) {
  auto text = ReadFile(file);
  if (!text) return text.error();
  std::string loads(kPlugin);
  // One of another plugin of Runnel's; others' are named by --plugin.
  if (PluginOf(variant.type) == "behaviours" && std::ranges::find(plugins, "behaviours") == plugins.end())
    loads += "<load plugin=\"behaviours\"/>";
  for (const std::string& plugin : plugins) {
    // A plugin may be a file; the application will stand in another folder.
    const bool is_file = plugin.find('/') != std::string::npos;
    const std::string name = is_file ? std::filesystem::absolute(plugin).string() : plugin;
    loads += "<load plugin=\"" + name + "\"/>";
  }
  const std::string planner = "<module name=\"planner\" type=\"" + variant.type + "\">" + variant.parameters;
  for (const auto& [what, by] : {std::pair(kPlugin, loads), std::pair(kPlanner, planner)}) {
    if (auto replaced = ReplaceOnce(*text, what, by); !replaced) return replaced.error().WithPosition(file.string());
  }
  return text;
}

Result<std::string> ReadFile(const std::filesystem::path& file) {
  if (auto text = TextOfFile(file)) return *std::move(text);
  return Error{.message = "the file cannot be read", .position = {file.string()}};
}

Result<void> WriteFile(const std::filesystem::path& file, std::string_view text) {
  auto written = ReplaceFile(file, text);
  if (written) return written;
  return Error{.message = "the file cannot be written: " + written.error().message,
               .position = {file.string()},
               .hint = "is its folder there, and may you write in it?"};
}

}  // namespace runnel::arena
