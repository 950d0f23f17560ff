#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "core/element/runtime.h"
#include "plugins/scheduling/internal/schedule_plan.h"
#include "plugins/scheduling/schedule.h"
#include "plugins/scheduling/thread_container.h"
#include "plugins/timing/profile.h"

namespace runnel {

class CycleTracer;

/// Keeps a schedule for each thread container of the tree: all of them made anew at first and when
/// containers come or go, then only what a change touches. Nothing takes effect before Install().
///
/// Threads:  all under the structure lock.
/// Effort:   of CompileAll(), the size of the application; of a change, that of what has changed; of
///           Install(), that of the threads whose order has changed: each is sorted anew, as a whole.
class ScheduleCompiler {
 public:
  using Runners = std::vector<std::shared_ptr<CycleRunner>>;

  /// Tasks that are assigned to no container go to the one called `default_thread`, or to the first
  /// if there is none of that name.
  /// `tracer`, if there is one, is told of all that is to be run; all tasks are run by way of `watch`, if there
  /// is one.
  explicit ScheduleCompiler(std::string default_thread, CycleTracer* tracer = nullptr, TaskWatch* watch = nullptr)
      : default_thread_(std::move(default_thread)), tracer_(tracer), watch_(watch) {}
  ~ScheduleCompiler();
  ScheduleCompiler(const ScheduleCompiler&) = delete;
  ScheduleCompiler& operator=(const ScheduleCompiler&) = delete;

  /// Whether CompileAll() is due; until then changes are not followed.
  [[nodiscard]] bool needs_all() const noexcept { return needs_all_; }
  void NeedAll() noexcept { needs_all_ = true; }
  /// Plans everything that is there. Only elements that are ready are run.
  void CompileAll(FrameworkElement& root);
  /// There are tasks, but no container.
  [[nodiscard]] bool has_unassigned_tasks() const noexcept { return has_unassigned_tasks_; }

  // What has happened, each after it has.
  void Add(FrameworkElement& element) noexcept;
  void Connect(const Port& from, const Port& to) noexcept;
  void Disconnect(const Port& from, const Port& to) noexcept;
  void Reassign(FrameworkElement& element) noexcept;
  /// Whether its cycles wait for data may be another now; everybody has to know who does.
  void FollowActivation(const CycleRunner& runner) noexcept;
  /// All at or below `element` is about to go: unties their trigger inputs and forgets them; the next
  /// schedules do not contain them.
  void Release(FrameworkElement& element) noexcept;

  /// Whether Install() has something to do.
  [[nodiscard]] bool has_changes() const noexcept { return !changed_threads_.empty() || !gone_runners_.empty(); }
  /// Puts what has changed into place, for all threads together.
  void Install();

  /// Of all containers, in the order in which they were made.
  [[nodiscard]] Runners runners() const;
  [[nodiscard]] bool HasTasks() const;
  /// Whether the element has thrown.
  [[nodiscard]] bool IsStopped(const FrameworkElement& element) const;
  /// Of the nearest element at or above it that is run; nullptr: none is.
  [[nodiscard]] const internal::PlannedElement* FindAround(const FrameworkElement& element) const;
  /// Adds those that run anything at or below `element`, as planned, and are not in `runners` yet.
  void AddRunnersOf(FrameworkElement& element, Runners& runners) const;

  /// All tasks with their times, thread by thread, as Install() has them run.
  [[nodiscard]] std::vector<ProfiledTask> Tasks() const;
  void ResetMeters();
  /// By the ids of elements; those that are not named have none from now on.
  void SetChains(std::map<std::uint64_t, std::unique_ptr<ChainSteps>> steps);
  /// Leaves what is at or below the element out of cycles, or all that it runs if it is a thread, also what comes
  /// later; or no more. It is kept with the element, and goes along with it.
  void SetPaused(FrameworkElement& element, bool is_paused);
  /// Whether anything at or below the element is to be left out, for another reason than that `but_for` is paused.
  [[nodiscard]] bool IsPaused(FrameworkElement& element, const FrameworkElement* but_for = nullptr) const;

  /// Loops that were cut, modules that never run or that name no thread where there are several.
  [[nodiscard]] std::vector<Error> Warnings() const;

 private:
  using ThreadSchedules = std::map<std::uint64_t, std::unique_ptr<internal::ThreadSchedule>>;  // by their containers

  template <typename Change>
  void Follow(const Change& change) noexcept;
  void ReleaseAll(FrameworkElement& element);
  void MakeThreadSchedules(const std::vector<ThreadContainer*>& containers);
  void Plan(FrameworkElement& element);
  void AddTasks(internal::PlannedElement& planned);
  void RemoveTasks(internal::PlannedElement& planned);
  void Refresh(FrameworkElement& element);
  void ConnectTasks(internal::PlannedElement& planned);
  void OrderPair(const Port& output, const Port& input, bool is_connected = true);
  void HandOver(internal::PlannedElement& planned, internal::ThreadSchedule& thread);
  void Touch(internal::ThreadSchedule& thread);
  void NoteChange(internal::ThreadSchedule& thread);
  [[nodiscard]] internal::ThreadSchedule* ChooseThread(const FrameworkElement& element) const;
  [[nodiscard]] bool IsAChoiceMissing(const FrameworkElement& element) const;
  [[nodiscard]] static bool IsToBePaused(const internal::PlannedElement& planned,
                                         const FrameworkElement* but_for = nullptr);
  std::unique_ptr<Schedule> MakeSchedule(internal::ThreadSchedule& thread);

  const std::string default_thread_;
  CycleTracer* const tracer_;
  TaskWatch* const watch_;
  bool needs_all_ = true;
  bool has_handovers_ = false;
  bool has_unassigned_tasks_ = false;
  std::map<std::uint64_t, internal::PlannedElement> elements_;  // by id
  ThreadSchedules threads_;
  std::vector<internal::ThreadSchedule*> changed_threads_;
  Runners gone_runners_;  // until the next Install()
  internal::TasksOfGroups tasks_of_groups_;
  std::shared_ptr<const std::vector<CycleRunner*>> waiting_;
  std::shared_ptr<Installation> installation_ = std::make_shared<Installation>();  // the next one
  std::uint64_t schedules_made_ = 0;
};

}  // namespace runnel
