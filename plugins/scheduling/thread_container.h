#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/element/framework_element.h"
#include "plugins/scheduling/thread_options.h"
#include "plugins/timing/cycle_statistics.h"

namespace runnel {

class CycleRunner;

/// A thread as an element of the tree: runs the modules assigned to it, one after the other along
/// the data flow, in cycles (FINROC's ThreadContainer). Without a Scheduler it does nothing.
///
/// Threads:  options() and statistics() from any thread. Errors: the constructor throws ElementError
///           for a period that is not positive or a priority out of 0 .. 99.
class ThreadContainer final : public FrameworkElement {
 public:
  explicit ThreadContainer(const Placement& placement, const ThreadOptions& options = {});
  ~ThreadContainer() override;

  [[nodiscard]] ThreadOptions options() const noexcept;
  /// Errors: a period that is not positive, a priority out of 0 .. 99; `path`: whose.
  [[nodiscard]] static Result<void> Check(const ThreadOptions& options, const std::string& path);
  /// From one of the next cycles on. Takes the structure lock. Errors: as of the constructor.
  Result<void> SetOptions(const ThreadOptions& options);
  /// Of all cycles so far. Lock-free.
  [[nodiscard]] CycleStatistics statistics() const noexcept;

  /// For executors.
  [[nodiscard]] const std::shared_ptr<CycleRunner>& runner() const noexcept { return runner_; }

 private:
  const std::shared_ptr<CycleRunner> runner_;
};

/// In the order of ThreadOptions::Activation: "period", "free_running", "trigger".
[[nodiscard]] const std::vector<std::string>& ActivationNames();

/// In the order of ThreadOptions::OnOverrun: "skip", "catch_up".
[[nodiscard]] const std::vector<std::string>& OverrunNames();

/// When cycles begin, for people: "every 20ms", "free-running", "when data comes".
[[nodiscard]] std::string ActivationText(const ThreadOptions& options);

/// Makes the container /threads/<name>, ready to be used. Throws ElementError for a name that is
/// taken, or for bad options.
ThreadContainer& CreateThread(Runtime& runtime, const std::string& name, const ThreadOptions& options = {});

/// kModule: by its parameters, and what replaces it says for itself. kNobody: nobody has said anything, and no file is to
/// say it, until the thread is given other options.
enum class AssignedBy : std::uint8_t { kUser, kModule, kNobody };

/// Has `element`, and all below it that is not assigned otherwise, run by `thread` from the next
/// cycle on. If the container is deleted, the assignment is void. Takes the structure lock.
void AssignThread(FrameworkElement& element, ThreadContainer& thread, AssignedBy who = AssignedBy::kUser);

/// Takes the assignment of `element` itself back: what is above it decides again. Takes the structure
/// lock.
void UnassignThread(FrameworkElement& element);

/// The container that `element` itself is assigned to; nullptr if to none, or to one that is gone.
/// Under the structure lock.
[[nodiscard]] ThreadContainer* OwnThread(const FrameworkElement& element);

/// The id of the container that `element` is assigned to, by itself or by what is above
/// it; 0 if to none. Under the structure lock.
[[nodiscard]] std::uint64_t AssignedThread(const FrameworkElement& element);

/// The same, of the element's own assignment only.
[[nodiscard]] std::uint64_t OwnThreadId(const FrameworkElement& element);

/// The same, but 0 where nobody has said it.
[[nodiscard]] std::uint64_t SavedThreadId(const FrameworkElement& element);

/// Told of assignments; an ElementListener may be one too.
class AssignmentListener {
 public:
  /// To another thread or to none, under the structure lock. Must not throw.
  virtual void OnAssigned(FrameworkElement& element) = 0;
  /// The container has other options, under the structure lock. Must not throw.
  virtual void OnOptionsChanged(ThreadContainer& /*thread*/) {}

 protected:
  ~AssignmentListener() = default;
};

}  // namespace runnel
