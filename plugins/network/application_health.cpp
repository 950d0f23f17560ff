#include "plugins/network/application_health.h"

#include <chrono>
#include <mutex>

#include <fmt/format.h>

#include "core/element/framework_element.h"
#include "core/element/runtime.h"
#include "core/types/duration_text.h"
#include "plugins/control/application_state.h"
#include "plugins/scheduling/scheduler.h"
#include "plugins/scheduling/thread_container.h"
#include "plugins/supervision/supervisor.h"

namespace runnel {

namespace {

// So long a thread counts as late.
constexpr auto kLate = std::chrono::seconds(5);
// Whoever sends values asks as often as it sends them.
constexpr auto kLook = std::chrono::milliseconds(90);

}  // namespace

std::vector<RosDiagnosticStatus> ApplicationHealth::operator()() {
  const Time now = SteadyClock().Now();
  if (all_.empty() || now - looked_ >= kLook) {
    ReadLog();
    Look();
    looked_ = now;
  }
  return all_;
}

void ApplicationHealth::Add(RosHealth level, const std::string& of, const std::string& message) {
  const std::string& name = application_->name();
  all_.push_back({.level = level, .name = name + ": " + of, .message = message, .hardware_id = name, .values = {}});
}

void ApplicationHealth::Look() {
  all_.clear();
  const std::lock_guard lock(application_->runtime().structure_mutex());
  auto failed = FailedModules(*application_, *scheduler_, nullptr);
  for (auto& [path, why] : failed) {
    const auto cause = causes_.find(path);
    why = cause != causes_.end() ? cause->second : "has failed";
  }
  for (const StuckModule& each : scheduler_->StuckModules()) {
    failed.emplace(each.path, "does not return, since " + DurationText(each.since) + " at least");
  }
  std::map<std::string, std::string> silent;  // of which several rules may be
  for (const Supervisor::Silence& each : supervisor_->Silent()) {
    const std::string lasts = DurationText(std::chrono::floor<std::chrono::milliseconds>(each.lasts));
    silent.emplace(each.path, "nothing new for " + lasts + ", at most " + DurationText(each.allowed) + " is allowed");
  }
  if (failed.empty() && silent.empty()) {
    Add(RosHealth::kOk, "modules", "no fault");
  } else {
    Add(failed.empty() ? RosHealth::kWarning : RosHealth::kError, "modules",
        std::to_string(failed.size()) + " failed, " + std::to_string(silent.size()) + " inputs without news");
  }
  for (const auto& [path, why] : failed) Add(RosHealth::kError, path, why);
  for (const auto& [path, why] : silent) Add(RosHealth::kStale, path, why);
  AddThreads();
}

void ApplicationHealth::ReadLog() {
  const auto news = log_->ReadEntries(next_in_log_, ApplicationLog::kMostEntries);
  next_in_log_ = news.next;
  for (const ApplicationLog::Entry& entry : news.entries) {
    if (!entry.module.empty() && !entry.cause.empty()) causes_[entry.module] = entry.cause;
  }
}

void ApplicationHealth::AddThreads() {
  Runtime& runtime = application_->runtime();
  const Time now = runtime.clock().Now();
  runtime.root().VisitAll<const ThreadContainer>([&](const ThreadContainer& thread) {
    const CycleStatistics cycles = thread.statistics();
    Overruns& known = overruns_[thread.path()];
    if (cycles.overruns > known.count) {
      known.since = now;
      known.is_any = true;
    }
    known.count = cycles.overruns;  // fewer, if the thread is another one of that name
    const bool is_late = known.is_any && now - known.since < kLate;
    all_.push_back({.level = is_late ? RosHealth::kWarning : RosHealth::kOk,
                    .name = application_->name() + ": thread " + thread.name(),
                    .message = is_late ? "cycles end too late" : "in time",
                    .hardware_id = application_->name(),
                    .values = {{"cycles", std::to_string(cycles.cycles)},
                               {"overruns", std::to_string(cycles.overruns)},
                               {"period", fmt::format("{:.6f} s", ToSeconds(cycles.period_mean))},
                               {"longest execution", fmt::format("{:.6f} s", ToSeconds(cycles.execution_max))}}});
  });
}

}  // namespace runnel
