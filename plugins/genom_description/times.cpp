#include <cmath>
#include <numeric>

#include "plugins/genom_description/component_rules.h"

namespace runnel::genom {

namespace {

constexpr double kLongest = 1e9;  // s

// In microseconds, as the clock counts.
std::int64_t Microseconds(double seconds) {
  return static_cast<std::int64_t>(std::llround(std::fmin(seconds, kLongest) * 1e6));
}

void CheckDelay(const Task& task, Problems& problems) {
  const Property* delay = Find(task.properties, PropertyKind::kDelay);
  if (delay == nullptr) return;
  const Property* period = Find(task.properties, PropertyKind::kPeriod);
  if (period == nullptr) {
    problems.Add(delay->place, "task '" + task.name + "' has a delay and no period", "say its period, or leave the delay out");
  } else if (delay->number >= period->number) {
    problems.Add(delay->place, "the delay of task '" + task.name + "' is not less than its period",
                 problems.DeclaredAt(period->place));
  }
}

}  // namespace

void CheckTimes(Component& component, Problems& problems) {
  std::int64_t divisor = 1'000'000;
  const Property* rate = Find(component.properties, PropertyKind::kClockRate);
  for (const Task* task : component.tasks) {
    CheckDelay(*task, problems);
    for (const PropertyKind kind : {PropertyKind::kPeriod, PropertyKind::kDelay}) {
      const Property* time = Find(task->properties, kind);
      if (time == nullptr) continue;
      const std::int64_t value = Microseconds(time->number);
      divisor = std::gcd(divisor, value);
      const std::int64_t tick = rate == nullptr ? 0 : Microseconds(rate->number);
      if (tick == 0 || value % tick == 0) continue;
      problems.Add(time->place, "the " + std::string(NameOf(kind)) + " of task '" + task->name +
                                    "' is no multiple of the clock rate of '" + component.name + "'",
                   "leave the clock rate out, or: " + problems.DeclaredAt(rate->place));
    }
  }
  component.clock_rate = rate != nullptr && rate->number > 0 ? rate->number : static_cast<double>(divisor) * 1e-6;
}

}  // namespace runnel::genom
