#include "plugins/structure/structure_editor.h"

#include <algorithm>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "core/base/check.h"
#include "core/base/ordered_mutex.h"
#include "core/base/retry.h"
#include "core/element/own_thread.h"
#include "core/lockfree/thread_epoch.h"
#include "core/paths/new_feeds.h"
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

// Who deletes it does not wait for ever.
void WarnOfLeaving(const std::vector<std::string>& removed, Runtime& runtime, Diagnostics& diagnostics) {
  const std::lock_guard lock(runtime.structure_mutex());
  const auto* const leaving = runtime.root().FindAnnotation<Leaving>();
  if (leaving == nullptr) return;
  for (const UnlistedElement& each : leaving->elements) {
    if (std::ranges::count(removed, each->path()) == 0) continue;
    diagnostics.AddWarning(
        {.message = "is deleted; a call of its service that does not come to its end still uses its memory",
         .path = each->path()});
  }
}

}  // namespace

// Shared with the scheduler's fault handler, so that a fault that is just being answered when the editor
// goes still finds it.
struct StructureEditor::Shared {
  std::recursive_mutex applying;  // change sets, one after the other; comes first. Faults are answered meanwhile
  OrderedMutex mutex{LockLevel::kEditor};
  std::optional<internal::Probation> probation;  // guarded by mutex; none without a scheduler
  std::vector<UnlistedElement> Take(bool all) {
    const std::lock_guard lock(mutex);
    return probation ? probation->Take(all) : std::vector<UnlistedElement>();
  }
};

StructureEditor::StructureEditor(Runtime& runtime, const ModuleRegistry& modules, Scheduler* scheduler,
                                 EditorOptions options)
    : runtime_(runtime),
      modules_(modules),
      scheduler_(scheduler),
      options_(options),
      shared_(std::make_shared<Shared>()) {
  if (scheduler_ == nullptr) return;
  shared_->probation.emplace(runtime_, *scheduler_, options_.timeout);
  scheduler_->SetFaultHandler([shared = shared_](const Fault& fault) -> FaultDispatcher::Action {
    const std::lock_guard lock(shared->mutex);
    if (!shared->probation->Concerns(fault)) return {};
    return [shared, fault] { return shared->probation->PutBack(fault, shared->mutex); };
  });
}

StructureEditor::~StructureEditor() {
  if (scheduler_ == nullptr) return;
  scheduler_->SetFaultHandler({});
  runtime_.Destroy(shared_->Take(/*all=*/true));
}

std::size_t StructureEditor::on_probation() const {
  const std::lock_guard lock(shared_->mutex);
  return shared_->probation ? shared_->probation->size() : 0;
}

void StructureEditor::Tend() { runtime_.Destroy(shared_->Take(/*all=*/false)); }

ChangeOutcome StructureEditor::Apply(const ChangeSet& changes, const std::vector<SourcePosition>& places,
                                     const RobotStop::AsOf& as_of, ChangeSet* back) {
  internal::UndoRecord record;
  ChangeOutcome outcome = Apply(ChangeRequest{changes, places, as_of, nullptr, back != nullptr ? &record : nullptr});
  if (back != nullptr) *back = std::move(record.changes);
  return outcome;
}

ChangeOutcome StructureEditor::Apply(const ChangeRequest& request) {
  RUNNEL_CHECK(!EpochGuard::HeldByThisThread() && !runtime_.structure_mutex().HeldByThisThread(),
               "the structure cannot be changed by an editor from within a cycle, nor under the structure lock");
  const std::lock_guard lock(shared_->applying);
  Tend();
  NewFeeds feeds(runtime_);
  ChangeOutcome outcome;
  internal::Workshop workshop;
  try {
    for (int idle = 0; idle < kAttempts;) {
      const std::size_t made = workshop.size();
      outcome = {};
      const Attempt attempt = Try(request, workshop, outcome);
      if (outcome.is_done) feeds.KeepAll();
      if (attempt != Attempt::kOvertaken) return outcome;
      if (workshop.size() == made) ++idle;
    }
    outcome.diagnostics.Add({.message = "others change the structure all the time; gave up after " +
                                        std::to_string(kAttempts) + " attempts"});
  } catch (...) {
    // What has been done by then is done as a whole, and stays.
    if (outcome.is_done) feeds.KeepAll();
    const Error error{.message = DescribeException()};
    Retry([&] { outcome.is_done ? outcome.diagnostics.AddWarning(error) : outcome.diagnostics.Add(error); });
  }
  return outcome;
}

StructureEditor::Attempt StructureEditor::Try(const ChangeRequest& request, internal::Workshop& workshop,
                                              ChangeOutcome& outcome) {
  internal::Plan plan(runtime_, modules_, workshop, request.undo_record != nullptr);
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
  // Before the mutex: whoever answers a fault, and looks whether all is well, does not wait for a long cycle.
  std::optional<CycleHold> hold;
  if (scheduler_ != nullptr) {
    auto held = scheduler_->HoldCycles(plan.concerned(), options_.timeout, plan.going());
    if (!held) {
      outcome.diagnostics.Add(held.error());
      return Attempt::kFailed;
    }
    hold = std::move(*held);
  }
  std::unique_lock lock(shared_->mutex);
  {
    // Threads are not kept waiting for somebody who holds the lock.
    std::unique_lock structure(runtime_.structure_mutex(), std::try_to_lock);
    if (!structure.owns_lock()) {
      hold.reset();
      structure.lock();
      return Attempt::kOvertaken;
    }
    if (runtime_.revision() != revision) return Attempt::kOvertaken;
    if (auto known = runtime_.robot_stop().CheckIsKnown(request.as_of); !known) {
      outcome.diagnostics.Add(known.error());
      return Attempt::kFailed;
    }
    if (auto carried = plan.Commit(request.back); !carried) {
      outcome.diagnostics.Add(carried.error());
      outcome.is_refused = true;
      return Attempt::kFailed;
    }
  }
  outcome.is_done = true;
  for (const Error& each : plan.refused()) outcome.diagnostics.AddWarning(each);
  if (scheduler_ != nullptr) WarnOfIdleModules(request.changes, *scheduler_, outcome.diagnostics);
  if (hold) {
    outcome.hold_time = SteadyClock().Now() - hold->began();
    hold->Release();
  }
  if (shared_->probation) shared_->probation->Add(plan.replaced(), outcome.diagnostics);
  lock.unlock();
  std::vector<std::string> removed;
  for (const UnlistedElement& each : plan.removed()) removed.push_back(each->path());
  runtime_.Destroy(std::move(plan.removed()));
  WarnOfLeaving(removed, runtime_, outcome.diagnostics);
  Tend();
  for (internal::Replaced& each : plan.replaced()) runtime_.Destroy(std::move(each.before));
  return Attempt::kDone;
}

}  // namespace runnel
