#include "plugins/control/application_state.h"

#include <algorithm>
#include <chrono>

#include <fmt/format.h>

#include "core/element/runtime.h"
#include "core/paths/late_connections.h"
#include "core/plugin/module_type_name.h"
#include "core/port/driving_ports.h"
#include "core/port/port.h"
#include "plugins/scheduling/scheduler.h"
#include "plugins/scheduling/thread_container.h"
#include "plugins/values/watched_port.h"

namespace runnel {

std::string StopText(Runtime& runtime) {
  const RobotStop::State stop = runtime.robot_stop().state();
  if (!stop.in_force) return {};
  const char* const but = FindWhatDrives(runtime) == "" ? ", but NO PORT DRIVES" : "";
  return fmt::format("STOP in force for {:.0f} s, by {}{}", ToSeconds(runtime.clock().Now() - stop.since), stop.by,
                     but);
}

std::string StateText(const ServedApplication& application) {
  std::string text = "running";
  if (application.pace != nullptr && application.pace->is_paused()) text = "paused";
  if (application.pace != nullptr && application.pace->has_ended()) text = "ended, held";
  if (const std::string stop = StopText(application.runtime); !stop.empty()) text += ", " + stop;
  const auto lock = TryStructureLock(application.runtime, std::chrono::milliseconds(10));
  if (!lock) return text + ", BUSY changing its structure: nothing else can be told of it";
  if (application.scheduler == nullptr) return text;
  FrameworkElement& root = application.runtime.root();
  const Time now = application.runtime.clock().Now();
  std::size_t paused = 0;
  std::size_t by_hand = 0;
  std::size_t blocked = 0;
  std::size_t unfed = 0;
  std::size_t silent = 0;
  std::size_t overrunning = 0;
  root.Visit([&](FrameworkElement& each) {
    if (IsModule(each) && application.scheduler->IsPaused(each)) ++paused;
    const auto* const thread = dynamic_cast<const ThreadContainer*>(&each);
    if (thread != nullptr && thread->statistics().is_late) ++overrunning;
    const auto* const port = dynamic_cast<const Port*>(&each);
    if (port == nullptr) return;
    if (port->is_set_by_hand() || port->is_set_by_hand(Port::Setter::kRule)) ++by_hand;
    if (port->is_blocked()) ++blocked;
    if (LacksSource(*port)) ++unfed;
    if (SilentFor(*port, application.log.start(), now)) ++silent;
  });
  const auto add = [&](std::size_t count, const char* one, const char* many) {
    if (count > 0) text += ", " + std::to_string(count) + (count == 1 ? one : many);
  };
  add(FailedModules(root, *application.scheduler, nullptr).size(), " module FAILED", " modules FAILED");
  for (const StuckModule& each : application.scheduler->StuckModules()) text += ", STUCK: " + each.path;
  add(FindStopReach(application.runtime, application.scheduler).value().unreached.size(),
      " driving port CANNOT BE REACHED", " driving ports CANNOT BE REACHED");
  add(paused, " module PAUSED", " modules PAUSED");
  add(blocked, " port BLOCKED", " ports BLOCKED");
  add(by_hand, " port set by hand", " ports set by hand");
  add(overrunning, " thread OVERRUNS", " threads OVERRUN");
  add(silent, " output SILENT", " outputs SILENT");
  add(unfed, " required input NOT CONNECTED", " required inputs NOT CONNECTED");
  return text;
}

std::optional<Duration> SilentFor(const Port& port, Time began, Time now) {
  constexpr std::uint64_t kSteadyValues = 20;
  constexpr Duration kSteady = std::chrono::seconds(3);
  constexpr Duration kPatience = std::chrono::milliseconds(1500);
  constexpr int kPeriods = 10;
  const std::uint64_t count = port.publications();
  // What nobody is connected to may well be published only while somebody looks on.
  if (port.outgoing().empty() || port.direction() != Port::Direction::kOutput || count < kSteadyValues) return {};
  const auto newest = Publications::Of(port).newest;
  if (!newest || *newest - began < kSteady) return {};
  const Duration period = (*newest - began) / static_cast<Duration::rep>(count);
  const Duration silent = now - *newest;
  if (silent <= std::max(kPatience, kPeriods * period)) return {};
  return silent;
}

bool LacksSource(const Port& port) {
  return port.is_required() && port.Sources().empty() && !port.is_set_by_hand() && !LateConnections::Awaits(port);
}

std::map<std::string, std::string> FailedModules(FrameworkElement& start, Scheduler& scheduler,
                                                 const ApplicationLog* log) {
  std::map<std::string, std::string> failed;
  try {
    start.Visit([&](FrameworkElement& each) {
      if (!IsModule(each)) return;
      const auto progress = scheduler.ProgressOf(each.path());
      if (progress && progress->has_failed) failed.emplace(each.path(), "");
    });
  } catch (const ElementError&) {  // the threads are such that nothing can be run; the scheduler tells
    return {};
  }
  if (failed.empty() || log == nullptr) return failed;
  for (const auto& entry : log->ReadEntries(0, ApplicationLog::kMostEntries).entries) {
    const auto found = failed.find(entry.module);
    if (found != failed.end() && !entry.cause.empty()) found->second = entry.cause;
  }
  return failed;
}

}  // namespace runnel
