#include "plugins/genom_standalone/task_threads.h"

#include <algorithm>
#include <cstring>
#include <iostream>

#include <pthread.h>
#include <sched.h>

namespace runnel::genom_standalone {

using genom_execution::Pass;

namespace {

// Priority 0 is the highest of a component, 255 the lowest. Who may not have it goes on without, and says so.
void BecomeRealTime(const genom_execution::TaskTable& task) {
  sched_param parameters{};
  parameters.sched_priority = std::clamp(90 - task.priority / 3, 1, 90);
  const int code = pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters);
  if (code == 0) return;
  std::cerr << std::string("warning: task '") + task.name + "' gets no real-time priority (SCHED_FIFO " +
                   std::to_string(parameters.sched_priority) + "): " + std::strerror(code) +
                   "; permit it by ulimit -r, or as root\n";
}

}  // namespace

void TaskThreads::Begin(genom_execution::Engine& engine) {
  threads_.emplace_back([this, &engine] { RunControl(engine); });
  for (std::size_t i = 0; i < engine.tasks().size(); ++i) {
    threads_.emplace_back([this, &engine, i] { RunTask(engine, i); });
  }
}

void TaskThreads::WakeAll() noexcept {
  for (WakeEvent& each : wakes_) each.Notify();
}

void TaskThreads::RunControl(genom_execution::Engine& engine) {
  while (!engine.is_ended()) {
    const std::uint64_t changes = engine.changes();
    (void)engine.RunControl();
    if (!engine.is_ended() && engine.changes() == changes) wakes_[0].Wait();
  }
  WakeAll();
}

void TaskThreads::RunTask(genom_execution::Engine& engine, std::size_t task) {
  auto& own = engine.tasks()[task];
  if (own.table().is_real_time) BecomeRealTime(own.table());
  while (!engine.is_ended()) {
    const std::uint64_t changes = engine.changes();
    if (engine.RunTask(task, clock_.Now()) != Pass::kIdle || engine.is_ended()) continue;
    const Time tick = own.next_tick();
    if (tick != Time::max() && own.is_periodic()) {
      wakes_[task + 1].WaitUntil(tick);
    } else if (engine.changes() == changes) {
      wakes_[task + 1].Wait();
    }
  }
}

void TaskThreads::Join() {
  for (std::thread& each : threads_) each.join();
  threads_.clear();
}

}  // namespace runnel::genom_standalone
