#include "plugins/scheduling/scheduler.h"

#include <algorithm>
#include <mutex>
#include <utility>

#include "core/base/clock.h"
#include "core/lockfree/thread_epoch.h"
#include "core/log/logger.h"
#include "core/port/port.h"

namespace runnel {

namespace {

constexpr Duration kLookAtClock = std::chrono::milliseconds(1);

bool IsSimulated(const SchedulerOptions& options) { return options.clock == SchedulerOptions::ClockKind::kSimulated; }

}  // namespace

Scheduler::Scheduler(Runtime& runtime, SchedulerOptions options)
    : runtime_(runtime),
      options_(std::move(options)),
      clock_before_(runtime.clock()),
      cycle_watchdog_(faults_, IsSimulated(options_) ? simulation_.clock() : clock_before_),
      pace_(IsSimulated(options_), options_.speed, options_.is_paused, machine_,
            IsSimulated(options_) && options_.follows_outside_clock),
      compiler_(options_.default_thread, options_.tracer, options_.watch) {
  if (IsSimulated(options_)) {
    runtime_.set_clock(simulation_.clock());
    SetStuckListener({});
  }
  runtime_.AddListener(*this);
}

Scheduler::~Scheduler() {
  Stop();
  RealThreads stuck;
  {
    const std::lock_guard lock(runtime_.structure_mutex());
    stuck.swap(ending_);
  }
  stuck.clear();
  {
    const std::lock_guard lock(runtime_.structure_mutex());
    runtime_.RemoveListener(*this);
    compiler_.NeedAll();  // not one change for each element
    compiler_.Release(runtime_.root());
    for (const auto& runner : runners_) runner->Install({});
  }
  if (IsSimulated(options_)) runtime_.set_clock(clock_before_);
  // Publishers may still look at what they have found before; they must not outlive it.
  WaitForReaders();
}

void Scheduler::OnReady(FrameworkElement& element) {
  compiler_.Add(element);
  NoteChainChange();
  Changed();
}

void Scheduler::OnDeleted(FrameworkElement& element) {
  compiler_.Release(element);
  NoteChainChange();
  Changed();
}

void Scheduler::OnConnected(FrameworkElement& from, FrameworkElement& to) {
  compiler_.Connect(static_cast<Port&>(from), static_cast<Port&>(to));
  NoteChainChange();
  Changed();
}

void Scheduler::OnDisconnected(FrameworkElement& from, FrameworkElement& to) {
  compiler_.Disconnect(static_cast<Port&>(from), static_cast<Port&>(to));
  NoteChainChange();
  Changed();
}

// On the simulated clock the thread that steps looks for it.
void Scheduler::OnOptionsChanged(ThreadContainer& thread) {
  has_changes_.store(true, std::memory_order_relaxed);
  for (const auto& each : threads_) {
    if (each->runner() != thread.runner()) continue;
    each->FollowActivation();
    if (auto warning = each->Prioritize()) {
      faults_.Note({.path = warning->path,
                    .message = warning->message,
                    .time = runtime_.clock().Now(),
                    .is_mended = true,
                    .kind = Fault::Kind::kNote});
    }
  }
  compiler_.FollowActivation(*thread.runner());
  Changed();
}

void Scheduler::OnAssigned(FrameworkElement& element) {
  compiler_.Reassign(element);
  Changed();
}

// Where cycles are running, the new schedule comes at once, or when all is done that belongs together:
// what is deleted must not be in a schedule that another thread is about to run.
void Scheduler::Changed() {
  if (is_up_to_date()) return;
  // relaxed: who finds it set takes the lock before looking at what has changed.
  has_changes_.store(true, std::memory_order_relaxed);
  if (!runtime_.is_in_change_scope()) OnChangesEnd();
}

// What fails here for lack of memory is tried once more; then the supervising thread tries it, and reports.
// Until then cycles go on as before, but for what has been released.
void Scheduler::OnChangesEnd() {
  if (!is_live()) return;
  for (int attempt = 0; attempt < 2; ++attempt) {
    try {
      return BringUpToDate();
    } catch (...) {
    }
  }
  faults_.event().Notify();
}

// If it fails, all of it is still to be done.
void Scheduler::BringUpToDate() {
  try {
    if (compiler_.needs_all()) {
      compiler_.CompileAll(runtime_.root());
      if (compiler_.has_unassigned_tasks()) {
        CreateThread(runtime_, "main", options_.default_options);
        compiler_.CompileAll(runtime_.root());
      }
      runners_ = compiler_.runners();
      has_other_runners_ = true;
      UpdateInstruments();
      NoteChainChange();
    }
    if (compiler_.has_changes()) {
      compiler_.Install();
      has_changes_.store(true, std::memory_order_relaxed);  // as in Changed()
    }
    if (profile_began_) BeginOrEndProfile();  // who used it may have gone
    if (std::exchange(have_chains_changed_, false)) FollowChains();
    if (is_running_ && has_other_runners_) StartThreads(machine_.Now());
  } catch (...) {
    compiler_.NeedAll();
    throw;
  }
}

// What is changed after the look is for the next step.
void Scheduler::FollowChanges() {
  if (!has_changes_.load(std::memory_order_relaxed)) return;
  const std::lock_guard lock(runtime_.structure_mutex());
  has_stepped_ = true;
  BringUpToDate();
  if (has_other_runners_) {
    simulation_.SetRunners(runners_);
    cycle_watchdog_.Follow(runners_);
    has_other_runners_ = false;
  }
  cycle_watchdog_.Begin();
  simulation_.FollowOptions();
  has_changes_.store(false, std::memory_order_relaxed);
}

std::optional<Time> Scheduler::NextDue() {
  RUNNEL_CHECK(IsSimulated(options_), "stepping is for the simulated clock");
  FollowChanges();
  return simulation_.NextDue();
}

// What is due next is asked anew each time, as the structure may change while the pace lets nothing
// run.
Scheduler::StepResult Scheduler::Advance(std::optional<Time> end, Duration timeout) {
  PrepareLogging();  // this thread runs cycles from here on
  std::optional<Time> latest;
  while (!stop_requested()) {
    const bool has_time = FollowOutsideClock();
    const auto due = NextDue();
    const bool is_cycle = due && (!end || *due < *end);
    if (!is_cycle && !end) return StepResult::kEnd;
    if (has_time && pace_.MayGoOnTo(is_cycle ? *due : *end)) {
      if (stop_requested()) break;
      if (!is_cycle) {
        simulation_.clock().Set(*end);
        return StepResult::kEnd;
      }
      simulation_.Step();
      pace_.CountCycle();
      RunWatchdog();
      backpressure_.WaitForRoom();
      return StepResult::kCycle;
    }
    if (!latest) latest = SaturatingSum(machine_.Now(), timeout);
    if (pace_.follows_outside()) ShowOutsideTime();
    if (machine_.Now() >= *latest) return StepResult::kTimeout;
    if (pace_.follows_outside()) {
      pace_.Wait(options_.clock_port.empty() ? *latest : machine_.Now() + kLookAtClock);
    } else {
      pace_.Wait(*latest);
    }
  }
  return StepResult::kStopped;
}

bool Scheduler::Step() {
  StepResult result = StepResult::kTimeout;
  while (result == StepResult::kTimeout) result = Advance({}, Pace::kLongestSleep);
  return result == StepResult::kCycle;
}

bool Scheduler::RunUntil(Time end) {
  StepResult result = StepResult::kTimeout;
  while (result == StepResult::kTimeout || result == StepResult::kCycle) result = Advance(end, Pace::kLongestSleep);
  return result == StepResult::kEnd;
}

std::vector<Fault> Scheduler::TakeFaults() {
  std::vector<Fault> taken;
  TakeFaults(taken);
  return taken;
}

void Scheduler::TakeFaults(std::vector<Fault>& to) {
  // Two at once would apply the rules in parallel, and out of order.
  if (!supervises_.load(std::memory_order_acquire)) faults_.Dispatch();
  faults_.Take(to);
}

Result<CycleHold> Scheduler::HoldCycles(const std::vector<std::string>& paths, Duration timeout,
                                        const std::vector<std::string>& at_rest) {
  RUNNEL_CHECK(!runtime_.structure_mutex().HeldByThisThread(),
               "threads cannot be kept between cycles under the structure lock, which a cycle might be waiting for");
  Runners runners = RunnersOf(paths);
  const auto stuck = [this](const auto& runner) { return cycle_watchdog_.IsStuck(*runner); };
  for (const auto& runner : RunnersOf(at_rest)) {
    if (!stuck(runner)) continue;
    return Error{.message = "one of its modules does not return from its cycle", .path = runner->path()};
  }
  std::erase_if(runners, stuck);
  return CycleHold::Take(std::move(runners), timeout, options_.tracer);
}

Scheduler::Runners Scheduler::RunnersOf(const std::vector<std::string>& paths) {
  const std::lock_guard lock(runtime_.structure_mutex());
  BringUpToDate();
  Runners running;
  for (const std::string& path : paths) {
    if (const auto found = runtime_.root().Find(path)) compiler_.AddRunnersOf(**found, running);
  }
  return running;
}

std::optional<Scheduler::Progress> Scheduler::ProgressOf(const std::string& path) {
  const std::lock_guard lock(runtime_.structure_mutex());
  const Runners runners = RunnersOf({path});
  if (runners.empty()) return {};
  const auto element = runtime_.root().Find(path);
  return Progress{runners.front()->cycles_begun(), element && compiler_.IsStopped(**element)};
}

bool Scheduler::HasTasks() {
  const std::lock_guard lock(runtime_.structure_mutex());
  BringUpToDate();
  return compiler_.HasTasks();
}

std::vector<Error> Scheduler::Warnings() {
  const std::lock_guard lock(runtime_.structure_mutex());
  BringUpToDate();
  std::vector<Error> warnings = compiler_.Warnings();
  if (auto forgotten = NeverReady()) warnings.push_back(std::move(*forgotten));
  std::ranges::copy(realtime_warnings_, std::back_inserter(warnings));
  return warnings;
}

}  // namespace runnel
