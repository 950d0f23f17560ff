#include "plugins/command_service/operator_watch.h"

#include <utility>

#include "core/types/duration_text.h"

namespace runnel {

OperatorWatch::OperatorWatch(RobotStop& stop, const Clock* watched_clock)
    : stop_(stop),
      clock_(watched_clock != nullptr ? *watched_clock : machine_clock_),
      watches_(watched_clock == nullptr),
      lookout_([this] { return Look(); }) {}

void OperatorWatch::Begin(Duration timeout) {
  {
    const std::lock_guard lock(mutex_);
    heard_ = clock_.Now();
  }
  timeout_.store(timeout.count(), std::memory_order_relaxed);
  if (!watches_) return;
  lookout_.Ask();
  changes_ = stop_.signal()->Listen([this] { lookout_.Ask(); });
}

void OperatorWatch::Hear(std::string_view name) {
  if (timeout() == Duration::zero()) return;
  const std::lock_guard lock(mutex_);
  heard_ = clock_.Now();
  last_ = name;
}

std::optional<Time> OperatorWatch::Look() {
  std::string why = "<operators>: none of them has been heard for " + DurationText(timeout()) + ", ";
  {
    const std::lock_guard lock(mutex_);
    const Time due = heard_ + timeout();
    if (clock_.Now() < due) return due;
    why += last_.empty() ? "nor before" : "the last one was " + last_;
  }
  stop_.Press(std::move(why));
  return {};
}

}  // namespace runnel
