#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/element/runtime.h"
#include "core/plugin/module_registry.h"
#include "plugins/command_service/command_service.h"
#include "plugins/inspector/inspector.h"
#include "plugins/inspector/panel_file.h"
#include "plugins/inspector/structure_mirror.h"
#include "plugins/manifest/module_description.h"

namespace runnel::internal {

/// What modules can be made of.
struct Catalogue {
  std::vector<ModuleDescription> modules;
  std::string message;  ///< of the protocol, with all modules and types
};

/// All module types, as the manifests of their plugins describe them; where there is none, by making a module
/// beside the tree, under the structure lock, which is let go between any two. Types whose modules cannot be made
/// have no ports in it, and "problem" says why.
///
/// Threads:  one that may wait.
[[nodiscard]] Catalogue MakeCatalogue(const ServedApplication& application);

/// Another number if other module types, or types of values, are registered. Under the structure lock.
[[nodiscard]] std::uint64_t RegistryFingerprint(const ModuleRegistry& modules);

/// The types that could stand in for the module at `path`, as a JSON list: those that take over all of
/// its connections first, then those that lose the fewest; each with "lost", the names of ports whose
/// connections would go. Those that keep none are left out. Errors: there is no such module.
[[nodiscard]] Result<std::string> CompatibleTypes(Runtime& runtime, const Catalogue& catalogue,
                                                  const std::string& path);

/// What viewers have arranged, in their own words: where boxes stand, notes on them. Texts by names, shared by
/// all viewers and kept in a file beside the application's. The application knows nothing of it.
///
/// Threads:  one, but for Write().
class Arrangement {
 public:
  using Entries = std::map<std::string, std::string>;
  static constexpr std::size_t kMostEntries = 20'000;
  static constexpr std::size_t kLongestName = 1'000;  ///< bytes
  static constexpr std::size_t kLongestText = 2'000;

  /// Where it is kept: "/x/robot.xml" has "/x/robot.layout.json"; "" has none.
  [[nodiscard]] static std::string FileOf(const std::string& application_file);

  /// Takes over what is in the file; a file that is not there is an empty one.
  /// Errors: it cannot be read; nothing has been taken over then.
  Result<void> Read(const std::string& file);

  /// An empty text takes the entry away. Errors: too long, too many; nothing has been changed then.
  Result<void> Change(const Entries& changed);

  /// Counts changes.
  [[nodiscard]] std::uint64_t revision() const noexcept { return revision_; }
  /// What has become of the entries that were changed after `revision`: "" is gone. After 0: all there are.
  [[nodiscard]] Entries Since(std::uint64_t revision) const;
  /// The same as viewers are told it.
  [[nodiscard]] std::string MessageSince(std::uint64_t revision) const;

  /// As a file has it: an entry a line, in order of their names.
  [[nodiscard]] std::string Text() const;
  /// Any thread. Without text the file is taken away. Errors: of the file.
  static Result<void> Write(const std::string& file, const std::string& text);

 private:
  struct Entry {
    std::string text;  // "": taken away; viewers may not have been told yet
    std::uint64_t revision = 0;
  };
  std::map<std::string, Entry> entries_;
  std::uint64_t revision_ = 0;
};

/// What the sessions of all viewers share.
///
/// Threads:  the server's, but for what says otherwise.
class Inspection {
 public:
  using SteadyTime = std::chrono::steady_clock::time_point;

  Inspection(CommandService& service, Scheduler& scheduler, InspectorOptions options);

  [[nodiscard]] CommandService& service() noexcept { return service_; }
  [[nodiscard]] const ServedApplication& application() const noexcept { return application_; }
  [[nodiscard]] Scheduler& scheduler() const noexcept { return scheduler_; }
  [[nodiscard]] const InspectorOptions& options() const noexcept { return options_; }
  /// How viewers are called in what they change: the first is 1.
  [[nodiscard]] std::uint64_t NumberViewer() noexcept { return ++viewers_; }
  /// Another one with each start.
  [[nodiscard]] const std::string& run() const noexcept { return run_; }
  /// On the application's clock; viewers count from here.
  [[nodiscard]] Time start() const noexcept { return start_; }
  [[nodiscard]] Duration running_for() const { return application_.runtime.clock().Now() - start_; }
  [[nodiscard]] StructureMirror& mirror() noexcept { return mirror_; }
  [[nodiscard]] PanelFile& panel() noexcept { return panel_; }
  /// Of the server's thread.
  [[nodiscard]] Arrangement& arrangement() noexcept { return arrangement_; }
  [[nodiscard]] TaskGroup& tasks() noexcept { return tasks_; }
  /// What the STOP holds and does not reach, half a second old at most; nothing: it could not be known then. For all
  /// viewers at once, since everything is walked through for it.
  [[nodiscard]] const std::optional<StopReach>& stop_reach();
  /// nullptr until it has been made. Any thread.
  [[nodiscard]] std::shared_ptr<const Catalogue> catalogue() const {
    const std::lock_guard lock(mutex_);
    return catalogue_;
  }

  /// Looks at what all share, unless that has just been done. When it is to be called again.
  SteadyTime Look();
  /// Something has just been changed: to be looked at at once.
  void LookSoon() noexcept { look_at_ = {}; }

  /// Any thread.
  void NoteEnd(std::string verdict) {
    const std::lock_guard lock(mutex_);
    verdict_ = std::move(verdict);
  }
  [[nodiscard]] std::optional<std::string> verdict() const {
    const std::lock_guard lock(mutex_);
    return verdict_;
  }

 private:
  void LookAtRegistry(SteadyTime now);

  CommandService& service_;
  const ServedApplication& application_;  // the service's
  Scheduler& scheduler_;
  const InspectorOptions options_;
  const std::string run_;
  const Time start_;
  StructureMirror mirror_;
  PanelFile panel_;
  Arrangement arrangement_;
  std::uint64_t viewers_ = 0;
  SteadyTime look_at_{};
  SteadyTime look_at_registry_{};
  SteadyTime look_at_reach_{};
  std::optional<StopReach> reach_;
  std::uint64_t registry_ = 0;  // the fingerprint that the catalogue is of
  mutable std::mutex mutex_;    // a leaf; of the two below
  std::shared_ptr<const Catalogue> catalogue_;
  std::optional<std::string> verdict_;
  std::shared_ptr<WorkerTask> cataloguing_;
  TaskGroup tasks_;  // first to go: they use the rest
};

}  // namespace runnel::internal
