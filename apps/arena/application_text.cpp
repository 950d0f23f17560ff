#include "apps/arena/application_text.h"

#include <algorithm>
#include <fstream>
#include <sstream>

#include "core/base/files.h"

namespace runnel::arena {

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
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  if (stream) return text.str();
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
