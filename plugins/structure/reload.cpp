#include "plugins/structure/reload.h"

#include <filesystem>
#include <mutex>
#include <optional>

#include "core/base/error.h"
#include "core/plugin/module_type_name.h"

namespace runnel {

namespace {

ChangeSet AllAnew(const ModuleRegistry& modules, FrameworkElement& root, std::string_view plugin) {
  ChangeSet changes;
  root.Visit([&](FrameworkElement& each) {
    const ModuleType* const type = modules.Find(FindModuleType(each));
    if (type == nullptr || type->plugin != plugin) return;
    changes.push_back(ReplaceModule{each.path(), type->name});
  });
  return changes;
}

// Of one that is loaded; what is to be said of others is said when it is to be loaded anew.
std::optional<std::filesystem::path> FileOf(const PluginManager& plugins, Runtime& runtime, std::string_view plugin) {
  const std::lock_guard lock(runtime.structure_mutex());
  if (!plugins.IsLoaded(plugin)) return {};
  const auto file = plugins.FindFile(plugin);
  return file ? std::optional(*file) : std::nullopt;
}

}  // namespace

ChangeOutcome ReloadPlugin(PluginManager& plugins, StructureEditor& editor, Runtime& runtime, std::string_view plugin,
                           const RobotStop::AsOf& as_of) {
  std::optional<PluginReload> reload;
  ChangeOutcome outcome;
  try {
    ChangeSet changes;
    std::optional<TemporaryCopy> copy;
    if (const auto file = FileOf(plugins, runtime, plugin)) {
      auto opened = PluginManager::OpenCopy(*file);
      if (!opened) {
        outcome.diagnostics.Add(opened.error());
        return outcome;
      }
      copy.emplace(std::move(*opened));
    }
    {
      const std::lock_guard lock(runtime.structure_mutex());
      changes = AllAnew(plugins.modules(), runtime.root(), plugin);
      auto loaded = copy ? plugins.Reload(plugin, *copy) : plugins.Reload(plugin);
      if (!loaded) {
        outcome.diagnostics.Add(loaded.error());
        return outcome;
      }
      reload.emplace(std::move(*loaded));
    }
    outcome = editor.Apply(changes, {}, as_of);
  } catch (...) {
    outcome.diagnostics.Add({.message = DescribeException()});
  }
  const std::lock_guard lock(runtime.structure_mutex());
  if (reload && outcome.is_done) reload->Keep();
  reload.reset();
  return outcome;
}

}  // namespace runnel
