// What comes of the plans of a ScheduleCompiler: schedules, and warnings; and what it knows of tasks beside their order.

#include <algorithm>
#include <utility>

#include "core/base/retry.h"
#include "core/lockfree/thread_epoch.h"
#include "core/module/executable.h"
#include "core/port/input_base.h"
#include "plugins/scheduling/schedule_compiler.h"

namespace runnel {

namespace {

using internal::PlannedElement;
using internal::PlannedTask;
using internal::ThreadSchedule;

Schedule::Entry MakeEntry(const PlannedTask& task) {
  PlannedElement& element = *task.element;
  std::erase_if(element.before, [](const auto& each) { return each.HasLeft(); });
  return {task.task.run, element.state, task.phase, task.is_first, task.is_last, element.before};
}

bool NeverRuns(const PlannedElement& planned) {
  if (!planned.thread->runner->waits_for_data()) return false;
  return std::ranges::all_of(planned.tasks,
                             [](const auto& each) { return internal::TriggerInputs({each->task}).empty(); });
}

Error NeverRun(const PlannedElement& planned) {
  return {.message = "is never run: its thread " + planned.thread->runner->path() +
                     " waits for data, and it has no trigger input",
          .path = planned.element->path(),
          .hint = "assign it to a periodic thread, or make an input with .trigger = true"};
}

Error ChosenForIt(const PlannedElement& planned) {
  return {.message = "is assigned to no thread, and there are several; " + planned.thread->runner->path() +
                     " runs it, as it was made first",
          .path = planned.element->path(),
          .hint = "assign it, or a group that it is in, to one of the threads"};
}

}  // namespace

void internal::VisitPorts(const FrameworkElement* group, const std::function<void(Port&)>& visit) {
  if (group == nullptr) return;
  for (FrameworkElement* child : group->children()) {
    if (auto* const port = dynamic_cast<Port*>(child)) visit(*port);
    VisitPorts(child, visit);
  }
}

std::vector<InputBase*> internal::TriggerInputs(const std::vector<Task>& tasks) {
  std::vector<InputBase*> inputs;
  for (const Task& task : tasks) {
    for (const FrameworkElement* group : task.reads) {
      VisitPorts(group, [&](Port& port) {
        auto* const input = dynamic_cast<InputBase*>(&port);
        if (input != nullptr && input->is_trigger()) inputs.push_back(input);
      });
    }
  }
  return inputs;
}

// The runner comes last: what is there already is noted with the element alone until a schedule that
// has it is installed.
void internal::BindTriggers(const FrameworkElement& element, const std::vector<InputBase*>& inputs,
                            ScheduledElement& state, CycleRunner* runner) {
  Waker* const waker = runner != nullptr ? &state : nullptr;
  for (InputBase* input : inputs) input->SetWaker(waker);
  if (const auto* const source = element.FindAnnotation<WakeSource>()) source->SetWaker(waker);
  state.set_runner(runner);
}

std::unique_ptr<Schedule> ScheduleCompiler::MakeSchedule(ThreadSchedule& thread) {
  thread.order.Sort();
  auto schedule = std::make_unique<Schedule>();
  schedule->number = ++schedules_made_;
  schedule->waiting = waiting_;
  schedule->track = thread.track;
  schedule->entries.reserve(thread.order.tasks().size());
  for (const internal::OrderedTask* task : thread.order.tasks()) {
    schedule->entries.push_back(MakeEntry(static_cast<const PlannedTask&>(*task)));
    if (!schedule->entries.back().before.empty()) schedule->has_arrivals = true;
  }
  return schedule;
}

// All schedules are made before the first is put into place, so that what fails on the way changes
// nothing; everything is then compiled anew.
void ScheduleCompiler::Install() {
  if (!has_changes()) return;
  std::vector<std::unique_ptr<Schedule>> schedules;
  try {
    for (ThreadSchedule* thread : changed_threads_) schedules.push_back(MakeSchedule(*thread));
  } catch (...) {
    NeedAll();
    throw;
  }
  for (std::size_t i = 0; i < schedules.size(); ++i) {
    changed_threads_[i]->runner->Install(std::move(schedules[i]));
    changed_threads_[i]->is_changed = false;
  }
  changed_threads_.clear();
  for (const auto& gone : std::exchange(gone_runners_, {})) {
    gone->Install({});
    // Others may be about to tell it of data.
    Retire([runner = gone] {});
  }
  // Nobody waits for an installation in which no element has changed threads.
  if (!std::exchange(has_handovers_, false)) return;
  installation_->Begin();
  Retry([this] { installation_ = std::make_shared<Installation>(); });
}

ScheduleCompiler::Runners ScheduleCompiler::runners() const {
  Runners runners;
  for (const auto& [id, thread] : threads_) runners.push_back(thread->runner);
  return runners;
}

bool ScheduleCompiler::IsStopped(const FrameworkElement& element) const {
  const auto known = elements_.find(element.id());
  return known != elements_.end() && known->second.state->has_ended();
}

void ScheduleCompiler::AddRunnersOf(FrameworkElement& element, Runners& runners) const {
  element.Visit([&](const FrameworkElement& each) {
    const auto known = elements_.find(each.id());
    const auto thread = threads_.find(each.id());
    const bool is_run = known != elements_.end() && known->second.thread != nullptr;
    if (!is_run && thread == threads_.end()) return;
    const auto& runner = is_run ? known->second.thread->runner : thread->second->runner;
    if (std::ranges::find(runners, runner) == runners.end()) runners.push_back(runner);
  });
}

bool ScheduleCompiler::HasTasks() const {
  return std::ranges::any_of(threads_, [](const auto& each) { return each.second->order.size() > 0; });
}

std::vector<Error> ScheduleCompiler::Warnings() const {
  std::vector<Error> warnings;
  for (const auto& [id, planned] : elements_) {
    if (planned.thread == nullptr) continue;
    if (NeverRuns(planned)) warnings.push_back(NeverRun(planned));
    if (IsAChoiceMissing(*planned.element)) warnings.push_back(ChosenForIt(planned));
  }
  for (const auto& [id, thread] : threads_) internal::ReportCuts(thread->order, warnings);
  return warnings;
}

// Whether nobody has said which of several threads is to run it.
bool ScheduleCompiler::IsAChoiceMissing(const FrameworkElement& element) const {
  if (threads_.size() < 2 || threads_.contains(AssignedThread(element))) return false;
  return std::ranges::none_of(threads_, [&](const auto& each) { return each.second->name == default_thread_; });
}

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

bool ScheduleCompiler::IsToBePaused(const internal::PlannedElement& planned, const FrameworkElement* but_for) {
  for (const FrameworkElement* at = planned.element; at != nullptr; at = at->parent()) {
    if (at != but_for && internal::PauseMark::IsAt(*at)) return true;
  }
  const internal::ThreadSchedule* const thread = planned.thread;
  if (thread == nullptr || !thread->is_paused) return false;
  return but_for == nullptr || thread->runner->path() != but_for->path();
}

const internal::PlannedElement* ScheduleCompiler::FindAround(const FrameworkElement& element) const {
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
