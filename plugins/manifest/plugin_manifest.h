#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/result.h"
#include "plugins/manifest/module_description.h"

namespace runnel {

/// What the modules of a plugin look like, in a file beside its library (planning.so, planning.manifest.xml), so
/// that neither the library has to be loaded nor a module be made by who only wants to know.
struct PluginManifest {
  std::string plugin;
  std::string build_id;  ///< of the library that it was made of
  std::vector<ModuleDescription> modules;
};

/// Where the manifest of a library is.
[[nodiscard]] std::filesystem::path ManifestFileOf(const std::filesystem::path& library);

/// The manifest as it stands in its file.
[[nodiscard]] std::string ManifestText(const PluginManifest& manifest);

/// The manifest of a library. Errors: there is none, it is wrong, or it is of another build of the library than the
/// one that is there.
[[nodiscard]] Result<PluginManifest> ReadManifest(const std::filesystem::path& library);

/// What module types look like: from the manifests of their plugins, each of which is read once, or where there is
/// none by making a module.
///
/// Threads:  one, that may wait.
class ModuleDescriber {
 public:
  /// `library_of`: the file of a plugin, "" if it is unknown.
  using LibraryOf = std::function<std::string(const std::string& plugin)>;
  ModuleDescriber(Runtime& runtime, const ModuleRegistry& modules, LibraryOf library_of)
      : runtime_(runtime), modules_(modules), library_of_(std::move(library_of)) {}

  /// nullopt if there is no such type (any more).
  [[nodiscard]] std::optional<ModuleDescription> Describe(const std::string& type);

 private:
  [[nodiscard]] const PluginManifest* ManifestOf(const std::string& plugin);

  Runtime& runtime_;
  const ModuleRegistry& modules_;
  const LibraryOf library_of_;
  std::map<std::string, std::optional<PluginManifest>> manifests_;
};

/// What the linker has marked a library by, in hexadecimal; another one for other contents. Errors: it cannot be
/// read, is no library, or has no mark (--build-id).
[[nodiscard]] Result<std::string> BuildIdOf(const std::filesystem::path& library);

}  // namespace runnel
