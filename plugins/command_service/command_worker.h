#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "core/base/clock.h"
#include "core/base/error.h"

namespace runnel {

class CommandWorker;
class TaskGroup;

/// One step of a task. Nothing: the task is done; a duration: the next step is wanted so long after this
/// one, and other tasks have their turn meanwhile. Whatever it throws ends the task, and is its failure.
using TaskStep = std::function<std::optional<Duration>()>;

/// Something for the worker to do, as its client sees it.
///
/// Threads:  any.
class WorkerTask {
 public:
  [[nodiscard]] bool is_done() const noexcept { return is_done_.load(std::memory_order_acquire); }
  /// What a step has thrown. Precondition: is_done().
  [[nodiscard]] const std::optional<Error>& failure() const noexcept { return failure_; }
  /// No further step begins, not even the first.
  void Cancel() noexcept { is_cancelled_.store(true, std::memory_order_relaxed); }

 private:
  friend class CommandWorker;
  friend class TaskGroup;
  using SteadyTime = std::chrono::steady_clock::time_point;

  TaskGroup* group_ = nullptr;
  TaskStep step_;
  std::function<void()> on_done_;
  SteadyTime due_{};  // guarded by the worker's mutex
  std::optional<Error> failure_;
  std::atomic<bool> is_cancelled_{false};
  // release when done: who sees it sees what the steps have done.
  std::atomic<bool> is_done_{false};
};

/// The one thread of an application that carries out what clients ask for and what may take long: changes,
/// which wait for cycles to end, saving, loading plugins anew. One step after the other, so that requests of
/// several transports (control socket, inspector, Foxglove) never interleave.
///
/// Ownership:  outlives its groups.
class CommandWorker {
 public:
  CommandWorker() : thread_([this] { Work(); }) {}
  ~CommandWorker();

  /// Whether the calling thread is the worker of any application.
  [[nodiscard]] static bool IsThisThread() noexcept;

 private:
  friend class TaskGroup;
  using Tasks = std::list<std::shared_ptr<WorkerTask>>;

  void Work();
  static std::optional<Duration> Step(WorkerTask& task);
  static void Conclude(WorkerTask& task);

  std::mutex mutex_;
  std::condition_variable has_changed_;  // what is guarded by mutex_
  Tasks waiting_;                        // guarded by mutex_, in the order in which they have come
  const TaskGroup* running_ = nullptr;   // guarded by mutex_: whose step is being carried out
  bool ends_ = false;                    // guarded by mutex_
  std::thread thread_;
};

/// The tasks of one client of the worker, which may refer to whatever lives longer than their group.
///
/// Threads:  Post() by any. Destroying it drops the tasks of which no step has begun, and waits for a step
///           that is being carried out, unless it is this step that destroys it.
class TaskGroup {
 public:
  /// `on_done` is called by the worker's thread after each task for which Post() was told of no other one.
  explicit TaskGroup(CommandWorker& worker, std::function<void()> on_done = {})
      : worker_(worker), on_done_(std::move(on_done)) {}
  ~TaskGroup();
  TaskGroup(const TaskGroup&) = delete;
  TaskGroup& operator=(const TaskGroup&) = delete;

  /// `on_done` is called by the worker's thread when the task is done; it must not wait.
  std::shared_ptr<WorkerTask> PostSteps(TaskStep step, std::function<void()> on_done = {});
  /// One that needs no step. `on_done` is called before this returns.
  std::shared_ptr<WorkerTask> Done(std::function<void()> on_done = {});
  /// A task of one step.
  std::shared_ptr<WorkerTask> Post(std::function<void()> work, std::function<void()> on_done = {});

 private:
  CommandWorker& worker_;
  const std::function<void()> on_done_;
};

}  // namespace runnel
