// How the threads of a Scheduler on the real clock begin and end. And what it does between cycles: attends to
// faults, brings up to date what could not be at once, looks out, and has the watchdog name who does not return.

#include <algorithm>
#include <exception>
#include <mutex>
#include <optional>
#include <utility>

#include "core/base/check.h"
#include "core/base/error.h"
#include "core/base/retry.h"
#include "core/module/executable.h"
#include "plugins/scheduling/real_thread.h"
#include "plugins/scheduling/scheduler.h"

namespace runnel {

namespace {

constexpr Duration kSoon = std::chrono::milliseconds(50);  // what has failed is tried again

// Without memory even for this there is nothing to tell it with; what has failed is tried again.
void ReportException(const char* what, const std::exception_ptr& exception, FaultDispatcher& faults,
                     Runtime& runtime) noexcept {
  try {
    faults.Report({runtime.root().path(), what + DescribeException(exception), runtime.clock().Now()});
  } catch (...) {
  }
}

}  // namespace

// Room comes first: a thread that could not be kept would be waited for here, under the lock that its cycle
// may need.
void Scheduler::StartThreads(Time first) {
  ending_.reserve(ending_.size() + threads_.size() + runners_.size());
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
    const bool has_thread =
        std::ranges::any_of(threads_, [&](const auto& thread) { return thread->runner() == runner; });
    if (has_thread) continue;
    threads_.push_back(std::make_unique<RealThread>(runner, faults_, first));
    if (auto warning = threads_.back()->Prioritize()) {
      realtime_warnings_.push_back(std::move(*warning));
    }
  }
  cycle_watchdog_.Follow(runners_);
  has_other_runners_ = false;
}

// Something with tasks that nobody has made ready would be there, connected, and silent for ever.
std::optional<Error> Scheduler::NeverReady() const {
  const std::lock_guard lock(runtime_.structure_mutex());
  const FrameworkElement* found = nullptr;
  runtime_.root().Visit([&](FrameworkElement& element) {
    const bool is_silent =
        element.life_cycle() == LifeCycle::kConstructed && element.FindAnnotation<Executable>() != nullptr;
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
  const bool has_priorities =
      std::ranges::any_of(runners_, [](const auto& runner) { return runner->options().priority > 0; });
  if (has_priorities && options_.lock_memory) {
    if (auto warning = LockMemory()) realtime_warnings_.push_back(std::move(*warning));
  }
  faults_.SetActsBeside(true);
  supervises_.store(true, std::memory_order_release);
  supervisor_ = std::thread([this] { Supervise(); });
  StartThreads(machine_.Now());
  cycle_watchdog_.Begin();
  is_running_ = true;
}

void Scheduler::Stop() {
  RUNNEL_CHECK(std::this_thread::get_id() != supervisor_.get_id(),
               "a fault rule cannot end the scheduler itself; call RequestStop()");
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
  for (const auto& thread : threads) {
    while (!thread->has_ended() && !cycle_watchdog_.IsStuck(*thread->runner())) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
  std::erase_if(threads, [](const auto& thread) { return thread->has_ended(); });
}

bool Scheduler::is_running() const {
  const std::lock_guard lock(runtime_.structure_mutex());
  return is_running_;
}

void Scheduler::Supervise() {
  bool are_faults_due = false;
  while (supervises_.load(std::memory_order_acquire)) {
    const Time soon = are_faults_due ? runtime_.clock().Now() + kSoon : Time::max();
    if (watchdog_ || are_faults_due) {
      faults_.event().WaitUntil(watchdog_ ? std::min(next_watch_, soon) : soon);
    } else {
      faults_.event().Wait();
    }
    are_faults_due = !faults_.Dispatch();
    Maintain();
    RunWatchdog();
  }
}

// Nobody is above the supervising thread to catch what it throws. What memory is too short for is tried for a
// while, with the lock free in between.
void Scheduler::Maintain() noexcept {
  std::exception_ptr failure;
  const bool is_done = Retry([&] {
    try {
      const std::lock_guard lock(runtime_.structure_mutex());
      if (is_running_) BringUpToDate();
    } catch (...) {
      failure = std::current_exception();
      throw;
    }
  });
  if (is_done) return;
  ReportException("the schedules could not be brought up to date: ", failure, faults_, runtime_);
}

void Scheduler::EndSupervision() {
  supervises_.store(false, std::memory_order_release);
  faults_.SetActsBeside(false);
  if (!supervisor_.joinable()) return;
  faults_.event().Notify();
  supervisor_.join();
  supervisor_ = std::thread();
}

void Scheduler::SetWatchdog(Watchdog watchdog) {
  RUNNEL_CHECK(!is_running(), "what looks out is chosen while nothing runs");
  watchdog_ = std::move(watchdog);
  next_watch_ = {};
}

void Scheduler::RunWatchdog() noexcept {
  if (!watchdog_) return;
  const Time now = runtime_.clock().Now();
  if (now < next_watch_) return;
  try {
    next_watch_ = watchdog_(now);
  } catch (...) {
    ReportException("the watchdog failed: ", std::current_exception(), faults_, runtime_);
    next_watch_ = now + kSoon;
  }
}

void Scheduler::AddStuckRule(StuckRule rule) {
  cycle_watchdog_.Add(std::move(rule));
  const std::lock_guard lock(runtime_.structure_mutex());
  UpdateInstruments();
}

void Scheduler::SetStuckListener(std::function<void()> listener) {
  const auto dispatch = [this] {
    if (!faults_.Dispatch()) faults_.event().Notify();  // who supervises tries again
  };
  if (!listener) return cycle_watchdog_.SetListener(dispatch);  // who stops may have no memory, and this takes none
  cycle_watchdog_.SetListener([dispatch, listener = std::move(listener)] { dispatch(), listener(); });
}

Result<void> Scheduler::SetStuckLimit(const std::string& of, Duration after) {
  if (after < Duration::zero()) {
    return Error{.message = "a time that a module may take is positive", .path = of};
  }
  cycle_watchdog_.SetLimit(of, after);
  const std::lock_guard lock(runtime_.structure_mutex());
  UpdateInstruments();
  return {};
}

}  // namespace runnel
