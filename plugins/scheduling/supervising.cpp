// What the Scheduler does between cycles: attends to faults, brings up to date what could not be at
// once, and looks out.

#include <mutex>
#include <utility>

#include "plugins/scheduling/scheduler.h"

namespace runnel {

void Scheduler::Supervise() {
  while (supervises_.load(std::memory_order_acquire)) {
    if (lookout_) {
      desk_.event().WaitUntil(next_look_);
    } else {
      desk_.event().Wait();
    }
    LookAfter();
    LookOut();
  }
}

// Nobody is above the supervising thread to catch what it throws.
void Scheduler::LookAfter() noexcept {
  const auto report = [this](const std::string& why) {
    desk_.Report({runtime_.root().path(), "the schedules could not be brought up to date: " + why,
                  runtime_.clock().Now()});
  };
  try {
    desk_.Attend();
    const std::lock_guard lock(runtime_.structure_mutex());
    if (is_running_) BringUpToDate();
  } catch (const std::exception& exception) {
    report(exception.what());
  } catch (...) {
    report("unknown exception");
  }
}

void Scheduler::EndSupervision() {
  if (!supervisor_.joinable()) return;
  supervises_.store(false, std::memory_order_release);
  desk_.event().Notify();
  supervisor_.join();
  supervisor_ = std::thread();
}

void Scheduler::SetLookout(Lookout lookout) {
  RUNNEL_CHECK(!is_running(), "what looks out is chosen while nothing runs");
  lookout_ = std::move(lookout);
  next_look_ = {};
}

void Scheduler::LookOut() noexcept {
  if (!lookout_) return;
  const Time now = runtime_.clock().Now();
  if (now < next_look_) return;
  try {
    next_look_ = lookout_(now);
  } catch (const std::exception& exception) {
    desk_.Report(
        {runtime_.root().path(), std::string("looking out failed: ") + exception.what(), now});
    next_look_ = now + std::chrono::seconds(1);
  }
}

}  // namespace runnel
