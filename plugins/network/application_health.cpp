#include "plugins/network/application_health.h"

#include <algorithm>
#include <chrono>
#include <mutex>
#include <utility>

#include <fmt/format.h>

#include "plugins/application/application.h"
#include "plugins/command_service/application_log.h"
#include "plugins/scheduling/thread_container.h"

namespace runnel {

namespace {

// So long a thread counts as late.
constexpr auto kLate = std::chrono::seconds(5);

// What supervision says of an input in the log, behind its path.
constexpr std::string_view kSilent = ": nothing new for ", kFresh = ": values come again";

// The path that ends there; a place in a file may stand in front.
std::string PathBefore(const std::string& text, std::size_t end) {
  const std::size_t blank = text.rfind(' ', end);
  const std::size_t begin = blank == std::string::npos ? 0 : blank + 1;
  return text.substr(begin, end - begin);
}

}  // namespace

void ApplicationHealth::ReadLog() {
  const auto news = application_->log().ReadEntries(next_in_log_, ApplicationLog::kMostEntries);
  next_in_log_ = news.next;
  for (const ApplicationLog::Entry& entry : news.entries) {
    if (!entry.module.empty() && entry.cause.empty()) stopped_.erase(entry.module);
    if (!entry.module.empty() && !entry.cause.empty()) stopped_[entry.module] = entry.cause;
    if (const std::size_t place = entry.text.find(kSilent); place != std::string::npos) {
      silent_[PathBefore(entry.text, place)] = entry.text.substr(place + 2);
    } else if (const std::size_t end = entry.text.find(kFresh); end != std::string::npos) {
      silent_.erase(PathBefore(entry.text, end));
    }
  }
}

void ApplicationHealth::AddThreads(std::vector<RosDiagnosticStatus>& all) {
  Runtime& runtime = application_->runtime();
  const Time now = runtime.clock().Now();
  const std::lock_guard lock(runtime.structure_mutex());
  runtime.root().Visit([&](FrameworkElement& element) {
    const auto* const thread = dynamic_cast<const ThreadContainer*>(&element);
    if (thread == nullptr) return;
    const CycleStatistics cycles = thread->statistics();
    Overruns& known = overruns_[thread->path()];
    if (cycles.overruns > known.count) known = {cycles.overruns, now};
    const bool is_late = known.count > 0 && now - known.since < kLate;
    all.push_back({.level = is_late ? RosHealth::kWarning : RosHealth::kOk,
                   .name = application_->name() + ": thread " + thread->name(),
                   .message = is_late ? "cycles end too late" : "in time",
                   .hardware_id = application_->name(),
                   .values = {{"cycles", std::to_string(cycles.cycles)},
                              {"overruns", std::to_string(cycles.overruns)},
                              {"period", fmt::format("{:.6f} s", ToSeconds(cycles.period_mean))},
                              {"longest execution", fmt::format("{:.6f} s", ToSeconds(cycles.execution_max))}}});
  });
}

std::vector<RosDiagnosticStatus> ApplicationHealth::operator()() {
  ReadLog();
  const std::string& name = application_->name();
  std::vector<RosDiagnosticStatus> all;
  const auto add = [&](RosHealth level, const std::string& of, const std::string& message) {
    all.push_back({.level = level, .name = name + ": " + of, .message = message, .hardware_id = name, .values = {}});
  };
  if (stopped_.empty() && silent_.empty()) {
    add(RosHealth::kOk, "modules", "no fault");
  } else {
    add(stopped_.empty() ? RosHealth::kWarning : RosHealth::kError, "modules",
        std::to_string(stopped_.size()) + " stopped by a fault, " + std::to_string(silent_.size()) + " inputs without news");
  }
  for (const auto& [path, why] : stopped_) add(RosHealth::kError, path, why);
  for (const auto& [path, why] : silent_) add(RosHealth::kStale, path, why);
  AddThreads(all);
  return all;
}

}  // namespace runnel
