// How the threads of a Scheduler on the real clock begin and end.

#include <algorithm>
#include <mutex>
#include <optional>
#include <utility>

#include "core/base/check.h"
#include "core/base/exception_text.h"
#include "core/module/executable.h"
#include "plugins/scheduling/real_thread.h"
#include "plugins/scheduling/scheduler.h"

namespace runnel {

// Room comes first: a thread that could not be kept would be waited for here, under the lock that its cycle
// may need.
void Scheduler::StartThreads(Time first) {
  ending_.reserve(ending_.size() + threads_.size());
  threads_.reserve(threads_.size() + runners_.size());
  const auto is_gone = [this](const auto& thread) {
    return std::ranges::find(runners_, thread->runner()) == runners_.end();
  };
  for (auto& thread : threads_) {
    if (!is_gone(thread)) continue;
    thread->RequestStop();
    ending_.push_back(std::move(thread));
  }
  std::erase(threads_, nullptr);
  std::erase_if(ending_, [](const auto& thread) { return thread->has_ended(); });
  for (const auto& runner : runners_) {
    const bool has_thread = std::ranges::any_of(
        threads_, [&](const auto& thread) { return thread->runner() == runner; });
    if (has_thread) continue;
    threads_.push_back(std::make_unique<RealThread>(runner, faults_, first));
    if (auto warning = threads_.back()->Prioritize()) {
      realtime_warnings_.push_back(std::move(*warning));
    }
  }
  has_other_runners_ = false;
  cycle_watchdog_.Follow(runners_);
}

// Something with tasks that nobody has made ready would be there, connected, and silent for ever.
std::optional<Error> Scheduler::NeverReady() const {
  const std::lock_guard lock(runtime_.structure_mutex());
  const FrameworkElement* found = nullptr;
  runtime_.root().Visit([&](FrameworkElement& element) {
    const bool is_silent = element.life_cycle() == LifeCycle::kConstructed &&
                           element.FindAnnotation<Executable>() != nullptr;
    if (is_silent && found == nullptr) found = &element;
  });
  if (found == nullptr) return {};
  return Error{.message = "has not been made ready, and would never run",
               .path = found->path(),
               .hint = "runtime.MakeReady(runtime.root()) before the start"};
}

Result<void> Scheduler::Start() {
  if (options_.clock == SchedulerOptions::ClockKind::kSimulated) {
    return Error{.message = "an application on a simulated clock has no threads to start",
                 .hint = "use Step() or RunUntil()"};
  }
  const std::lock_guard start_lock(start_mutex_);
  if (is_running()) return {};
  if (const auto stuck = StuckModules(); !stuck.empty()) {
    return Error{.message = "has not returned from its last cycle yet", .path = stuck[0].path};
  }
  if (auto forgotten = NeverReady()) return *forgotten;
  try {
    StartAll();
    return {};
  } catch (...) {
    EndAll();
    return Error{.message = "the threads could not be started: " + DescribeException()};
  }
}

void Scheduler::StartAll() {
  const std::lock_guard lock(runtime_.structure_mutex());
  if (std::exchange(has_run_, false)) faults_.ClearStop();
  realtime_warnings_.clear();
  compiler_.NeedAll();
  BringUpToDate();
  const bool has_priorities = std::ranges::any_of(
      runners_, [](const auto& runner) { return runner->options().priority > 0; });
  if (has_priorities && options_.lock_memory) {
    if (auto warning = LockMemory()) realtime_warnings_.push_back(std::move(*warning));
  }
  supervises_.store(true, std::memory_order_release);
  supervisor_ = std::thread([this] { Supervise(); });
  StartThreads(machine_.Now());
  cycle_watchdog_.Begin();
  is_running_ = true;
}

void Scheduler::Stop() {
  RUNNEL_CHECK(std::this_thread::get_id() != supervisor_.get_id(),
               "a fault rule cannot stop the scheduler itself; call RequestStop()");
  const std::lock_guard start_lock(start_mutex_);
  if (EndAll()) has_run_ = true;
}

// Whether it was running. Without allocating, so that nothing is left half running.
bool Scheduler::EndAll() noexcept {
  bool was_running = false;
  RealThreads ended;
  {
    const std::lock_guard lock(runtime_.structure_mutex());
    was_running = std::exchange(is_running_, false);
    ended.swap(ending_);
    for (auto& thread : threads_) ended.push_back(std::move(thread));  // StartThreads() has made room
    threads_.clear();
  }
  // The structure lock is free meanwhile, so that a cycle that needs it can come to its end.
  for (const auto& thread : ended) thread->RequestStop();
  EndThreads(ended);
  cycle_watchdog_.End();
  has_changes_.store(true,
                     std::memory_order_relaxed);  // so that it begins again with the next step
  EndSupervision();
  const std::lock_guard lock(runtime_.structure_mutex());
  ending_.swap(ended);
  return was_running;
}

// Joins them, but for those that are stuck.
void Scheduler::EndThreads(RealThreads& threads) noexcept {
  if (cycle_watchdog_.has_rules()) {
    for (const auto& thread : threads) {
      while (!thread->has_ended() && !cycle_watchdog_.IsStuck(*thread->runner())) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
    }
    std::erase_if(threads, [](const auto& thread) { return thread->has_ended(); });
  } else {
    threads.clear();
  }
}

bool Scheduler::is_running() const {
  const std::lock_guard lock(runtime_.structure_mutex());
  return is_running_;
}

}  // namespace runnel
