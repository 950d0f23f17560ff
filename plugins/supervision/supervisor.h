#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "plugins/scheduling/scheduler.h"
#include "plugins/supervision/supervision_rules.h"

namespace runnel {

namespace internal {
class StopButton;
}

/// Keeps an application going when a sensor falls silent or a module fails: carries out what its rules
/// say, and takes it back when all is well again.
///
/// Threads:    add rules while nothing runs; they are judged between cycles, by the thread that
///             supervises (real clock) or steps (simulated clock). TakeNotices() from any thread.
/// Costs:      publishers and cycles nothing: what is looked at is the timestamp of the newest value, a few
///             times per time-out.
/// Time:       the application's clock, so in simulated time the same thing happens in the same cycle
///             in every run.
/// Ownership:  destroy it after the cycles have ended; runtime and scheduler must outlive it.
class Supervisor {
 public:
  /// How changes are carried out: all of them, with what takes them back, or none with the reason. Called outside of cycles
  /// and without locks, for example StructureEditor::Apply().
  using Perform = std::function<Result<ChangeSet>(const ChangeSet&)>;

  Supervisor(Runtime& runtime, Scheduler& scheduler, Perform perform);
  ~Supervisor();
  Supervisor(const Supervisor&) = delete;
  Supervisor& operator=(const Supervisor&) = delete;

  /// What is to be done about a module that is stuck must not delete or replace what its thread runs: that fails, as it
  /// would have to wait for it. Errors, of rules of silence: no such port; nothing is connected to it; a time-out that is
  /// not positive.
  Result<void> Add(SupervisionRule rule);
  /// From now on, in a thread of its own. Errors: no such port, or another type.
  Result<void> Add(StopButtonRule rule);
  /// As Scheduler::SetPaused(), and then what the rules say. Errors: the same.
  Result<void> SetPaused(std::string_view path, bool is_paused);

  /// Gives ports that drive their safe value where what feeds them is paused, has failed or is stuck, and takes it back
  /// when it publishes again. Done now and then by itself; on a simulated clock by others while a module is stuck.
  void KeepSafe();

  /// A port of a rule of silence to which nothing new comes.
  struct Silence {
    std::string path;
    Duration lasts{};  ///< so far
    Duration allowed{};
  };
  /// Those that are so now, until they count as fresh again, whatever they are called now. Under the structure lock.
  [[nodiscard]] std::vector<Silence> Silent() const;

  /// What has been done since the last call, oldest first, behind what is there. Errors: no memory; nothing is taken.
  void TakeNotices(std::vector<Notice>& to);

 private:
  struct Shared;

  Scheduler& scheduler_;
  const std::shared_ptr<Shared> shared_;  // with the rules that the scheduler keeps
  std::vector<std::unique_ptr<internal::StopButton>> buttons_;
};

}  // namespace runnel
