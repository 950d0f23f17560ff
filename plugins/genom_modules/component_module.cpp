#include "plugins/genom_modules/component_module.h"

#include <algorithm>
#include <mutex>
#include <stdexcept>

#include "core/base/error.h"
#include "core/base/nearest_name.h"
#include "core/element/runtime.h"
#include "core/module/executable.h"
#include "core/module/kept_state.h"
#include "core/port/cycle.h"
#include "plugins/scheduling/thread_container.h"

namespace runnel::genom_modules {

using genom_execution::Engine;
using genom_execution::Pass;
using genom_execution::Request;

namespace {

// Of a cycle for codels of other threads. They are short, or they are asynchronous ones, which are not waited for.
constexpr Duration kPatience = std::chrono::milliseconds(20);
// For those that another component is to take the place of: cycles are held meanwhile.
constexpr Duration kToSettle = std::chrono::seconds(1);

bool IsUnderWay(const Request* activity) {
  return activity != nullptr && activity->state() == Request::State::kAccepted;
}

// Threads are children of a group "threads", of the application or of the root; the nearest of that name.
Result<ThreadContainer*> FindThread(const FrameworkElement& from, const std::string& name) {
  std::vector<std::string> known;
  for (const FrameworkElement* at = from.parent(); at != nullptr; at = at->parent()) {
    const FrameworkElement* const threads = at->FindChild("threads");
    if (threads == nullptr) continue;
    if (auto* const found = dynamic_cast<ThreadContainer*>(threads->FindChild(name))) return found;
    for (const FrameworkElement* each : threads->children()) known.push_back(each->name());
  }
  return Error{.message = "there is no thread '" + name + "'", .hint = NearestNameHint(name, known)};
}

/// "task 'drive' has a period …", if cycles of that period do not meet its ticks; else "".
std::string MissedTicks(const genom_execution::TaskTable& task, Duration cycle) {
  if (task.period % cycle == Duration::zero() && task.delay % cycle == Duration::zero()) return "";
  return std::string("task '") + task.name + "' has a period of " + TextOf(task.period) + " and a delay of " +
         TextOf(task.delay) + ", and its thread a period of " + TextOf(cycle) + ", which divides them not";
}

}  // namespace

ComponentModule::ComponentModule(const Placement& placement, const genom_execution::ComponentTable& component,
                                 void* ids)
    : Module(placement),
      component_(component),
      ids_(ids),
      genom_state(this, "genom_state", {.description = "tasks and running activities"}),
      kill(*this, "kill", Engine::KillService(),
           {.service = ServiceOptions{.description = "ends all activities, then the component"}}),
      abort_activity(
          *this, "abort_activity", Engine::AbortService(),
          // Its type is said, since GCC 12 destroys what was not made if memory runs out within braces alone.
          {.service = ServiceOptions{.description = "interrupts one activity", .arguments = {"id"}},
           .required = {"id"},
           .fill = [](genom_execution::Request& request, auto& arguments) {
             WithArguments<std::uint32_t>(arguments, [&](std::uint32_t id) { request.abort_id = id; });
           }}) {
  Annotate(std::make_unique<BeforeHandOver>([this] {
    Settle();
    return nullptr;
  }));
  for (const auto& task : component.tasks) {
    thread_names_.emplace_back(
        this, std::string("thread_of_") + task.name,
        ParameterOptions<std::string>{.description = std::string("name of the thread that runs task '") + task.name +
                                                     "'; empty: the module's own"});
  }
}

genom_execution::EngineOptions ComponentModule::Options() {
  const bool has_own = std::ranges::any_of(own_tasks_, [](const auto& target) { return target != nullptr; });
  genom_execution::EngineOptions options;
  options.ids = ids_;
  options.glue = this;
  options.is_single_threaded = !has_own;
  if (!is_simulated_) options.clock = &runtime().clock();
  if (has_own && !is_simulated_) options.patience = kPatience;
  options.run_async = [](void* glue, std::size_t place, genom_execution::AsyncWork& work) {
    auto& module = *static_cast<ComponentModule*>(glue);
    module.workers_[place]->Begin(work);
    if (module.is_simulated_ && !work.codel().calls_others) (void)module.workers_[place]->WaitUntilBack(Time::max());
  };
  if (has_own || !workers_.empty()) {
    options.wake = [](void* glue) {
      auto& module = *static_cast<ComponentModule*>(glue);
      module.own_part_.target.Wake();
      for (const auto& target : module.own_tasks_) {
        if (target != nullptr) target->Wake();
      }
    };
  }
  return options;
}

Result<void> ComponentModule::Prepare() {
  is_simulated_ = dynamic_cast<const SteadyClock*>(&runtime().clock()) == nullptr;
  MakeTasks();
  const bool has_async = std::ranges::any_of(component_.codels, &genom_execution::CodelTable::is_async);
  workers_.resize(has_async ? component_.tasks.size() + 1 : 0);
  for (auto& worker : workers_) worker = std::make_unique<AsyncWorker>();
  engine_.emplace(component_, Options());
  for (ModulePart* part : parts_) part->PrepareFor(*engine_);
  return {};
}

// Prepared after the component. Those that are there are of a Prepare() that has failed.
void ComponentModule::MakeTasks() {
  own_tasks_.resize(component_.tasks.size());
  for (std::size_t i = 0; i < own_tasks_.size(); ++i) {
    const std::string& thread = thread_names_[i].Get();
    if (thread.empty() || own_tasks_[i] != nullptr) continue;
    auto target = std::make_unique<WakeTarget>();
    runtime().Adopt(std::make_unique<TaskModule>(Placement{*this, std::string("task_") + component_.tasks[i].name},
                                                 *this, i, thread, *target));
    own_tasks_[i] = std::move(target);
  }
}

void ComponentModule::CheckPeriods() const {
  const Duration cycle = period();
  if (cycle == Duration::zero()) return;
  for (std::size_t i = 0; i < own_tasks_.size(); ++i) {
    if (own_tasks_[i] != nullptr) continue;
    const std::string missed = MissedTicks(component_.tasks[i], cycle);
    if (!missed.empty())
      throw std::runtime_error(missed + "; give the module's thread one that does, or the task a thread");
  }
}

void ComponentModule::Update() {
  if (is_broken_.load(std::memory_order_acquire)) {
    if (has_fault_.load(std::memory_order_acquire)) throw std::runtime_error(fault_);
    return;
  }
  if (is_settled_) BeginAfresh();
  if (!has_run_.load(std::memory_order_relaxed)) CheckPeriods();
  has_run_.store(true, std::memory_order_relaxed);
  const bool is_watched = genom_state.is_watched();
  engine_->SetMeasured(is_watched);
  for (ModulePart* part : parts_) part->BeforePasses(*engine_, now());
  try {
    // A cycle that comes a little early is that of the tick.
    RunPasses(now() + period() / 2, false);
  } catch (...) {
    is_broken_.store(true, std::memory_order_release);
    throw;
  }
  for (ModulePart* part : parts_) part->AfterPasses();
  if (is_watched) PublishState();
  if (const auto* failure = engine_->failure()) {
    throw std::runtime_error("a permanent activity has ended by " + failure->Text(component_));
  }
}

void PortReading::Note(const Request* reader, Time measured) noexcept {
  const auto rank = [&](const Slot& slot) {
    const Request* const before = slot.reader.load(std::memory_order_relaxed);
    const Time time = slot.measured.load(std::memory_order_relaxed);
    if (before == reader) return Time::min();
    return (before == nullptr ? time == Time::max() : !IsUnderWay(before)) ? Time::min() + Duration(1) : time;
  };
  Slot& slot = *std::ranges::min_element(slots, {}, rank);
  slot.reader.store(reader, std::memory_order_relaxed);
  slot.activity.store(reader != nullptr ? reader->id() : 0, std::memory_order_relaxed);
  slot.measured.store(measured, std::memory_order_relaxed);
}

Time ComponentModule::StampFor(const Request* writer) const noexcept {
  const Cycle* const cycle = CurrentCycle();
  Time oldest = cycle != nullptr ? std::min(cycle->now, cycle->stamp) : now();
  for (const PortReading* each : readings_) {
    for (const PortReading::Slot& slot : each->slots) {
      const Request* const reader = slot.reader.load(std::memory_order_relaxed);
      if (reader != nullptr && slot.activity.load(std::memory_order_relaxed) != reader->id()) continue;
      if (reader != nullptr && reader != writer && (writer != nullptr || !IsUnderWay(reader))) continue;
      oldest = std::min(oldest, slot.measured.load(std::memory_order_relaxed));
    }
  }
  return oldest;
}

void ComponentModule::RunOwnTask(std::size_t task, Time time) noexcept {
  if (is_broken_.load(std::memory_order_acquire)) return;
  has_run_.store(true, std::memory_order_relaxed);
  try {
    for (int round = 0; round < Engine::kMostRounds; ++round) {
      const std::uint64_t changes = engine_->changes();
      const Pass pass = engine_->RunTask(task, time);
      if (pass == Pass::kWaiting || (pass == Pass::kIdle && engine_->changes() == changes)) return;
    }
  } catch (...) {
    if (!is_fault_taken_.test_and_set(std::memory_order_relaxed)) {
      fault_ = std::string("task '") + component_.tasks[task].name + "': " + DescribeException();
      has_fault_.store(true, std::memory_order_release);
    }
    is_broken_.store(true, std::memory_order_release);
    own_part_.target.Wake();
  }
}

void ComponentModule::RunPasses(Time time, bool is_forced) {
  engine_->RunAll(time, is_forced, [&](std::size_t task) { return is_forced || own_tasks_[task] == nullptr; });
}

void ComponentModule::EndActivities(Time deadline) {
  engine_->Stop();
  for (int round = 0; has_run_ && !is_broken_ && !engine_->is_ended() && round < 100; ++round) {
    RunPasses(now(), true);
    for (auto& worker : workers_) {
      if (worker != nullptr && !worker->WaitUntilBack(deadline)) {
        throw std::runtime_error("one of its asynchronous codels does not come back");
      }
    }
  }
  for (ModulePart* part : parts_) part->AfterPasses();
}

void ComponentModule::Settle() {
  if (!engine_ || !has_run_ || is_broken_) return;
  is_settled_ |= !engine_->is_stopping();  // one that was killed stays so
  EndActivities(SteadyClock().Now() + kToSettle);
}

// The change has been taken back. Nobody else may be looking at the engine.
void ComponentModule::BeginAfresh() {
  if (!engine_->is_ended()) return;
  if (std::ranges::any_of(own_tasks_, [](const auto& target) { return target != nullptr; })) {
    throw std::runtime_error("has ended for one that was to take its place; restart it");
  }
  engine_.emplace(component_, Options());
  for (ModulePart* part : parts_) part->PrepareFor(*engine_);
  is_settled_ = false;
}

void ComponentModule::End() noexcept {
  if (!engine_) return;
  try {
    EndActivities(Time::max());
  } catch (...) {  // a codel has thrown: nobody is there to be told
  }
  workers_.clear();  // what is with them comes back first
}

void ComponentModule::PublishState() {
  auto loan = genom_state.Loan();
  if (!loan) return;
  const auto& component = component_;
  loan->component.Set(component.name);
  loan->version.Set(component.version);
  loan->digest.Set(component.digest);
  loan->tasks.resize(engine_->tasks().size());
  loan->activities.clear();
  for (std::size_t i = 0; i < engine_->tasks().size(); ++i) {
    genom_execution::ExecutionTask& task = engine_->tasks()[i];
    const auto figures = task.figures();
    TaskState& state = loan->tasks[i];
    state.name.Set(task.table().name);
    state.cycles = figures.cycles;
    state.last = ToSeconds(figures.last);
    state.longest = ToSeconds(figures.longest);
    state.average = figures.measured > 0 ? ToSeconds(figures.total) / static_cast<double>(figures.measured) : 0;
    if (task.is_periodic()) state.load = state.average / ToSeconds(task.table().period);
    for (std::size_t slot = 1; slot < task.used(); ++slot) {
      const genom_execution::Request* const request = task.slots()[slot].request;
      if (request == nullptr) continue;
      ActivityState& activity = loan->activities.emplace_back();
      activity.id = request->id();
      activity.service.Set(request->service().name);
      activity.state.Set(request->doing());
    }
  }
  genom_state.Publish(std::move(loan));
}

TaskModule::TaskModule(const Placement& placement, ComponentModule& component, std::size_t number, std::string thread,
                       WakeTarget& target)
    : Module(placement), component_(component), number_(number), thread_(std::move(thread)) {
  Annotate(std::make_unique<WakeSource>([&target](Waker* waker) { target.SetWaker(waker); }));
}

Result<void> TaskModule::Prepare() {
  const std::lock_guard lock(runtime().structure_mutex());
  const auto thread = FindThread(component_, thread_);
  if (!thread) return thread.error();
  if (auto good = Check(**thread); !good) return good;
  // What takes the component's place says anew who runs it.
  AssignThread(*this, **thread, AssignedBy::kModule);
  return {};
}

Result<void> TaskModule::Check(const ThreadContainer& thread) const {
  const genom_execution::TaskTable& task = component_.table().tasks[number_];
  if (task.period == Duration::zero()) return {};
  if (thread.options().activation == ThreadOptions::Activation::kTrigger) {
    return Error{
        .message = std::string("task '") + task.name + "' has a period, and thread '" + thread_ + "' waits for data",
        .hint = "give it a thread with a period"};
  }
  if (thread.options().activation == ThreadOptions::Activation::kFreeRunning) return {};
  const std::string missed = MissedTicks(task, thread.options().period);
  if (missed.empty()) return {};
  return Error{.message = missed, .hint = "give thread '" + thread_ + "' a period that does"};
}

void TaskModule::Update() { component_.RunOwnTask(number_, now() + period() / 2); }

}  // namespace runnel::genom_modules
