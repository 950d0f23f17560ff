#include <filesystem>
#include <utility>

#include "plugins/runtime_construction/build_context.h"
#include "plugins/runtime_construction/plugin_loading.h"
#include "plugins/runtime_construction/tags/built_in_tags.h"

namespace runnel {

namespace {

// A plugin is named; with a '/' it is a file, and starts in the folder of the application file.
std::string Located(const XmlAttribute& attribute, BuildContext& context) {
  const std::string& plugin = attribute.value;
  if (plugin.find('/') == std::string::npos) return plugin;
  std::string file = (context.FolderOf(attribute.position) / plugin).string();
  // "./motion.so" of the current folder must not become a name again.
  return file.find('/') == std::string::npos ? "./" + file : file;
}

FrameworkElement* Load(const TagUse& use) {
  BuildContext& context = use.context;
  const XmlAttribute& plugin = use.Get("plugin");
  const auto loaded = LoadPlugin(Located(plugin, context), context.plugins(), context.tags());
  if (!loaded) {
    context.MarkPluginMissing();
    Error error = loaded.error();
    error.path = TagUse{*use.xml.parent(), use.parent, context}.path();  // not made yet
    context.Report(std::move(error), plugin.value_position, use.parent);
  }
  return &use.parent;
}

}  // namespace

XmlTag LoadTag() {
  return {.name = "load",
          .summary = "makes the module types and tags of a plugin known",
          .parents = {"application", "group_type"},
          .attributes = {{.name = "plugin",
                          .kind = AttributeKind::kPath,
                          .required = true,
                          .summary = "its name, or its file if it contains a '/'"}},
          .comes_first = true,
          .handle = Load};
}

}  // namespace runnel
