#pragma once

#include <chrono>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "plugins/control/change_worker.h"
#include "plugins/control/command.h"
#include "plugins/inspector/fault_book.h"
#include "plugins/inspector/inspector.h"
#include "plugins/inspector/internal/catalogue.h"
#include "plugins/inspector/structure_mirror.h"

namespace runnel::internal {

/// What the conversations of all viewers share.
///
/// Threads:  the server's, but for what says otherwise.
class Inspection {
 public:
  using MachineTime = std::chrono::steady_clock::time_point;

  Inspection(ControlledApplication application, Scheduler& scheduler, InspectorOptions options);

  [[nodiscard]] const ControlledApplication& application() const noexcept { return application_; }
  [[nodiscard]] Scheduler& scheduler() const noexcept { return scheduler_; }
  [[nodiscard]] const InspectorOptions& options() const noexcept { return options_; }
  /// Another one with each start.
  [[nodiscard]] const std::string& run() const noexcept { return run_; }
  /// On the application's clock; viewers count from here.
  [[nodiscard]] Time start() const noexcept { return start_; }
  [[nodiscard]] Duration running_for() const { return application_.runtime.clock().Now() - start_; }
  [[nodiscard]] StructureMirror& mirror() noexcept { return mirror_; }
  [[nodiscard]] ChangeWorker& worker() noexcept { return worker_; }
  /// nullptr until it has been made. Any thread.
  [[nodiscard]] std::shared_ptr<const Catalogue> catalogue() const;

  /// Looks at what all share, unless that has just been done. When it is to be called again.
  MachineTime Look();
  /// Something has just been changed: to be looked at at once.
  void LookSoon() noexcept { look_at_ = {}; }

  FaultBook faults;  // any thread
  /// Any thread.
  void NoteEnd(std::string verdict);
  [[nodiscard]] std::optional<std::string> verdict() const;

 private:
  void LookAtRegistry(MachineTime now);

  const ControlledApplication application_;
  Scheduler& scheduler_;
  const InspectorOptions options_;
  const std::string run_;
  const Time start_;
  StructureMirror mirror_;
  MachineTime look_at_{};
  MachineTime look_at_registry_{};
  std::uint64_t registry_ = 0;  // the fingerprint that the catalogue is of
  mutable std::mutex mutex_;    // a leaf; of the two below
  std::shared_ptr<const Catalogue> catalogue_;
  std::optional<std::string> verdict_;
  std::shared_ptr<ChangeWorker::Job> cataloguing_;
  ChangeWorker worker_;  // first to go: its jobs use the rest
};

}  // namespace runnel::internal
