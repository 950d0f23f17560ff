#include "plugins/runtime_construction/plugin_loading.h"

#include <filesystem>

namespace runnel {

Result<void> LoadPlugin(std::string_view plugin, PluginManager& plugins, XmlTagRegistry& tags) {
  plugins.registry().Offer(tags);
  // The name by which the manager has a refused plugin's entries removed.
  const std::filesystem::path path(plugin);
  tags.set_plugin(path.has_parent_path() ? path.stem().string() : std::string(plugin));
  auto loaded = plugins.Load(plugin);
  tags.set_plugin("");
  return loaded;
}

}  // namespace runnel
