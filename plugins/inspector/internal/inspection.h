#pragma once

#include <chrono>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "plugins/command_service/command_service.h"
#include "plugins/inspector/inspector.h"
#include "plugins/inspector/internal/arrangement.h"
#include "plugins/inspector/internal/catalogue.h"
#include "plugins/inspector/panel_file.h"
#include "plugins/inspector/structure_mirror.h"

namespace runnel::internal {

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
  /// nullptr until it has been made. Any thread.
  [[nodiscard]] std::shared_ptr<const Catalogue> catalogue() const;

  /// Looks at what all share, unless that has just been done. When it is to be called again.
  SteadyTime Look();
  /// Something has just been changed: to be looked at at once.
  void LookSoon() noexcept { look_at_ = {}; }

  /// Any thread.
  void NoteEnd(std::string verdict);
  [[nodiscard]] std::optional<std::string> verdict() const;

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
  std::uint64_t registry_ = 0;  // the fingerprint that the catalogue is of
  mutable std::mutex mutex_;    // a leaf; of the two below
  std::shared_ptr<const Catalogue> catalogue_;
  std::optional<std::string> verdict_;
  std::shared_ptr<WorkerTask> cataloguing_;
  TaskGroup tasks_;  // first to go: they use the rest
};

}  // namespace runnel::internal
