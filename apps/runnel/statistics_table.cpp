#include <algorithm>
#include <mutex>

#include <fmt/format.h>

#include "apps/runnel/output.h"
#include "core/element/runtime.h"
#include "plugins/scheduling/thread_container.h"

namespace runnel::program {

namespace {

double Milliseconds(Duration duration) { return ToSeconds(duration) * 1e3; }

std::string Line(const ThreadContainer& thread, int width) {
  const CycleStatistics all = thread.statistics();
  return fmt::format(
      "{:<{}} {:9} {:8}  {:8.3f} {:8.3f} {:8.3f}  {:8.3f} {:8.3f}  {:8.3f} {:8.3f}\n",
      thread.path(), width, all.cycles, all.overruns, Milliseconds(all.period_min),
      Milliseconds(all.period_mean), Milliseconds(all.period_max), Milliseconds(all.jitter_mean),
      Milliseconds(all.jitter_max), Milliseconds(all.execution_mean),
      Milliseconds(all.execution_max));
}

std::string Heading(int width) {
  return fmt::format(
      "{:<{}} {:>9} {:>8}  {:>26}  {:>17}  {:>17}\n"
      "{:<{}} {:>9} {:>8}  {:>8} {:>8} {:>8}  {:>8} {:>8}  {:>8} {:>8}\n",
      "thread", width, "cycles", "overruns", "period / ms", "jitter / ms", "execution / ms", "",
      width, "", "", "min", "mean", "max", "mean", "max", "mean", "max");
}

}  // namespace

std::string StatisticsTable(FrameworkElement& root) {
  const std::lock_guard lock(root.runtime().structure_mutex());
  std::string lines;
  int width = 0;
  const auto for_each = [&](auto&& use) {
    root.Visit([&](FrameworkElement& element) {
      if (const auto* thread = dynamic_cast<const ThreadContainer*>(&element)) use(*thread);
    });
  };
  for_each([&](const ThreadContainer& thread) {
    width = std::max(width, static_cast<int>(thread.path().size()));
  });
  for_each([&](const ThreadContainer& thread) { lines += Line(thread, width); });
  return Heading(width) + lines;
}

}  // namespace runnel::program
