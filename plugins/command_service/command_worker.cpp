#include "plugins/command_service/command_worker.h"

#include <algorithm>
#include <utility>

#include "core/element/attempt.h"

namespace runnel {

namespace {

thread_local bool is_worker = false;

}  // namespace

CommandWorker::~CommandWorker() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  has_changed_.notify_all();
  thread_.join();
}

bool CommandWorker::IsThisThread() noexcept { return is_worker; }

void CommandWorker::Work() {
  is_worker = true;
  Tasks running;  // one at most; a list, so that handing it over allocates nothing
  std::unique_lock lock(mutex_);
  while (!ends_) {
    const auto next =
        std::ranges::min_element(waiting_, {}, [](const std::shared_ptr<WorkerTask>& task) { return task->due_; });
    if (next == waiting_.end()) {
      has_changed_.wait(lock);
      continue;
    }
    const auto due = (*next)->due_;
    if (due > std::chrono::steady_clock::now()) {
      has_changed_.wait_until(lock, due);
      continue;
    }
    running.splice(running.end(), waiting_, next);
    WorkerTask& task = *running.front();
    running_ = task.group_;
    lock.unlock();
    const std::optional<Duration> again = Step(task);
    if (!again) Conclude(task);
    const auto now = std::chrono::steady_clock::now();
    lock.lock();
    if (again) {
      task.due_ = now + *again;
      waiting_.splice(waiting_.end(), running);
    } else {
      running.clear();
    }
    running_ = nullptr;
    has_changed_.notify_all();
  }
}

std::optional<Duration> CommandWorker::Step(WorkerTask& task) {
  if (task.is_cancelled_.load(std::memory_order_relaxed)) return {};
  try {
    return task.step_();
  } catch (...) {
    task.failure_ = CaughtError();
    return {};
  }
}

void CommandWorker::Conclude(WorkerTask& task) {
  task.step_ = nullptr;
  // Who sees that it is done may let go of the group's client, but not before this returns.
  const std::function<void()> on_done = std::move(task.on_done_);
  task.is_done_.store(true, std::memory_order_release);
  if (!on_done) return;
  try {
    on_done();
  } catch (...) {
    // Clients are told a little later then: they look by themselves now and then.
  }
}

TaskGroup::~TaskGroup() {
  CommandWorker::Tasks dropped;  // destroyed without the lock
  std::unique_lock lock(worker_.mutex_);
  const auto drop = [&] {
    for (auto each = worker_.waiting_.begin(); each != worker_.waiting_.end();) {
      const auto task = each++;
      if ((*task)->group_ == this) dropped.splice(dropped.end(), worker_.waiting_, task);
    }
  };
  drop();
  if (!CommandWorker::IsThisThread()) {
    worker_.has_changed_.wait(lock, [this] { return worker_.running_ != this; });
    drop();  // what wanted a further step
  }
}

std::shared_ptr<WorkerTask> TaskGroup::PostSteps(TaskStep step, std::function<void()> on_done) {
  auto task = std::make_shared<WorkerTask>();
  task->group_ = this;
  task->step_ = std::move(step);
  task->on_done_ = on_done ? std::move(on_done) : on_done_;
  CommandWorker::Tasks one{task};
  CommandWorker& worker = worker_;  // once the task waits, it may run and end this group
  {
    const std::lock_guard lock(worker.mutex_);
    task->due_ = std::chrono::steady_clock::now();
    worker.waiting_.splice(worker.waiting_.end(), one);
  }
  worker.has_changed_.notify_all();
  return task;
}

std::shared_ptr<WorkerTask> TaskGroup::Done(std::function<void()> on_done) {
  auto task = std::make_shared<WorkerTask>();
  task->on_done_ = on_done ? std::move(on_done) : on_done_;
  CommandWorker::Conclude(*task);
  return task;
}

std::shared_ptr<WorkerTask> TaskGroup::Post(std::function<void()> work, std::function<void()> on_done) {
  return PostSteps(
      [work = std::move(work)]() -> std::optional<Duration> {
        work();
        return {};
      },
      std::move(on_done));
}

}  // namespace runnel
