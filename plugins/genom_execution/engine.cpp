#include "plugins/genom_execution/engine.h"

#include <algorithm>

namespace runnel::genom_execution {

Engine::Engine(const ComponentTable& component, const EngineOptions& options)
    : component_(component),
      options_(options),
      conflicts_(component),
      is_excluding_(!options.is_single_threaded || std::ranges::any_of(component.codels, &CodelTable::is_async)),
      exclusion_(conflicts_, component.tasks.size() + 1, options.patience > Duration::zero()),
      control_(*this) {
  for (std::size_t i = 0; i < component.tasks.size(); ++i) tasks_.emplace_back(*this, i);
  if (component.tasks.empty()) phase_ = Phase::kRunning;
}

const ServiceTable& Engine::AbortService() {
  static const ServiceTable table{.name = "abort_activity", .kind = ServiceKind::kAbort};
  return table;
}
const ServiceTable& Engine::KillService() {
  static const ServiceTable table{.name = "kill", .kind = ServiceKind::kKill};
  return table;
}

bool Engine::Send(Request& request) noexcept {
  const bool is_sent = control_.Send(request);
  Wake();
  return is_sent;
}

bool Engine::HasBegun(const ExecutionTask& task) const noexcept {
  const auto number = static_cast<std::size_t>(&task.table() - component_.tasks.data());
  return number <= starting_.load(std::memory_order_acquire);
}

Pass Engine::RunControl() {
  Phase phase = this->phase();
  if (phase == Phase::kStarting && is_stopping()) {
    phase = Phase::kStopping;
  } else if (phase == Phase::kRunning) {
    const Pass pass = control_.Run();
    if (!is_stopping()) return pass;
    if (pass == Pass::kWaiting) return pass;
    phase = Phase::kStopping;
  }
  if (phase == Phase::kStarting) return Pass::kIdle;
  if (phase == Phase::kStopping) phase_.store(phase, std::memory_order_release);
  if (!control_.ShutDown()) return Pass::kIdle;
  if (phase != Phase::kEnded) {
    phase_.store(Phase::kEnded, std::memory_order_release);
    Wake();
  }
  return Pass::kIdle;
}

Pass Engine::RunTask(std::size_t number, Time now, bool is_forced) {
  const Phase phase = this->phase();
  ExecutionTask& task = tasks_[number];
  if (phase == Phase::kRunning) return task.Run(now, is_forced);
  if (phase == Phase::kEnded) return Pass::kIdle;
  const std::size_t starting = starting_.load(std::memory_order_acquire);
  if (number > starting) return Pass::kIdle;
  const Pass pass = task.Run(now, is_forced);
  if (phase == Phase::kStarting && number == starting && task.has_passed()) {
    if (failure() != nullptr) {
      Stop();
      return pass;
    }
    starting_.store(number + 1, std::memory_order_release);
    if (number + 1 == tasks_.size()) {
      Phase expected = Phase::kStarting;  // unless the control task is ending everything
      phase_.compare_exchange_strong(expected, Phase::kRunning, std::memory_order_release);
    }
    Wake();
  }
  return pass;
}

void Engine::Stop() noexcept {
  is_stop_asked_.store(true, std::memory_order_release);
  Wake();
}

const Outcome* Engine::failure() const noexcept { return failure_.load(std::memory_order_acquire); }

void Engine::NoteFailure(const Outcome& outcome) noexcept {
  const Outcome* none = nullptr;
  failure_.compare_exchange_strong(none, &outcome, std::memory_order_release, std::memory_order_relaxed);
}

}  // namespace runnel::genom_execution
