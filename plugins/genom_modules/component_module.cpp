#include "plugins/genom_modules/component_module.h"

#include <stdexcept>
#include <string>

#include "core/element/runtime.h"

namespace runnel::genom_modules {

using genom_execution::Engine;
using genom_execution::ExecutionTask;
using genom_execution::Pass;

namespace {

// A component that never pauses goes on in the next cycle.
constexpr int kMostRounds = 1000;

}  // namespace

genom_execution::EngineOptions ComponentModule::Options(ComponentModule& self, void* ids) {
  return {.ids = ids,
          .glue = &self,
          .is_single_threaded = true,
          .run_async = [](void* glue, std::size_t place, genom_execution::AsyncWork& work) {
            auto& module = *static_cast<ComponentModule*>(glue);
            module.workers_[place]->Begin(work);
            if (module.is_simulated_ && !work.codel().calls_others) module.workers_[place]->WaitUntilBack();
          }};
}

ComponentModule::ComponentModule(const Placement& placement, const genom_execution::ComponentTable& component,
                                 void* ids)
    : Module(placement),
      engine_(component, Options(*this, ids)),
      genom_state(this, "genom_state", {.description = "tasks and running activities"}),
      kill(*this, "kill", Engine::KillService(),
           {.service = {.description = "ends all activities, then the component"}}),
      abort_activity(*this, "abort_activity", Engine::AbortService(),
                     {.service = {.description = "interrupts one activity", .arguments = {"id"}},
                      .fill = [](genom_execution::Request& request, auto& arguments) {
                        WithArguments<std::uint32_t>(arguments, [&](std::uint32_t id) { request.abort_id = id; });
                      }}) {}

Result<void> ComponentModule::Prepare() {
  for (ModulePart* part : parts_) part->Prepare(engine_);
  const auto& component = engine_.component();
  bool has_async = false;
  for (const auto& codel : component.codels) has_async |= codel.is_async;
  workers_.resize(component.tasks.size() + 1);
  if (!has_async) return {};
  for (auto& worker : workers_) {
    if (worker == nullptr) worker = std::make_unique<AsyncWorker>();
  }
  is_simulated_ = dynamic_cast<const SteadyClock*>(&runtime().clock()) == nullptr;
  return {};
}

void ComponentModule::CheckPeriods() const {
  const Duration cycle = period();
  if (cycle == Duration::zero()) return;
  for (const auto& task : engine_.component().tasks) {
    if (task.period % cycle == Duration::zero() && task.delay % cycle == Duration::zero()) continue;
    throw std::runtime_error(std::string("task '") + task.name + "' has a period of " + TextOf(task.period) +
                             " and a delay of " + TextOf(task.delay) + ", and the thread of the module one of " +
                             TextOf(cycle) + ", which divides them not; give the thread one that does");
  }
}

void ComponentModule::Update() {
  if (is_broken_) return;
  if (!has_run_) CheckPeriods();
  has_run_ = true;
  is_broken_ = true;  // unless all codels return
  for (ModulePart* part : parts_) part->BeforePasses(engine_, now());
  RunPasses(false);
  is_broken_ = false;
  for (ModulePart* part : parts_) part->AfterPasses();
  if (genom_state.is_watched()) PublishState();
  if (const auto* failure = engine_.failure()) {
    throw std::runtime_error("a permanent activity has ended by " + failure->Text(engine_.component()));
  }
}

void ComponentModule::RunPasses(bool is_forced) {
  // A cycle that comes a little early is that of the tick.
  const Time time = now() + period() / 2;
  for (int round = 0; round < kMostRounds; ++round) {
    const std::uint64_t changes = engine_.changes();
    (void)engine_.RunControl();
    bool goes_on = false;
    for (std::size_t i = 0; i < engine_.tasks().size(); ++i) {
      goes_on |= engine_.RunTask(i, time, is_forced) == Pass::kAgain;
    }
    if (!goes_on && engine_.changes() == changes) return;
    if (is_forced && engine_.is_ended()) return;
  }
}

void ComponentModule::End() noexcept {
  try {
    engine_.Stop();
    for (int round = 0; has_run_ && !is_broken_ && !engine_.is_ended() && round < 100; ++round) {
      RunPasses(true);
      for (auto& worker : workers_) {
        if (worker != nullptr) worker->WaitUntilBack();
      }
    }
    for (ModulePart* part : parts_) part->AfterPasses();
  } catch (...) {  // a codel has thrown: nobody is there to be told
  }
  workers_.clear();  // what is with them comes back first
}

void ComponentModule::PublishState() {
  auto loan = genom_state.Loan();
  if (!loan) return;
  const auto& component = engine_.component();
  loan->component.Set(component.name);
  loan->version.Set(component.version);
  loan->digest.Set(component.digest);
  loan->tasks.resize(engine_.tasks().size());
  loan->activities.clear();
  for (std::size_t i = 0; i < engine_.tasks().size(); ++i) {
    ExecutionTask& task = engine_.tasks()[i];
    const auto figures = task.figures();
    TaskState& state = loan->tasks[i];
    state.name.Set(task.table().name);
    state.cycles = figures.cycles;
    state.last = ToSeconds(figures.last);
    state.longest = ToSeconds(figures.longest);
    state.average = figures.cycles > 0 ? ToSeconds(figures.total) / static_cast<double>(figures.cycles) : 0;
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

}  // namespace runnel::genom_modules
