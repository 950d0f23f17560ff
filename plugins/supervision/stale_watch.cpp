#include "plugins/supervision/stale_watch.h"

#include <algorithm>

#include "core/base/clock.h"
#include "core/port/port.h"

namespace runnel::internal {

namespace {

constexpr Duration kShortestWait = std::chrono::milliseconds(1);

}  // namespace

StaleWatch::Turn StaleWatch::Look(Runtime& runtime, Time now) {
  if (!heard_) heard_ = now;  // what has never come is missing from now on
  Hear(runtime);
  const Turn turn = Judge(now);
  next_look_ = is_stale_
                   ? now + std::max(std::min(rule_->after, rule_->fresh_after) / 4, kShortestWait)
                   : SaturatingSum(SaturatingSum(*heard_, rule_->after), Duration(1));
  return turn;
}

// Counted from the measurement: what is old when it comes is stale. A time to come counts as that of the
// publication, else a publisher with a wrong clock would be fresh for ever. An output that is gone is silent.
void StaleWatch::Hear(Runtime& runtime) {
  for (const std::string& path : outputs_) {
    const auto found = runtime.root().Find(path);
    const auto* const port = found ? dynamic_cast<const Port*>(*found) : nullptr;
    if (port == nullptr) continue;
    port->VisitLatest([&](const void*, ValueTimes times) {
      heard_ = std::max(*heard_, std::min(times.timestamp, times.publication_time));
    });
  }
}

StaleWatch::Turn StaleWatch::Judge(Time now) {
  const bool is_silent = now - *heard_ > rule_->after;
  if (!is_stale_) {
    is_stale_ = is_silent;
    return is_silent ? Turn::kStale : Turn::kNone;
  }
  if (is_silent) {
    well_since_.reset();
    return Turn::kNone;
  }
  if (!well_since_) well_since_ = *heard_;
  if (*heard_ - *well_since_ < rule_->fresh_after) return Turn::kNone;
  well_since_.reset();
  is_stale_ = false;
  return Turn::kFresh;
}

}  // namespace runnel::internal
