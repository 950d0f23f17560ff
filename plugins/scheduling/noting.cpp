// What a Scheduler has noted of cycles besides, and who looks at it.

#include <mutex>
#include <utility>

#include "plugins/scheduling/scheduler.h"

namespace runnel {

void Scheduler::UpdateInstruments() {
  std::uint8_t instruments = options_.tracer != nullptr ? Instruments::kTrace : 0;
  if (options_.notes_running_tasks || cycle_watchdog_.has_rules()) {
    instruments |= Instruments::kRunning;
  }
  if (profile_began_) instruments |= Instruments::kProfile;
  if (!chains_.empty()) instruments |= Instruments::kLatency;
  for (const auto& runner : runners_) runner->set_instruments(instruments);
}

void Scheduler::AddStuckRule(StuckRule rule) {
  cycle_watchdog_.Add(std::move(rule));
  const std::lock_guard lock(runtime_.structure_mutex());
  UpdateInstruments();
}

void Scheduler::SetStuckListener(std::function<void()> listener) {
  cycle_watchdog_.SetListener([this, listener = std::move(listener)] {
    faults_.Dispatch();
    if (listener) listener();
  });
}

Result<void> Scheduler::SetStuckLimit(const std::string& of, Duration after) {
  if (after < Duration::zero()) {
    return Error{.message = "a time that a module may take is positive", .path = of};
  }
  cycle_watchdog_.SetLimit(of, after);
  const std::lock_guard lock(runtime_.structure_mutex());
  UpdateInstruments();
  return {};
}

}  // namespace runnel
