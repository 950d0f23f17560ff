#include "tests/plugins/genom_execution/sketch.h"

#include <algorithm>

namespace runnel::genom_execution {

Event Sketch::Of(const std::string& event) {
  auto& known = events_[event];
  if (known == nullptr) known = std::make_unique<std::string>(event);
  return known->c_str();
}

std::uint16_t Sketch::Codel(const std::string& name) {
  const auto found = std::ranges::find(codel_names_, name);
  if (found != codel_names_.end()) return static_cast<std::uint16_t>(found - codel_names_.begin());
  codel_names_.push_back(name);
  first_yields_.push_back(nullptr);
  return static_cast<std::uint16_t>(codel_names_.size() - 1);
}

std::uint16_t Sketch::Service(const std::string& name) const {
  const auto found = std::ranges::find(services_of_, name, &ServiceOf::name);
  return static_cast<std::uint16_t>(found - services_of_.begin());
}

MachineTable Sketch::Machine(const std::vector<StateOf>& states) {
  MachineTable machine;
  auto& tables = states_.emplace_back();
  const auto find = [&](const std::string& name) {
    return static_cast<std::uint16_t>(std::ranges::find(states, name, &StateOf::state) - states.begin());
  };
  for (const StateOf& each : states) {
    auto& transitions = transitions_.emplace_back();
    for (const std::string& event : each.yields) {
      const bool pauses = event.starts_with("pause::");
      const std::string to = pauses ? event.substr(7) : event;
      transitions.push_back({Of(event), to == "ether" ? kEther : find(to), pauses});
    }
    const std::uint16_t codel = Codel(each.codel);
    first_yields_[codel] = transitions.empty() ? nullptr : transitions.front().event;
    tables.push_back({kept_names_.emplace_back(each.state).c_str(), codel, transitions});
    if (each.state == "start") machine.start = find("start");
    if (each.state == "stop") machine.stop = find("stop");
  }
  machine.states = tables;
  return machine;
}

std::span<const std::uint16_t> Sketch::Services(const std::vector<std::string>& names) {
  auto& list = numbers_.emplace_back();
  for (const auto& name : names) list.push_back(Service(name));
  return list;
}
std::span<const std::uint16_t> Sketch::Codels(const std::vector<std::string>& names) {
  auto& list = numbers_.emplace_back();
  for (const auto& name : names) list.push_back(Codel(name));
  return list;
}
std::span<const Event> Sketch::Events(const std::vector<std::string>& names) {
  auto& list = lists_.emplace_back();
  for (const auto& name : names) list.push_back(Of(name));
  return list;
}

Engine& Sketch::Start(EngineOptions options) {
  for (const TaskOf& each : tasks_of_) {
    tasks_.push_back({.name = each.name.c_str(),
                      .period = each.period,
                      .delay = each.delay,
                      .machine = Machine(each.states),
                      .throws = Events(each.throws)});
  }
  for (const ServiceOf& each : services_of_) {
    const auto task = std::ranges::find(tasks_of_, each.task, &TaskOf::name) - tasks_of_.begin();
    services_.push_back({.name = each.name.c_str(),
                         .kind = each.kind,
                         .number = Service(each.name),
                         .task = static_cast<std::uint16_t>(task),
                         .validates = Codels(each.validates),
                         .codels = Codels(each.codels),
                         .machine = Machine(each.states),
                         .throws = Events(each.throws),
                         .interrupts = Services(each.interrupts),
                         .before = Services(each.before),
                         .after = Services(each.after),
                         .make = [] { return static_cast<void*>(new int(0)); },
                         .destroy = [](void* data) { delete static_cast<int*>(data); },
                         .assign = each.assign});
    for (const auto& name : each.throws)
      exceptions_.push_back({Of(name), kept_names_.emplace_back(name).c_str(), [](const void* detail) {
                               return "{limit: " + std::to_string(*static_cast<const int*>(detail)) + "}";
                             }});
  }
  static constexpr auto kCalls = Calls(std::make_index_sequence<32>());
  for (std::size_t i = 0; i < codel_names_.size(); ++i) {
    const bool is_async = std::ranges::find(async_, codel_names_[i]) != async_.end();
    codels_.push_back({codel_names_[i].c_str(), kCalls.at(i), is_async});
  }
  for (const auto& [a, b] : conflicts_of_) {
    const auto unit = [&](const std::string& name) {
      const auto found = std::ranges::find(codel_names_, name);
      if (found != codel_names_.end()) return static_cast<std::uint16_t>(found - codel_names_.begin());
      return static_cast<std::uint16_t>(codel_names_.size() + Service(name));
    };
    conflicts_.emplace_back(unit(a), unit(b));
  }
  table_.codels = codels_;
  table_.tasks = tasks_;
  table_.services = services_;
  table_.conflicts = conflicts_;
  table_.exceptions = exceptions_;
  table_.largest_detail = sizeof(int);
  options.glue = this;
  engine_ = std::make_unique<Engine>(table_, options);
  return *engine_;
}

Event Sketch::Run(std::size_t number, const Invocation& invocation) {
  const std::string& name = codel_names_[number];
  const auto behaviour = behaviours_.find(name);
  if (behaviour != behaviours_.end()) {
    if (!codels_[number].is_async && !is_quiet) Note(name);
    return behaviour->second(invocation);
  }
  Note(name);
  return first_yields_[number];
}

Request& Sketch::Send(const std::string& service) {
  Request& request = requests_.emplace_back(table_, service == "abort_activity" ? Engine::AbortService()
                                                    : service == "kill"         ? Engine::KillService()
                                                                                : services_[Service(service)]);
  if (service != "abort_activity") (void)engine_->Send(request);
  return request;
}

void Sketch::RunAt(milliseconds time) {
  for (bool goes_on = true; goes_on;) {
    const std::uint64_t changes = engine_->changes();
    (void)engine_->RunControl();
    bool again = false;
    for (std::size_t i = 0; i < tasks_.size(); ++i) again |= engine_->RunTask(i, Time(time)) == Pass::kAgain;
    goes_on = again || engine_->changes() != changes;
  }
}

std::string Sketch::Trace() { return std::exchange(trace_, {}); }

}  // namespace runnel::genom_execution
