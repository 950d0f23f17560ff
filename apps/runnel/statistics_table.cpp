#include "apps/runnel/statistics_table.h"

#include <algorithm>
#include <cstdio>
#include <mutex>

#include "core/element/runtime.h"
#include "plugins/scheduling/thread_container.h"

namespace runnel::program {

namespace {

double Milliseconds(Duration duration) { return ToSeconds(duration) * 1e3; }

std::string Line(const ThreadContainer& thread, int width) {
  const CycleStatistics all = thread.statistics();
  char line[256];
  std::snprintf(line, sizeof line,
                "%-*s %9llu %8llu  %8.3f %8.3f %8.3f  %8.3f %8.3f  %8.3f %8.3f\n", width,
                thread.path().c_str(), static_cast<unsigned long long>(all.cycles),
                static_cast<unsigned long long>(all.overruns), Milliseconds(all.period_min),
                Milliseconds(all.period_mean), Milliseconds(all.period_max),
                Milliseconds(all.jitter_mean), Milliseconds(all.jitter_max),
                Milliseconds(all.execution_mean), Milliseconds(all.execution_max));
  return line;
}

std::string Heading(int width) {
  char text[512];
  std::snprintf(text, sizeof text,
                "%-*s %9s %8s  %26s  %17s  %17s\n%-*s %9s %8s  %8s %8s %8s  %8s "
                "%8s  %8s %8s\n",
                width, "thread", "cycles", "overruns", "period / ms", "jitter / ms",
                "execution / ms", width, "", "", "", "min", "mean", "max", "mean", "max", "mean",
                "max");
  return text;
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
