#include "plugins/structure/structure_editor.h"

#include <mutex>
#include <optional>
#include <utility>

#include "core/base/check.h"
#include "core/base/exception_text.h"
#include "core/base/retry.h"
#include "core/lockfree/thread_epoch.h"
#include "plugins/structure/plan.h"
#include "plugins/structure/probation.h"

namespace runnel {

namespace {

// How often others may change the structure between checking and carrying out before it is given up.
constexpr int kAttempts = 100;

// Modules that never run from now on, because their thread waits for data that cannot come.
void WarnOfIdleModules(const ChangeSet& changes, Scheduler& scheduler, Diagnostics& diagnostics) {
  for (const Change& each : changes) {
    const auto* const change = std::get_if<ScheduleThread>(&each);
    if (change == nullptr || change->activation != ThreadOptions::Activation::kTrigger) continue;
    const std::string name = change->thread.substr(change->thread.rfind('/') + 1);
    for (const Error& warning : scheduler.Warnings()) {
      const bool is_of_it = warning.message.find("/" + name + " waits for data") != std::string::npos;
      if (is_of_it) diagnostics.AddWarning(warning);
    }
  }
}

}  // namespace

// Shared with the scheduler's fault handler, so that a fault that is just being answered when the editor
// goes still finds it.
struct StructureEditor::Shared {
  std::recursive_mutex
      applying;  // change sets, one after the other; comes first. Faults are answered meanwhile
  OrderedMutex mutex{LockLevel::kEditor};
  std::optional<internal::Probation> probation;  // guarded by mutex; none without a scheduler
};

StructureEditor::StructureEditor(Runtime& runtime, const ModuleRegistry& modules,
                                 Scheduler* scheduler, EditorOptions options)
    : runtime_(runtime),
      modules_(modules),
      scheduler_(scheduler),
      options_(options),
      shared_(std::make_shared<Shared>()) {
  if (scheduler_ == nullptr) return;
  shared_->probation.emplace(runtime_, *scheduler_, options_.timeout);
  scheduler_->SetFaultHandler([shared = shared_](const Fault& fault) {
    const std::lock_guard lock(shared->mutex);
    return shared->probation->Answer(fault);
  });
}

StructureEditor::~StructureEditor() {
  if (scheduler_ == nullptr) return;
  scheduler_->SetFaultHandler({});
  const std::lock_guard lock(shared_->mutex);
  runtime_.Destroy(shared_->probation->Take(/*all=*/true));
}

std::size_t StructureEditor::on_probation() const {
  const std::lock_guard lock(shared_->mutex);
  return shared_->probation ? shared_->probation->size() : 0;
}

void StructureEditor::Tend() {
  const std::lock_guard lock(shared_->mutex);
  if (shared_->probation) runtime_.Destroy(shared_->probation->Take(/*all=*/false));
}

ChangeOutcome StructureEditor::Apply(const ChangeSet& changes,
                                     const std::vector<SourcePosition>& places) {
  return Apply(ChangeRequest{changes, places});
}

ChangeOutcome StructureEditor::Apply(const ChangeRequest& request) {
  RUNNEL_CHECK(!EpochGuard::HeldByThisThread() && !runtime_.structure_mutex().HeldByThisThread(),
               "the structure cannot be changed by an editor from within a cycle, nor under the "
               "structure lock");
  const std::lock_guard lock(shared_->applying);
  ChangeOutcome outcome;
  internal::Workshop workshop;
  try {
    for (int idle = 0; idle < kAttempts;) {
      const std::size_t made = workshop.size();
      outcome = {};
      if (Try(request, workshop, outcome) != Attempt::kOvertaken) return outcome;
      if (workshop.size() == made) ++idle;
    }
    outcome.diagnostics.Add({.message = "others change the structure all the time; gave up after " +
                                        std::to_string(kAttempts) + " attempts"});
  } catch (...) {
    // What has been done by then is done as a whole, and stays.
    const Error error{.message = DescribeException()};
    Retry([&] {
      if (outcome.is_done) {
        outcome.diagnostics.AddWarning(error);
      } else {
        outcome.diagnostics.Add(error);
      }
    });
  }
  return outcome;
}

StructureEditor::Attempt StructureEditor::Try(const ChangeRequest& request,
                                              internal::Workshop& workshop,
                                              ChangeOutcome& outcome) {
  internal::Plan plan(runtime_, modules_, workshop);
  std::uint64_t revision = 0;
  try {
    const std::lock_guard lock(runtime_.structure_mutex());
    if (request.undo_record != nullptr) {
      const auto possible = internal::CheckExpected(*request.undo_record, runtime_.root());
      if (!possible) outcome.diagnostics.Add(possible.error());
    }
    if (outcome.diagnostics.ok()) plan.Make(request.changes, request.places, outcome.diagnostics);
    revision = runtime_.revision();
  } catch (const internal::Workshop::Overtaken&) {
    return Attempt::kOvertaken;
  }
  outcome.is_refused = !outcome.diagnostics.ok();
  if (outcome.is_refused) return Attempt::kFailed;
  const std::lock_guard lock(shared_->mutex);
  std::optional<CycleHold> hold;
  if (scheduler_ != nullptr) {
    auto held = scheduler_->HoldCycles(plan.concerned(), options_.timeout, plan.going());
    if (!held) {
      outcome.diagnostics.Add(held.error());
      return Attempt::kFailed;
    }
    hold = std::move(*held);
  }
  {
    // Threads are not kept waiting for somebody who holds the lock.
    std::unique_lock structure(runtime_.structure_mutex(), std::try_to_lock);
    if (!structure.owns_lock()) {
      hold.reset();
      structure.lock();
      return Attempt::kOvertaken;
    }
    if (runtime_.revision() != revision) return Attempt::kOvertaken;
    if (auto carried = plan.Commit(request.back); !carried) {
      outcome.diagnostics.Add(carried.error());
      outcome.is_refused = true;
      return Attempt::kFailed;
    }
  }
  outcome.is_done = true;
  if (scheduler_ != nullptr) WarnOfIdleModules(request.changes, *scheduler_, outcome.diagnostics);
  if (hold) {
    outcome.hold_time = SteadyClock().Now() - hold->began();
    hold->Release();
  }
  runtime_.Destroy(std::move(plan.removed()));
  if (shared_->probation) {
    runtime_.Destroy(shared_->probation->Take(/*all=*/false));
    shared_->probation->Add(plan.replaced());
  }
  for (internal::Replaced& each : plan.replaced()) runtime_.Destroy(std::move(each.before));
  return Attempt::kDone;
}

}  // namespace runnel
