#include <filesystem>
#include <utility>

#include "plugins/application_files/build_context.h"
#include "plugins/application_files/saving/file_update.h"
#include "plugins/application_tags/tag_list.h"

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
  const auto loaded = context.plugins().Load(Located(plugin, context));
  if (!loaded) {
    context.MarkPluginMissing();
    Error error = loaded.error();
    error.path = TagUse{*use.xml.parent(), use.parent, context}.path();  // not made yet
    context.Report(std::move(error), plugin.value_position, use.parent);
  }
  return &use.parent;
}

// Which are needed besides is known when all else has been written.
void UpdateLoad(XmlElement tag, FrameworkElement&, internal::FileUpdate& update) {
  const std::string& plugin = tag.Attribute("plugin")->value;
  const bool is_file = plugin.find('/') != std::string::npos;
  update.NoteLoad(is_file ? std::filesystem::path(plugin).stem().string() : plugin);
  if (!is_file) return;
  std::string moved = update.Moved(plugin);
  if (moved.find('/') == std::string::npos) moved.insert(0, "./");
  if (moved != plugin) update.editor().SetAttribute(tag, "plugin", moved);
}

}  // namespace

XmlTag LoadTag() {
  return {.name = "load",
          .summary = "makes the module types and tags of a plugin known",
          .parents = {"application", "group_type"},
          .attributes = {KindRule("plugin", AttributeKind::kPath, "its name, or its file if it contains a '/'", true)},
          .comes_first = true,
          .handle = Load,
          .update = UpdateLoad};
}

}  // namespace runnel
