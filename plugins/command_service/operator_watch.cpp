#include "plugins/command_service/operator_watch.h"

#include <utility>

#include "core/types/duration_text.h"

namespace runnel {

void OperatorWatch::Begin(Duration timeout) {
  timeout_.store(timeout.count(), std::memory_order_relaxed);
  Hear("");
  if (watched_clock_ != nullptr) return;
  lookout_.Ask();
  changes_ = stop_.signal()->Listen([this] { lookout_.Ask(); });
}

void OperatorWatch::Hear(std::string_view name) {
  if (timeout() == Duration::zero()) return;
  const std::lock_guard lock(mutex_);
  heard_ = Now();
  last_ = name;
}

std::optional<Time> OperatorWatch::Look() {
  std::string why = "<operators>: none of them has been heard for " + DurationText(timeout()) + ", ";
  {
    const std::lock_guard lock(mutex_);
    const Time due = heard_ + timeout();
    if (Now() < due) return due;
    why += last_.empty() ? "nor before" : "the last one was " + last_;
  }
  stop_.Press(std::move(why));
  return {};
}

}  // namespace runnel
