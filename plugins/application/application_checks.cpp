#include "plugins/application/application_checks.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <utility>

#include "core/element/file_notes.h"
#include "core/element/runtime.h"
#include "core/module/executable.h"
#include "core/plugin/module_type_name.h"
#include "core/port/driving_ports.h"
#include "core/port/input_base.h"
#include "core/port/port.h"
#include "core/port/port_stop.h"
#include "core/port/probe_port.h"
#include "plugins/application_tags/run_description.h"
#include "plugins/scheduling/thread_container.h"

namespace runnel {

namespace {

// Whoever finds the safe value there has to run to do so, and waits for all that its thread runs before.
void WarnOfSharedThreads(const ApplicationCheckUse& use) {
  std::set<const FrameworkElement*> driving;
  std::map<std::uint64_t, const ThreadContainer*> threads;
  std::map<std::uint64_t, std::size_t> modules;  // by thread
  FrameworkElement& root = use.application.runtime().root();
  root.Visit([&](FrameworkElement& element) {
    if (const auto* const thread = dynamic_cast<const ThreadContainer*>(&element)) threads[thread->id()] = thread;
    const auto* const port = dynamic_cast<const Port*>(&element);
    if (port == nullptr || !port->is_driving()) return;
    for (const Port* sink : port->Sinks()) {
      if (const FrameworkElement* const module = FindOwner(*sink)) driving.insert(module);
    }
  });
  // What is assigned to none runs where the first thread does.
  const auto thread_of = [&](const FrameworkElement& module) {
    const std::uint64_t assigned = AssignedThread(module);
    return threads.contains(assigned) || threads.empty() ? assigned : threads.begin()->first;
  };
  root.Visit([&](FrameworkElement& element) {
    if (element.FindAnnotation<Executable>() != nullptr) ++modules[thread_of(element)];
  });
  for (const FrameworkElement* module : driving) {
    const std::uint64_t id = thread_of(*module);
    const std::size_t count = std::max<std::size_t>(modules[id], 1) - 1;
    const std::string name = threads.contains(id) ? threads[id]->name() : "main";
    if (count == 0) continue;
    use.diagnostics.AddWarning({.message = "something moves by it, and the thread '" + name + "' runs " +
                                           std::to_string(count) + (count == 1 ? " other module" : " other modules") +
                                           ": while one of them does not return, a STOP does not reach it",
                                .path = module->path(),
                                .position = FindSourcePlace(*module),
                                .hint = "give it a thread of its own: <thread name=\"drive\" period=\"…\"/>, and "
                                        "thread=\"drive\" at the module"});
  }
}

// What it feeds moves by whatever else is connected to that later.
void WarnOfMarksBefore(const Port& marked, const ApplicationCheckUse& use) {
  if (!marked.is_proxy() && marked.direction() == Port::Direction::kInput) return;
  for (const Port* sink : marked.Sinks()) {
    if (sink->is_driving() || dynamic_cast<const ProbePort*>(sink) != nullptr) continue;
    use.diagnostics.AddWarning(
        {.message = "is marked as driving, and not what moves by it: a STOP does not hold what another source "
                    "sends to " +
                    sink->path(),
         .path = marked.path(),
         .position = FindSourcePlace(marked),
         .hint = "mark that: <driving port=\"" + sink->path() + "\"/>"});
  }
}

// What a ramp would have to begin with there, nobody knows: what lies between may scale it.
void WarnOfRampsBefore(const Port& driving, const ApplicationCheckUse& use) {
  const PortStop& stop = *driving.stop();
  if (stop.command() != DrivingKind::kVelocity || IsZero(stop.safe_value())) return;
  for (const Port* source : driving.Sources()) {
    VisitSiblings(*source, Port::Direction::kInput, [&](const Port& each) {
      const auto* const input = dynamic_cast<const InputBase*>(&each);
      if (input == nullptr || input->ageing() != Ageing::kPassedOn || each.incoming().empty() || each.is_driving())
        return;
      use.diagnostics.AddWarning(
          {.message = "is passed on to " + driving.path() +
                      ", whose safe value is not zero: what is ramped before it does not begin anew after a STOP",
           .path = each.path(),
           .position = FindSourcePlace(driving),
           .hint = "mark it, with the value at which that stands still: <driving port=\"" + each.path() + "\"/>"});
    });
  }
}

// Warns where something moves, by the types of ports, and no port is marked as driving; and, on a real clock, of modules
// that drive and share a thread with others.
void CheckMotion(const ApplicationCheckUse& use) {
  const Port* moves = nullptr;
  bool is_marked = false;
  use.application.VisitAll<const Port>([&](const Port& port) {
    is_marked = is_marked || port.is_driving();
    if (port.is_driving()) WarnOfMarksBefore(port, use);
    if (port.is_driving()) WarnOfRampsBefore(port, use);
    // What others read over the network is held by itself.
    const bool is_read = !port.is_proxy() && port.direction() == Port::Direction::kInput;
    if (moves == nullptr && is_read && IsVelocity(port.type(), port.unit())) moves = &port;
  });
  // On a simulated clock one thread runs everything, whatever the file says.
  const bool is_real = SchedulerOptionsOf(use.application).clock == SchedulerOptions::ClockKind::kReal;
  if (is_marked && is_real) WarnOfSharedThreads(use);
  if (moves == nullptr || is_marked) return;
  use.diagnostics.AddWarning(
      {.message = "takes velocities, and no port of the application is marked as driving: a STOP stops nothing",
       .path = moves->path(),
       .position = FindSourcePlace(*moves),
       .hint = "mark the port that moves something: <driving port=\"…\"/>"});
}

}  // namespace

void ApplicationChecks::Add(Check check) { checks_.push_back({plugin_, std::move(check)}); }

std::function<void()> ApplicationChecks::SetAside(std::string_view plugin) {
  // All memory comes before the first is taken out; putting them back needs none, as there is room where they were.
  const auto aside = std::make_shared<std::vector<PluginCheck>>();
  aside->reserve(checks_.size());
  std::function<void()> back = [this, aside] {
    std::ranges::move(*aside, std::back_inserter(checks_));
    aside->clear();
  };
  const auto is_others = [&](const PluginCheck& each) { return each.plugin != plugin; };
  const auto of_it = std::stable_partition(checks_.begin(), checks_.end(), is_others);
  std::move(of_it, checks_.end(), std::back_inserter(*aside));
  checks_.erase(of_it, checks_.end());
  return back;
}

void ApplicationChecks::Run(const ApplicationCheckUse& use) const {
  const std::lock_guard lock(use.application.runtime().structure_mutex());
  CheckMotion(use);
  for (const PluginCheck& each : checks_) {
    try {
      each.check(use);
    } catch (...) {
      use.diagnostics.Add(
          {.message = "a check of the plugin '" + each.plugin + "' has failed: " + DescribeException()});
    }
  }
}

}  // namespace runnel
