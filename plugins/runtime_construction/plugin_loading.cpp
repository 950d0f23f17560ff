#include "plugins/runtime_construction/plugin_loading.h"

namespace runnel {

Result<void> LoadPlugin(std::string_view plugin, PluginManager& plugins, XmlTagRegistry& tags) {
  plugins.registry().Offer(tags);
  return plugins.Load(plugin);
}

}  // namespace runnel
