// Simulated time that passes as another clock does.

#include <cmath>
#include <mutex>

#include "core/paths/path_search.h"
#include "core/types/type_of.h"
#include "plugins/scheduling/scheduler.h"

namespace runnel {

namespace {

std::optional<Time> TimeAt(const Port& port) {
  std::optional<Time> time;
  port.VisitLatest([&](const void* value, ValueTimes) {
    if (&port.type() == &TypeOf<double>()) {
      const double seconds = *static_cast<const double*>(value);
      if (std::isfinite(seconds)) time = Time(FromSeconds(seconds));
    } else if (&port.type() == &TypeOf<std::int64_t>()) {
      time = Time(Duration(*static_cast<const std::int64_t*>(value)));
    }
  });
  return time;
}

}  // namespace

// By its path, for its module may be replaced.
void Scheduler::LookAtClockPort() {
  std::optional<Time> time;
  {
    const std::lock_guard lock(runtime_.structure_mutex());
    const auto found = PathSearch(runtime_).FindPort(clock_port_, PathKind::kOutput);
    if (found) time = TimeAt(**found);
  }
  if (time) (void)pace_.SetTime(*time);
}

void Scheduler::TellJump() {
  const auto jump = pace_.TakeJump();
  if (!jump) return;
  faults_.Note({.path = options_.clock_port.empty() ? "/clock" : options_.clock_port,
                .message = "the clock that is followed jumps from " + std::to_string(ToSeconds(jump->first)) +
                           " s to " + std::to_string(ToSeconds(jump->second)) + " s; what runs here goes on from there",
                .time = simulation_.clock().Now(),
                .is_mended = true,
                .kind = Fault::Kind::kNote});
}

// Whether there is a time to go by.
bool Scheduler::FollowOutsideClock() {
  if (!pace_.follows_outside()) return true;
  if (!options_.clock_port.empty()) LookAtClockPort();
  TellJump();
  if (outside_clock_has_begun_) return true;
  const auto first = pace_.outside_time();
  if (!first) return false;
  FollowChanges();
  simulation_.BeginAt(*first);
  outside_clock_has_begun_ = true;
  return true;
}

// All that is due has run.
void Scheduler::ShowOutsideTime() {
  const auto time = pace_.outside_time();
  if (!time || !outside_clock_has_begun_ || pace_.is_paused()) return;
  if (simulation_.clock().Now() < *time) simulation_.clock().Set(*time);
  RunWatchdog();
}

}  // namespace runnel
