// What comes of the plans of a ScheduleCompiler: schedules, and warnings.

#include <algorithm>
#include <utility>

#include "core/lockfree/thread_epoch.h"
#include "plugins/scheduling/internal/cut_report.h"
#include "plugins/scheduling/internal/trigger_ties.h"
#include "plugins/scheduling/schedule_compiler.h"

namespace runnel {

namespace {

using internal::Lane;
using internal::PlannedElement;
using internal::PlannedTask;

Schedule::Entry MakeEntry(const PlannedTask& task) {
  PlannedElement& element = *task.element;
  std::erase_if(element.before, [](const auto& each) { return each.HasLeft(); });
  return {task.task.run, element.state, task.phase, task.is_first, task.is_last, element.before};
}

// When its last owner, the block, lets go of it, it waits among the old ones for its schedule to go.
std::shared_ptr<const Schedule::Chunk> MakeChunk(
    const internal::Block<internal::OrderedTask>& block, const Lane& lane) {
  auto chunk = std::make_unique<Schedule::Chunk>();
  chunk->entries.reserve(block.items.size());
  for (const internal::OrderedTask* task : block.items) {
    chunk->entries.push_back(MakeEntry(static_cast<const PlannedTask&>(*task)));
    if (!chunk->entries.back().before.empty()) chunk->has_arrivals = true;
  }
  return {chunk.release(),
          [old = lane.old_chunks](const Schedule::Chunk* unused) { old->emplace_back(unused); }};
}

bool NeverRuns(const PlannedElement& planned) {
  if (!planned.lane->runner->waits_for_data()) return false;
  return std::ranges::all_of(planned.tasks, [](const auto& each) {
    return internal::TriggerInputs({each->task}).empty();
  });
}

Error NeverRun(const PlannedElement& planned) {
  return {.message = "is never run: its thread " + planned.lane->runner->path() +
                     " waits for data, and it has no trigger input",
          .path = planned.element->path(),
          .hint = "assign it to a periodic thread, or make an input with .trigger = true"};
}

Error ChosenForIt(const PlannedElement& planned) {
  return {.message = "is assigned to no thread, and there are several; " +
                     planned.lane->runner->path() + " runs it, as it was made first",
          .path = planned.element->path(),
          .hint = "assign it, or a group that it is in, to one of the threads"};
}

}  // namespace

std::unique_ptr<Schedule> ScheduleCompiler::MakeSchedule(Lane& lane) {
  auto schedule = std::make_unique<Schedule>();
  schedule->number = ++schedules_made_;
  schedule->waiting = waiting_;
  schedule->track = lane.track;
  const auto& blocks = lane.order.tasks().blocks();
  schedule->chunks.reserve(blocks.size());
  for (const auto& block : blocks) {
    if (std::exchange(block->is_changed, false)) block->made_of_it = MakeChunk(*block, lane);
    const auto* const chunk = static_cast<const Schedule::Chunk*>(block->made_of_it.get());
    schedule->chunks.push_back(chunk);
    schedule->has_arrivals = schedule->has_arrivals || chunk->has_arrivals;
  }
  lane.changes = lane.order.tasks().changes();
  return schedule;
}

// All schedules are made before the first is put into place, so that what fails on the way changes
// nothing; everything is then compiled anew.
void ScheduleCompiler::Install() {
  if (!has_changes()) return;
  std::vector<std::unique_ptr<Schedule>> schedules;
  try {
    for (Lane* lane : changed_lanes_) schedules.push_back(MakeSchedule(*lane));
  } catch (...) {
    NeedAll();
    throw;
  }
  for (std::size_t i = 0; i < schedules.size(); ++i) {
    Lane& lane = *changed_lanes_[i];
    auto old = std::make_shared<Lane::Chunks>(std::exchange(*lane.old_chunks, {}));
    lane.runner->Install(std::move(schedules[i]), std::move(old));
    lane.is_changed = false;
  }
  changed_lanes_.clear();
  for (const GoneRunner& gone : std::exchange(gone_runners_, {})) {
    gone.runner->Install(nullptr, gone.old_chunks);
    // Others may be about to tell it of data.
    Retire([runner = gone.runner] {});
  }
  // Nobody waits for an installation in which no element has changed threads.
  if (!std::exchange(has_handovers_, false)) return;
  installation_->Begin();
  installation_ = std::make_shared<Installation>();
}

ScheduleCompiler::Runners ScheduleCompiler::runners() const {
  Runners runners;
  for (const auto& [serial, lane] : lanes_) runners.push_back(lane->runner);
  return runners;
}

bool ScheduleCompiler::IsStopped(const FrameworkElement& element) const {
  const auto known = elements_.find(element.serial());
  return known != elements_.end() && known->second.state->is_stopped();
}

void ScheduleCompiler::AddRunnersOf(FrameworkElement& element, Runners& runners) const {
  element.Visit([&](const FrameworkElement& each) {
    const auto known = elements_.find(each.serial());
    if (known == elements_.end() || known->second.lane == nullptr) return;
    const auto& runner = known->second.lane->runner;
    if (std::ranges::find(runners, runner) == runners.end()) runners.push_back(runner);
  });
}

bool ScheduleCompiler::HasTasks() const {
  return std::ranges::any_of(lanes_,
                             [](const auto& each) { return each.second->order.size() > 0; });
}

std::vector<Error> ScheduleCompiler::Warnings() const {
  std::vector<Error> warnings;
  for (const auto& [serial, planned] : elements_) {
    if (planned.lane == nullptr) continue;
    if (NeverRuns(planned)) warnings.push_back(NeverRun(planned));
    if (IsAChoiceMissing(*planned.element)) warnings.push_back(ChosenForIt(planned));
  }
  for (const auto& [serial, lane] : lanes_) internal::ReportCuts(lane->order, warnings);
  return warnings;
}

// Whether nobody has said which of several threads is to run it.
bool ScheduleCompiler::IsAChoiceMissing(const FrameworkElement& element) const {
  if (lanes_.size() < 2 || lanes_.contains(AssignedThread(element))) return false;
  return std::ranges::none_of(
      lanes_, [&](const auto& each) { return each.second->name == default_thread_; });
}

}  // namespace runnel
