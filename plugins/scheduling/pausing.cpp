// Modules that a Scheduler leaves out of cycles for a while.

#include <algorithm>
#include <mutex>

#include "core/paths/path_search.h"
#include "plugins/scheduling/scheduler.h"

namespace runnel {

namespace {

constexpr Duration kLongestCycle = std::chrono::seconds(5);

}  // namespace

Result<void> Scheduler::SetPaused(std::string_view path, bool is_paused) {
  std::string whose;
  {
    const std::lock_guard lock(runtime_.structure_mutex());
    const auto found = PathSearch(runtime_).Find(path);
    if (!found) return found.error();
    whose = (*found)->path();
    BringUpToDate();
    compiler_.SetPaused(whose, is_paused);
  }
  if (!is_paused) return {};
  // Between two cycles, once: what was under way is over.
  auto held = HoldCycles({whose}, kLongestCycle, {});
  return held ? Result<void>() : held.error();
}

std::vector<std::string> Scheduler::PausedPaths() const {
  const std::lock_guard lock(runtime_.structure_mutex());
  return compiler_.paused();
}

bool Scheduler::IsPaused(FrameworkElement& element, std::string_view but_for) const {
  const std::lock_guard lock(runtime_.structure_mutex());
  std::string left_out;
  if (!but_for.empty()) {
    if (const auto found = PathSearch(runtime_).Find(but_for)) left_out = (*found)->path();
  }
  return compiler_.IsPaused(element, left_out);
}

Result<void> Scheduler::CheckPaused(std::string_view path) const {
  const std::lock_guard lock(runtime_.structure_mutex());
  const auto found = PathSearch(runtime_).Find(path);
  if (!found) return found.error();
  const auto& paused = compiler_.paused();
  if (std::ranges::count(paused, (*found)->path()) > 0) return {};
  std::string all;
  for (const std::string& each : paused) all += (all.empty() ? "paused is " : ", ") + each;
  return Error{.message = "is not paused", .path = (*found)->path(), .hint = all};
}

}  // namespace runnel
