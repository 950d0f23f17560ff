// Modules that a Scheduler leaves out of cycles for a while.

#include <mutex>
#include <utility>

#include "core/lockfree/thread_epoch.h"
#include "core/paths/path_search.h"
#include "plugins/scheduling/internal/schedule_plan.h"
#include "plugins/scheduling/scheduler.h"

namespace runnel {

namespace {

constexpr Duration kLongestCycle = std::chrono::seconds(5);

}  // namespace

Result<void> Scheduler::SetPaused(std::string_view path, bool is_paused) {
  std::string whose;
  {
    const std::lock_guard lock(runtime_.structure_mutex());
    const auto found = PathSearch(runtime_).Find(path);
    if (!found) return found.error();
    whose = (*found)->path();
    BringUpToDate();
    compiler_.SetPaused(**found, is_paused);
    runtime_.ForEachListener([](ElementListener&) {});  // so that viewers look again
  }
  if (!is_paused) return {};
  // Between two cycles, once: what was under way is over.
  auto held = HoldCycles({whose}, kLongestCycle, {});
  return held ? Result<void>() : held.error();
}

// Looked for when the structure has changed.
std::vector<std::string> Scheduler::PausedPaths() const {
  const std::lock_guard lock(runtime_.structure_mutex());
  if (std::exchange(paused_at_, runtime_.revision()) == runtime_.revision()) return paused_;
  paused_.clear();
  runtime_.root().Visit([this](const FrameworkElement& each) {
    if (internal::PauseMark::IsAt(each)) paused_.push_back(each.path());
  });
  return paused_;
}

bool Scheduler::IsPaused(FrameworkElement& element, std::string_view but_for) const {
  const std::lock_guard lock(runtime_.structure_mutex());
  const FrameworkElement* left_out = nullptr;
  if (!but_for.empty()) {
    if (const auto found = PathSearch(runtime_).Find(but_for)) left_out = *found;
  }
  return compiler_.IsPaused(element, left_out);
}

std::string Scheduler::WhyAtRest(const FrameworkElement& element, Duration patience) const {
  const internal::PlannedElement* const around = compiler_.FindAround(element);
  if (around == nullptr) return "";
  const std::string& path = around->element->path();
  if (around->state->has_ended()) return path + " has failed";
  if (around->state->is_paused()) return path + " is paused";
  // On a simulated clock one thread runs all.
  const bool is_one_thread = options_.clock == SchedulerOptions::ClockKind::kSimulated;
  for (const auto& runner : runners_) {
    const bool counts = is_one_thread || runner.get() == around->thread->runner.get();
    if (!counts || !cycle_watchdog_.IsStuck(*runner, patience)) continue;
    return "a module of " + runner->path() + ", which runs " + path + ", does not return";
  }
  return "";
}

std::string Scheduler::WhyUnreached(const Port& port, std::span<Port* const> sinks) const {
  std::string why;
  for (const Port* sink : sinks) {
    if (why.empty() && port.is_driving()) why = WhyAtRest(*sink, kUnreachedAfter);
  }
  return why;
}

void Scheduler::WakeWithoutData(const FrameworkElement& element) const {
  const internal::PlannedElement* const around = compiler_.FindAround(element);
  if (around == nullptr || !around->thread->runner->waits_for_data()) return;
  Guarded([&] { around->state->Wake(); });  // as publishers are
}

void Scheduler::MovePaths(const std::function<void(std::string& path)>& move) {
  faults_.MovePaths(move);
  cycle_watchdog_.MovePaths(move);
  move(clock_port_);
  for (const auto& chain : chains_) {
    move(chain->request.from);
    move(chain->request.to);
  }
}

Result<void> Scheduler::CheckPaused(std::string_view path) const {
  const std::lock_guard lock(runtime_.structure_mutex());
  const auto found = PathSearch(runtime_).Find(path);
  if (!found) return found.error();
  if (internal::PauseMark::IsAt(**found)) return {};
  std::string all;
  for (const std::string& each : PausedPaths()) all += (all.empty() ? "paused is " : ", ") + each;
  return Error{.message = "is not paused", .path = (*found)->path(), .hint = all};
}

}  // namespace runnel
