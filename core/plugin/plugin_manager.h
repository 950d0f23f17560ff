#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/files.h"
#include "core/base/result.h"
#include "core/base/retry.h"
#include "core/plugin/module_registry.h"
#include "core/plugin/plugin_registry.h"

namespace runnel {

/// A plugin that has been loaded anew, until it is known whether it does.
class PluginReload {
 public:
  PluginReload(PluginRegistry& registry, std::string plugin, std::function<void()> back)
      : registry_(&registry), plugin_(std::move(plugin)), back_(std::move(back)) {}
  ~PluginReload() { PutBack(); }
  PluginReload(PluginReload&& other) noexcept
      : registry_(other.registry_), plugin_(std::move(other.plugin_)), back_(std::exchange(other.back_, nullptr)) {}
  PluginReload& operator=(PluginReload&&) = delete;

  /// It does: what the library of before had registered is forgotten.
  void Keep() noexcept { back_ = nullptr; }
  /// Everything is registered as before.
  void PutBack() noexcept {
    if (!back_) return;
    Retry([this] { (void)registry_->SetAside(plugin_); });
    Retry(std::exchange(back_, nullptr));
  }

 private:
  PluginRegistry* registry_;
  std::string plugin_;
  std::function<void()> back_;
};

/// Finds plugin libraries, checks that they can be trusted, and has them register what they bring.
///
/// Where it looks for plugin `motion`, in this order: the folders of the environment variable
/// RUNNEL_PLUGIN_PATH (separated by ':'), then `runnel/plugins` beside the core's own library,
/// which is right in a build tree and in an install tree. The file is `motion.so`. A name with a
/// '/' is a file.
///
/// Ownership:  of nothing that outlives it but the libraries, which stay in memory.
/// Threads:    not thread-safe.
/// Errors:     a library that is refused leaves nothing behind in the registries.
class PluginManager {
 public:
  PluginManager();

  [[nodiscard]] ModuleRegistry& modules() noexcept { return modules_; }
  [[nodiscard]] const ModuleRegistry& modules() const noexcept { return modules_; }
  /// To offer further registries to plugins, before loading any.
  [[nodiscard]] PluginRegistry& registry() noexcept { return registry_; }

  [[nodiscard]] const std::vector<std::filesystem::path>& search_path() const noexcept { return search_path_; }
  /// Looked at before all others.
  void AddSearchFolder(std::filesystem::path folder);

  /// Loads the plugin unless it is loaded already. Errors: not found (with where it was looked for
  /// and the nearest name), not loadable, no entry, another ABI, throwing registration, duplicate
  /// type, another file of that name loaded already.
  Result<void> Load(std::string_view name);
  /// The part of Load() that reads the disk, for who must not keep others waiting: the library stays in memory, and
  /// Load() finds it there. `file`: by FindFile(). What is wrong with it Load() says. Any thread.
  static void OpenAhead(const std::filesystem::path& file);
  /// Loads the file of a plugin that is loaded as it is now, beside the library of before, whose code
  /// stays for what was made with it. New modules are made by the new one; if the returned object goes
  /// without Keep(), by the old one again. Errors: as Load(), and a library that it needs has been built anew,
  /// too; everything is as before then.
  Result<PluginReload> Reload(std::string_view name);
  /// The same in two parts, of which the first reads the disk: `file` by FindFile(). Any thread.
  static Result<TemporaryCopy> OpenCopy(const std::filesystem::path& file);
  Result<PluginReload> Reload(std::string_view name, const TemporaryCopy& copy);
  /// The names of the plugins that could be loaded from the search path, sorted.
  [[nodiscard]] std::vector<std::string> Available() const;
  [[nodiscard]] const std::vector<std::string>& loaded() const noexcept { return loaded_; }
  [[nodiscard]] bool IsLoaded(std::string_view name) const noexcept { return files_.find(name) != files_.end(); }
  /// The file of a plugin that is loaded, or would be. Errors: there is none, with the nearest name.
  [[nodiscard]] Result<std::filesystem::path> FindFile(std::string_view name) const;

 private:
  using Files = std::map<std::string, std::filesystem::path, std::less<>>;

  Result<void> LoadUnlessKnown(std::string_view name);
  [[nodiscard]] Result<std::filesystem::path> FindKnown(std::string_view name) const;
  Result<PluginReload> ReloadKnown(std::string_view name, const TemporaryCopy& copy);
  Result<void> Register(const std::string& name, const std::filesystem::path& file);

  ModuleRegistry modules_;
  PluginRegistry registry_{modules_};
  std::vector<std::filesystem::path> search_path_;
  std::vector<std::string> loaded_;
  Files files_;  // of those in loaded_, canonical
};

}  // namespace runnel
