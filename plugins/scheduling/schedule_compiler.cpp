#include "plugins/scheduling/schedule_compiler.h"

#include <algorithm>
#include <utility>

#include "core/base/retry.h"
#include "core/lockfree/thread_epoch.h"
#include "core/port/port.h"
#include "plugins/scheduling/cycle_runner.h"
#include "plugins/timing/trace_track.h"

namespace runnel {

namespace {

using internal::PlannedElement;
using internal::PlannedTask;
using internal::ThreadSchedule;

struct Found {
  std::vector<ThreadContainer*> containers;
  std::vector<FrameworkElement*> executables;
};

// In the order of their making.
Found Search(FrameworkElement& top) {
  Found found;
  top.Visit([&](FrameworkElement& element) {
    if (element.life_cycle() == LifeCycle::kDeleted) return;
    if (element.kind() == ElementKind::kThread) {
      if (auto* const thread = dynamic_cast<ThreadContainer*>(&element)) {
        found.containers.push_back(thread);
      }
    }
    if (element.life_cycle() == LifeCycle::kReady && element.FindAnnotation<Executable>()) {
      found.executables.push_back(&element);
    }
  });
  std::ranges::sort(found.containers, {}, &FrameworkElement::id);
  std::ranges::sort(found.executables, {}, &FrameworkElement::id);
  return found;
}

// Whether data go from the one to the other by a way on which they do not come late.
bool FeedsInTime(const Port& output, const Port& input) {
  return std::ranges::any_of(input.incoming(), [&](const Port* from) {
    const bool is_on_the_way = from == &output || (from->is_proxy() && FeedsInTime(output, *from));
    return is_on_the_way && !from->IsLateTo(input);
  });
}

// Each output at one end with each input at the other.
template <typename Visit>
void ForEachPair(const Port& from, const Port& to, const Visit& visit) {
  if (!from.is_proxy() && !to.is_proxy()) return visit(from, to);
  const std::vector<Port*> sinks = to.Sinks();
  for (const Port* output : from.Sources()) {
    for (const Port* input : sinks) visit(*output, *input);
  }
}

}  // namespace

ScheduleCompiler::~ScheduleCompiler() = default;

void ScheduleCompiler::CompileAll(FrameworkElement& root) {
  const Found found = Search(root);
  for (auto& [id, planned] : elements_) {
    planned.tasks.clear();
    planned.thread = nullptr;
  }
  tasks_of_groups_.Clear();
  MakeThreadSchedules(found.containers);
  has_unassigned_tasks_ = threads_.empty() && !found.executables.empty();
  if (!has_unassigned_tasks_) {
    for (FrameworkElement* element : found.executables) Plan(*element);
    for (FrameworkElement* element : found.executables) ConnectTasks(elements_[element->id()]);
  }
  needs_all_ = false;
}

void ScheduleCompiler::MakeThreadSchedules(const std::vector<ThreadContainer*>& containers) {
  ThreadSchedules before = std::exchange(threads_, {});
  changed_threads_.clear();
  auto waiting = std::make_shared<std::vector<CycleRunner*>>();
  for (const ThreadContainer* container : containers) {
    auto& thread = threads_[container->id()] = std::make_unique<ThreadSchedule>(container->runner());
    thread->name = container->name();
    thread->is_paused = internal::PauseMark::IsAt(*container);
    if (tracer_ != nullptr) {
      thread->track = &tracer_->TrackOf(container->id(), container->path());
    }
    if (thread->runner->waits_for_data()) waiting->push_back(thread->runner.get());
    NoteChange(*thread);
  }
  waiting_ = std::move(waiting);
  for (const auto& [id, thread] : before) {
    if (!threads_.contains(id)) gone_runners_.push_back(thread->runner);
  }
}

// What fails on the way, for lack of memory, is made good by compiling everything.
template <typename Change>
void ScheduleCompiler::Follow(const Change& change) noexcept {
  if (needs_all_) return;
  try {
    change();
  } catch (...) {
    needs_all_ = true;
  }
}

void ScheduleCompiler::Add(FrameworkElement& element) noexcept {
  Follow([&] {
    const Found found = Search(element);
    const auto is_new = [&](const auto* each) { return !threads_.contains(each->id()); };
    const bool lacks_a_thread = threads_.empty() && !found.executables.empty();
    if (lacks_a_thread || std::ranges::any_of(found.containers, is_new)) return NeedAll();
    std::vector<PlannedElement*> added;
    for (FrameworkElement* each : found.executables) {
      if (const auto known = elements_.find(each->id()); known != elements_.end()) {
        if (known->second.thread != nullptr) continue;
      }
      Plan(*each);
      added.push_back(&elements_[each->id()]);
    }
    for (PlannedElement* each : added) ConnectTasks(*each);
    // Ports that come when their module is there already.
    for (auto* above = element.parent(); above != nullptr; above = above->parent()) Refresh(*above);
  });
}

// Its trigger inputs stay tied meanwhile, so that no data are missed.
void ScheduleCompiler::Refresh(FrameworkElement& element) {
  const auto known = elements_.find(element.id());
  if (known == elements_.end() || known->second.thread == nullptr) return;
  RemoveTasks(known->second);
  Plan(element);
  ConnectTasks(known->second);
}

void ScheduleCompiler::Reassign(FrameworkElement& element) noexcept {
  Follow([&] {
    const std::uint64_t assigned = AssignedThread(element);
    if (assigned != 0 && !threads_.contains(assigned)) return NeedAll();
    std::vector<PlannedElement*> moved;
    for (FrameworkElement* each : Search(element).executables) {
      const auto known = elements_.find(each->id());
      ThreadSchedule* const thread = ChooseThread(*each);
      if (known == elements_.end() || known->second.thread == thread) continue;
      RemoveTasks(known->second);
      Plan(*each);
      moved.push_back(&known->second);
    }
    for (PlannedElement* each : moved) ConnectTasks(*each);
  });
}

void ScheduleCompiler::FollowActivation(const CycleRunner& runner) noexcept {
  if (needs_all_) return;
  const bool waited = std::ranges::find(*waiting_, &runner) != waiting_->end();
  if (waited != runner.waits_for_data()) NeedAll();
}

void ScheduleCompiler::Connect(const Port& from, const Port& to) noexcept {
  Follow([&] { ForEachPair(from, to, [&](auto& output, auto& input) { OrderPair(output, input); }); });
}

void ScheduleCompiler::Disconnect(const Port& from, const Port& to) noexcept {
  Follow([&] { ForEachPair(from, to, [&](auto& output, auto& input) { OrderPair(output, input, false); }); });
}

void ScheduleCompiler::Plan(FrameworkElement& element) {
  PlannedElement& planned = elements_[element.id()];
  planned.element = &element;
  if (!planned.state) {
    planned.state =
        std::make_shared<ScheduledElement>(element.path(), tracer_ != nullptr ? tracer_->Watch(element) : nullptr);
  }
  HandOver(planned, *ChooseThread(element));
  AddTasks(planned);
  planned.state->SetPaused(IsToBePaused(planned));
  std::vector<Task> tasks;
  for (const auto& each : planned.tasks) tasks.push_back(each->task);
  CycleRunner& runner = *planned.thread->runner;
  internal::BindTriggers(element, internal::TriggerInputs(tasks), *planned.state,
                         runner.waits_for_data() ? &runner : nullptr);
}

void ScheduleCompiler::AddTasks(PlannedElement& planned) {
  for (Task& task : planned.element->FindAnnotation<Executable>()->tasks()) {
    if (watch_ != nullptr) task.run = planned.state->Watched(task, *watch_);
    planned.tasks.push_back(std::make_unique<PlannedTask>(std::move(task)));
  }
  std::ranges::stable_sort(planned.tasks, {}, [](const auto& each) { return each->phase; });
  internal::RunningOrder& order = planned.thread->order;
  for (std::size_t i = 0; i < planned.tasks.size(); ++i) {
    PlannedTask& task = *planned.tasks[i];
    task.element = &planned;
    task.id = planned.element->id();
    task.number = i;
    task.is_first = i == 0;
    task.is_last = i + 1 == planned.tasks.size();
    order.Add(task);
    if (i > 0) order.KeepPhases(*planned.tasks[i - 1], task);
    tasks_of_groups_.Add(task);
  }
  Touch(*planned.thread);
}

void ScheduleCompiler::RemoveTasks(PlannedElement& planned) {
  ThreadSchedule* const thread = std::exchange(planned.thread, nullptr);
  if (thread != nullptr && !needs_all_) {  // else plans are made anew in any case
    for (const auto& task : planned.tasks) {
      tasks_of_groups_.Remove(*task);
      thread->order.Remove(*task);
    }
    Touch(*thread);
  }
  planned.tasks.clear();
}

void ScheduleCompiler::ConnectTasks(PlannedElement& planned) {
  for (const auto& task : planned.tasks) {
    for (const FrameworkElement* group : task->task.writes) {
      internal::VisitPorts(group, [&](const Port& port) {
        if (port.is_proxy() || port.direction() != Port::Direction::kOutput) return;
        for (const Port* input : port.Sinks()) OrderPair(port, *input);
      });
    }
    for (const FrameworkElement* group : task->task.reads) {
      internal::VisitPorts(group, [&](const Port& port) {
        if (port.is_proxy() || port.direction() != Port::Direction::kInput) return;
        for (const Port* output : port.Sources()) OrderPair(*output, port);
      });
    }
  }
}

void ScheduleCompiler::OrderPair(const Port& output, const Port& input, bool is_connected) {
  // One that is late says nothing of who runs first.
  if (FeedsInTime(output, input) != is_connected) return;
  tasks_of_groups_.ForEachPair(output, input, [&](PlannedTask& writer, PlannedTask& reader) {
    auto& order = writer.element->thread->order;
    is_connected ? order.Connect(writer, reader, {&output, &input})
                 : order.Disconnect(writer, reader, {&output, &input});
    Touch(*writer.element->thread);
  });
}

// The runner that has had the element until now may be in a cycle with it, and so may those before.
void ScheduleCompiler::HandOver(PlannedElement& planned, ThreadSchedule& thread) {
  planned.thread = &thread;
  const std::shared_ptr<const CycleQuiescence> next = thread.runner->quiescence();
  if (planned.current == next) return;
  std::erase_if(planned.before, [&](const auto& each) { return each.quiescence == next || each.HasLeft(); });
  if (planned.current) {
    planned.before.push_back({planned.current, installation_});
    has_handovers_ = true;
  }
  planned.current = next;
}

// What fails on the way is made good by compiling everything, but what is about to go is let go of: a schedule
// that has it may stay until there is memory for the next.
void ScheduleCompiler::Release(FrameworkElement& element) noexcept {
  element.Visit([this](FrameworkElement& each) {
    const auto known = elements_.find(each.id());
    if (known != elements_.end() && known->second.state) known->second.state->End();
  });
  Retry([&] {
    try {
      ReleaseAll(element);
    } catch (...) {
      NeedAll();
      throw;
    }
  });
}

void ScheduleCompiler::ReleaseAll(FrameworkElement& element) {
  element.Visit([this](FrameworkElement& each) {
    if (threads_.contains(each.id())) NeedAll();
    const auto known = elements_.find(each.id());
    if (known == elements_.end()) return;
    if (known->second.state) {  // else memory was too short for it, and nothing is bound
      internal::BindTriggers(each, internal::TriggerInputs(each.FindAnnotation<Executable>()->tasks()),
                             *known->second.state, nullptr);
    }
    RemoveTasks(known->second);
    // A publisher may still be about to wake it.
    Retire([state = known->second.state] {});
    elements_.erase(known);
  });
}

// A new connection that agrees with the order has changed nothing that a schedule says.
void ScheduleCompiler::Touch(ThreadSchedule& thread) {
  if (!thread.order.is_sorted()) NoteChange(thread);
}

void ScheduleCompiler::NoteChange(ThreadSchedule& thread) {
  if (!std::exchange(thread.is_changed, true)) changed_threads_.push_back(&thread);
}

ThreadSchedule* ScheduleCompiler::ChooseThread(const FrameworkElement& element) const {
  const auto assigned = threads_.find(AssignedThread(element));
  if (assigned != threads_.end()) return assigned->second.get();
  for (const auto& [id, thread] : threads_) {
    if (thread->name == default_thread_) return thread.get();
  }
  return threads_.empty() ? nullptr : threads_.begin()->second.get();
}

}  // namespace runnel
