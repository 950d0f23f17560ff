#pragma once

#include <array>
#include <chrono>
#include <deque>
#include <functional>
#include <initializer_list>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "plugins/genom_execution/engine.h"

namespace runnel::genom_execution {

using std::chrono::milliseconds;

/// A component for tests, put together of names. Each codel says in the trace that it ran, "service.codel", and returns
/// what the test has it return: by default the first event that its state yields.
class Sketch {
 public:
  struct StateOf {
    std::string state;
    std::string codel;
    std::vector<std::string> yields;
  };
  struct TaskOf {
    std::string name;
    Duration period{};
    Duration delay{};
    std::vector<StateOf> states = {};
    std::vector<std::string> throws = {};
  };
  struct ServiceOf {
    std::string name;
    ServiceKind kind = ServiceKind::kFunction;
    std::string task = {};
    std::vector<StateOf> states = {};
    std::vector<std::string> validates = {};
    std::vector<std::string> codels = {};
    std::vector<std::string> throws = {};
    std::vector<std::string> interrupts = {};
    std::vector<std::string> before = {};
    std::vector<std::string> after = {};
    void (*assign)(void* ids, void* data) = nullptr;
  };
  using Behaviour = std::function<Event(const Invocation&)>;

  void AddTask(TaskOf task) { tasks_of_.push_back(std::move(task)); }
  void AddService(ServiceOf service) { services_of_.push_back(std::move(service)); }
  /// Of codels, or of a codel and an attribute.
  void Exclude(std::string a, std::string b) { conflicts_of_.emplace_back(std::move(a), std::move(b)); }
  void MakeAsync(const std::string& codel) { async_.push_back(codel); }
  void Do(const std::string& codel, Behaviour behaviour) { behaviours_[codel] = std::move(behaviour); }
  bool is_quiet = false;  ///< codels with a behaviour leave no trace
  /// The event of a name, always the same.
  Event Of(const std::string& event);

  /// Whatever has been said above is made a component of.
  Engine& Start(EngineOptions options = {});
  [[nodiscard]] Engine& engine() { return *engine_; }
  Request& Send(const std::string& service);
  /// Runs the control task and all tasks at `time` until nothing goes on.
  void RunAt(milliseconds time);
  /// What has run since the last time: "init go.step go.step".
  std::string Trace();
  [[nodiscard]] std::string TextOf(const Request& request) const { return request.outcome().Text(table_); }
  void Note(const std::string& what) { trace_ += (trace_.empty() ? "" : " ") + what; }

 private:
  template <std::size_t number>
  static Event Call(const Invocation& invocation) {
    return static_cast<Sketch*>(invocation.context->data)->Run(number, invocation);
  }
  template <std::size_t... number>
  static constexpr auto Calls(std::index_sequence<number...>) {
    return std::array<Event (*)(const Invocation&), sizeof...(number)>{&Call<number>...};
  }
  Event Run(std::size_t number, const Invocation& invocation);
  std::uint16_t Codel(const std::string& name);
  std::uint16_t Service(const std::string& name) const;
  MachineTable Machine(const std::vector<StateOf>& states);
  std::span<const std::uint16_t> Services(const std::vector<std::string>& names);
  std::span<const std::uint16_t> Codels(const std::vector<std::string>& names);
  std::span<const Event> Events(const std::vector<std::string>& names);

  std::vector<TaskOf> tasks_of_;
  std::vector<ServiceOf> services_of_;
  std::vector<std::pair<std::string, std::string>> conflicts_of_;
  std::vector<std::string> async_;
  std::map<std::string, Behaviour> behaviours_;
  std::map<std::string, std::unique_ptr<std::string>> events_;
  std::vector<std::string> codel_names_;
  std::vector<Event> first_yields_;
  std::deque<std::string> kept_names_;
  std::deque<std::vector<Transition>> transitions_;
  std::deque<std::vector<StateTable>> states_;
  std::deque<std::vector<std::uint16_t>> numbers_;
  std::deque<std::vector<Event>> lists_;
  std::vector<CodelTable> codels_;
  std::vector<TaskTable> tasks_;
  std::vector<ServiceTable> services_;
  std::vector<Conflict> conflicts_;
  std::vector<ExceptionTable> exceptions_;
  ComponentTable table_{.name = "sketch"};
  std::string trace_;
  std::deque<Request> requests_;
  std::unique_ptr<Engine> engine_;  // last: uses all of it
};

}  // namespace runnel::genom_execution
