// Cycles, until something ends them, and what is told of them.

#include <algorithm>
#include <chrono>
#include <new>
#include <utility>

#include "core/base/erase_where.h"
#include "core/base/error.h"
#include "core/base/retry.h"
#include "core/element/file_notes.h"
#include "plugins/application/internal/application_parts.h"

namespace runnel {

namespace {

using ClockKind = SchedulerOptions::ClockKind;
using MachineClock = std::chrono::steady_clock;

constexpr std::size_t kMostEvents = 10'000;
// How often somebody looks at an application that runs.
constexpr Duration kLookAround = std::chrono::milliseconds(20);
// How long real threads go on after the end of the run has been requested, by a fault or by the user, so that
// what else is there can bring the robot to rest.
constexpr Duration kGraceTime = std::chrono::milliseconds(500);

Error RunsAlready() { return {.message = "the application runs already", .hint = "end its run first"}; }

Error NothingToRun() {
  return {.message = "there is nothing to run",
          .hint = "the application has no modules, or none that any thread would ever run"};
}

// One text for all of them.
std::string WarningsText(std::vector<Error>& warnings, Runtime& runtime) {
  const std::lock_guard lock(runtime.structure_mutex());
  Diagnostics diagnostics;
  for (Error& warning : warnings) {
    const auto element = runtime.root().Find(warning.path);
    if (element && warning.position.file.empty()) warning.position = FindSourcePlace(**element);
    diagnostics.AddWarning(warning);
  }
  return diagnostics.ToString();
}

}  // namespace

void Application::Parts::Hear(const LogMessage& message) {
  {
    const std::lock_guard lock(events_mutex);
    if (!log) return early_messages.push_back(message);
  }
  log->Add(message);
  Add({ApplicationEvent::Kind::kMessage, MessageText(message, start)});
}

void Application::Parts::Add(ApplicationEvent event) {
  const std::lock_guard lock(events_mutex);
  if (events.size() == kMostEvents) events.pop_front();
  events.push_back(std::move(event));
}

Result<FrameworkElement*> Application::Parts::FindAgain() { return runtime().root().Find(path()); }

void Application::Parts::Join() {
  if (!thread.joinable()) return;
  {
    const std::lock_guard lock(running_mutex);
    ends = true;
  }
  has_changed.notify_all();
  thread.join();
}

bool Application::Parts::EndsWithin(Duration longest) {
  std::unique_lock lock(running_mutex);
  return longest > Duration{} ? has_changed.wait_for(lock, longest, [this] { return ends; }) : ends;
}

Duration Application::Parts::RunThreads(std::optional<Duration> limit, const LookAround& look) {
  const struct Threads {
    ~Threads() { of.Stop(); }
    Scheduler& of;
  } ended_whatever_is_thrown{*scheduler};
  const Clock& clock = runtime().clock();
  const Time begun = clock.Now();
  auto latest = MachineClock::time_point::max();
  Duration so_far{};
  bool is_over = false;
  while (!is_over && !EndsWithin(limit ? std::min(*limit - so_far, kLookAround) : kLookAround)) {
    so_far = clock.Now() - begun;
    is_over = look(so_far) || (limit && so_far >= *limit);
    if (!scheduler->stop_requested()) continue;
    limit.reset();
    latest = std::min(latest, MachineClock::now() + kGraceTime);
    is_over = MachineClock::now() >= latest;
  }
  return clock.Now() - begun;
}

Result<Duration> Application::Parts::RunCycles(std::optional<Duration> limit, bool waits_for_tasks,
                                               const LookAround& look) {
  const Clock& clock = runtime().clock();
  const Time begun = clock.Now();
  const auto end = limit ? std::optional(begun + *limit) : std::nullopt;
  for (;;) {
    if (!waits_for_tasks && !scheduler->NextDue()) {
      const std::lock_guard lock(runtime().structure_mutex());
      if (FindAgain()) return NothingToRun();
      return clock.Now() - begun;  // somebody has deleted it
    }
    const auto result = scheduler->Advance(end, kLookAround);
    const Duration so_far = clock.Now() - begun;
    const bool is_idle = result == Scheduler::StepResult::kEnd;
    const bool is_at_the_end = limit && (is_idle || so_far >= *limit);
    const bool is_over = look(so_far) || is_at_the_end || scheduler->stop_requested();
    if (is_over || EndsWithin(is_idle ? kLookAround : Duration{})) return so_far;
  }
}

void Application::Attend() {
  using Kind = ApplicationEvent::Kind;
  Parts& parts = *parts_;
  const std::lock_guard one_at_a_time(parts.attending);
  FrameworkElement& root = parts.runtime().root();
  FlushLog();
  // Not before the start, which only shows what the system refuses to real-time threads.
  if (!parts.has_warned) {
    std::vector<Error> warnings = parts.scheduler->Warnings();
    std::string text = WarningsText(warnings, parts.runtime());
    for (const Error& warning : warnings) {
      parts.log->Add(ApplicationLog::Kind::kWarning, warning.ToString());
    }
    if (!text.empty()) parts.Add({Kind::kWarning, std::move(text)});
    parts.has_warned = true;
  }
  parts.scheduler->TakeFaults(parts.untold_faults);
  for (const Fault& fault : parts.untold_faults) parts.report->Hear(fault);
  EraseWhere(parts.untold_faults, [&](const Fault& fault) {
    std::string text = FaultText(fault, parts.start, root);
    const bool is_fault = fault.kind == Fault::Kind::kThrown || fault.kind == Fault::Kind::kStuck;
    parts.log->Add(is_fault ? ApplicationLog::Kind::kFault : ApplicationLog::Kind::kWarning, text, fault.path,
                   fault.is_mended ? "" : fault.message);
    parts.Add({Kind::kFault, std::move(text), fault});
    return true;
  });
  for (const auto& extension : parts.extensions()) {
    parts.untold_failures.reserve(parts.untold_failures.size() + 1);
    if (auto failure = extension->TakeFailure()) parts.untold_failures.push_back(*std::move(failure));
  }
  EraseWhere(parts.untold_failures, [&](const Error& failure) {
    Diagnostics diagnostics;
    diagnostics.Add(failure);
    parts.log->Add(ApplicationLog::Kind::kWarning, failure.ToString());
    parts.Add({Kind::kFailure, diagnostics.ToString()});
    return true;
  });
  parts.supervisor->TakeNotices(parts.untold_notices);
  EraseWhere(parts.untold_notices, [&](const Notice& notice) {
    std::string text = NoticeText(notice, parts.start, root);
    const bool is_good = notice.is_recovery && !notice.is_failure;
    parts.log->Add(is_good ? ApplicationLog::Kind::kInfo : ApplicationLog::Kind::kFault, text);
    parts.Add({Kind::kNotice, std::move(text)});
    return true;
  });
}

// For those who read the log later, at the end of a run.
void Application::LogProfile() {
  const auto measured = parts_->scheduler->profiled_for();
  const Profile profile = parts_->scheduler->ReadProfile();
  const std::string table = ProfileText(profile, measured.value_or(Duration{}));
  for (std::string_view text = table; !text.empty(); text.remove_prefix(std::min(text.size(), text.find('\n') + 1))) {
    parts_->log->Add(ApplicationLog::Kind::kInfo, std::string(text.substr(0, text.find('\n'))));
  }
}

bool Application::IsOver() {
  for (const auto& extension : parts_->extensions()) {
    if (const auto is_over = extension->IsOver()) return *is_over;
  }
  return parts_->report->IsOver();
}

Result<void> Application::MakeReady() {
  const std::lock_guard lock(parts_->runtime().structure_mutex());
  const auto found = parts_->FindAgain();
  if (!found) return found.error();
  bool is_ready = true;
  (*found)->Visit(
      [&](const FrameworkElement& each) { is_ready = is_ready && each.life_cycle() != LifeCycle::kConstructed; });
  return is_ready ? Result<void>() : MakeApplicationReady(**found);
}

void Application::NoteStart() {
  parts_->scheduler->pace().Begin();
  // The thread that steps looks around itself, unless one of its modules is stuck.
  parts_->scheduler->SetStuckListener([this] {
    parts_->supervisor->KeepSafe();
    Attend();
  });
  if (std::exchange(parts_->has_started, true)) return;
  for (const auto& extension : parts_->extensions()) extension->OnStart();
}

Result<void> Application::Start() {
  Parts& parts = *parts_;
  if (parts.is_running.load()) return RunsAlready();
  Stop();  // the end of a run that ended by itself
  if (auto ready = MakeReady(); !ready) return ready;
  const bool is_real = parts.scheduler->options().clock == ClockKind::kReal;
  NoteStart();
  if (is_real) {
    if (auto started = parts.scheduler->Start(); !started) return started;
  }
  parts.ends = false;
  parts.is_running = true;
  const auto run = [this, is_real] {
    auto next_look = MachineClock::now();
    const auto look = [&](Duration) {
      if (MachineClock::now() < next_look) return false;
      next_look = MachineClock::now() + kLookAround;
      try {
        Attend();
      } catch (const std::bad_alloc&) {  // the next look tells what this one could not
      }
      return false;
    };
    try {
      is_real ? (void)parts_->RunThreads({}, look) : (void)parts_->RunCycles({}, true, look);
      Attend();
      LogProfile();
    } catch (...) {
      Retry([&] {
        parts_->Add({ApplicationEvent::Kind::kFailure, "error: the run has ended: " + DescribeException() + "\n"});
      });
    }
    parts_->is_running = false;
  };
  try {
    parts.thread = std::thread(run);
  } catch (const std::exception&) {
    Stop();
    return Error{.message = "the application cannot be run: " + DescribeException()};
  }
  return {};
}

void Application::Stop() {
  parts_->Join();
  if (!parts_->scheduler) return;  // it has not been loaded
  parts_->scheduler->SetStuckListener({});
  parts_->scheduler->Stop();
  parts_->is_running = false;
}

bool Application::is_running() const noexcept { return parts_->is_running.load(); }

Result<Duration> Application::Run(const RunOptions& options) {
  Parts& parts = *parts_;
  if (parts.is_running.load()) return RunsAlready();
  Stop();
  if (auto ready = MakeReady(); !ready) return ready.error();
  std::optional<Duration> limit = options.limit;
  for (const auto& extension : parts.extensions()) {
    const auto longest = extension->limit();
    if (longest) limit = std::min(limit.value_or(Duration::max()), *longest);
  }
  NoteStart();
  const auto look = [&](Duration so_far) {
    try {
      Attend();
      const bool is_over = options.is_over && options.is_over(so_far);
      return IsOver() || is_over;
    } catch (const std::bad_alloc&) {  // the next look tells what this one could not
      return false;
    }
  };
  if (!parts.scheduler->HasTasks()) return NothingToRun();
  const bool is_real = parts.scheduler->options().clock == ClockKind::kReal;
  if (is_real) {
    if (auto started = parts.scheduler->Start(); !started) return started.error();
  }
  parts.ends = false;
  auto ran = is_real ? parts.RunThreads(limit, look) : parts.RunCycles(limit, false, look);
  Attend();
  LogProfile();
  return ran;
}

Result<void> Application::BeginCycles() {
  Parts& parts = *parts_;
  if (parts.is_running.load()) return RunsAlready();
  if (parts.scheduler->options().clock == ClockKind::kReal) {
    return Error{.message = "real time passes by itself",
                 .hint = "call Start() and Stop(), or load it with a simulated clock"};
  }
  if (parts.scheduler->pace().is_paused()) {
    return Error{.message = "the application is paused", .hint = "call Resume() first"};
  }
  Stop();
  if (auto ready = MakeReady(); !ready) return ready;
  NoteStart();
  return {};
}

Result<void> Application::RunUntil(Time end) {
  if (auto begun = BeginCycles(); !begun) return begun;
  const bool has_come = parts_->scheduler->RunUntil(end);
  Attend();
  if (has_come) return {};
  return Error{.message = "the end of the run has been requested"};
}

Result<void> Application::RunCycles(std::uint64_t count) {
  if (auto begun = BeginCycles(); !begun) return begun;
  Result<void> went;
  for (; count > 0 && went; --count) {
    if (parts_->scheduler->Step()) continue;
    went = parts_->scheduler->stop_requested() ? Error{.message = "the end of the run has been requested"}
                                               : NothingToRun();
  }
  Attend();
  return went;
}

Result<void> Application::Pause() { return parts_->scheduler->pace().Pause(); }
Result<void> Application::Resume() { return parts_->scheduler->pace().Resume(); }
Result<void> Application::SetTime(Time time) { return parts_->scheduler->pace().SetTime(time); }
Result<void> Application::Pause(std::string_view path) { return parts_->supervisor->SetPaused(path, true); }
Result<void> Application::Resume(std::string_view path) { return parts_->supervisor->SetPaused(path, false); }
Result<void> Application::Step(std::uint64_t cycles) { return parts_->scheduler->pace().StepCycles(cycles); }
Result<void> Application::SetSpeed(double speed) { return parts_->scheduler->pace().SetSpeed(speed); }
void Application::RequestStop() noexcept { parts_->scheduler->RequestStop(); }

std::vector<ApplicationEvent> Application::TakeEvents() {
  const std::lock_guard lock(parts_->events_mutex);
  std::vector<ApplicationEvent> taken(std::make_move_iterator(parts_->events.begin()),
                                      std::make_move_iterator(parts_->events.end()));
  parts_->events.clear();
  return taken;
}

void Application::NoteEnd(const std::string& verdict) {
  parts_->scheduler->pace().End();
  for (const auto& extension : parts_->extensions()) extension->OnEnd(verdict);
}

}  // namespace runnel
