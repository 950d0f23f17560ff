// What a ScheduleCompiler knows of tasks beside their order: their times, chains, and whether they are paused.

#include <algorithm>
#include <utility>

#include "core/lockfree/thread_epoch.h"
#include "plugins/scheduling/internal/pause_mark.h"
#include "plugins/scheduling/schedule_compiler.h"

namespace runnel {

std::vector<ProfiledTask> ScheduleCompiler::Tasks() const {
  std::vector<ProfiledTask> tasks;
  for (const auto& [id, thread] : threads_) {
    std::size_t order = 0;
    for (const internal::OrderedTask* each : thread->order.tasks()) {
      const auto& task = static_cast<const internal::PlannedTask&>(*each);
      tasks.push_back({task.element->element->path(), thread->runner->path(), task.phase, ++order,
                       task.element->state->meter(task.phase).times()});
    }
  }
  return tasks;
}

void ScheduleCompiler::ResetMeters() {
  for (auto& [id, planned] : elements_) {
    if (!planned.state) continue;
    for (const Phase phase : {Phase::kSense, Phase::kUpdate, Phase::kControl}) {
      planned.state->meter(phase).Reset();
    }
  }
}

void ScheduleCompiler::SetChains(std::map<std::uint64_t, std::unique_ptr<ChainSteps>> steps) {
  for (auto& [id, planned] : elements_) {
    if (!planned.state) continue;
    const ChainSteps* const before = planned.state->chains();
    const auto found = steps.find(id);
    planned.state->set_chains(found != steps.end() ? found->second.release() : nullptr);
    if (before != nullptr) Retire([before] { delete before; });
  }
}

bool ScheduleCompiler::IsToBePaused(const internal::PlannedElement& planned,
                                    const FrameworkElement* but_for) {
  for (const FrameworkElement* at = planned.element; at != nullptr; at = at->parent()) {
    if (at != but_for && internal::PauseMark::IsAt(*at)) return true;
  }
  const internal::ThreadSchedule* const thread = planned.thread;
  if (thread == nullptr || !thread->is_paused) return false;
  return but_for == nullptr || thread->runner->path() != but_for->path();
}

const internal::PlannedElement* ScheduleCompiler::FindAround(
    const FrameworkElement& element) const {
  for (const FrameworkElement* at = &element; at != nullptr; at = at->parent()) {
    const auto known = elements_.find(at->id());
    if (known != elements_.end() && known->second.thread != nullptr) return &known->second;
  }
  return nullptr;
}

bool ScheduleCompiler::IsPaused(FrameworkElement& element, const FrameworkElement* but_for) const {
  bool is_paused = false;
  element.Visit([&](FrameworkElement& each) {
    const auto known = elements_.find(each.id());
    is_paused = is_paused || (known != elements_.end() && IsToBePaused(known->second, but_for));
  });
  return is_paused;
}

// Who goes on looks at what has come meanwhile.
void ScheduleCompiler::SetPaused(FrameworkElement& element, bool is_paused) {
  element.Annotate(std::make_unique<internal::PauseMark>(is_paused));
  if (const auto thread = threads_.find(element.id()); thread != threads_.end()) {
    thread->second->is_paused = is_paused;
  }
  const EpochGuard guard;  // as publishers have one
  for (auto& [id, planned] : elements_) {
    if (!planned.state) continue;
    const bool was_paused = planned.state->is_paused();
    planned.state->SetPaused(IsToBePaused(planned));
    if (was_paused && !planned.state->is_paused()) planned.state->Wake();
  }
}

}  // namespace runnel
