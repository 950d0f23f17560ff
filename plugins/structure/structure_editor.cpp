#include "plugins/structure/structure_editor.h"

#include <algorithm>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "core/base/check.h"
#include "core/base/exception_text.h"
#include "core/base/ordered_mutex.h"
#include "core/base/retry.h"
#include "core/element/own_thread.h"
#include "core/lockfree/thread_epoch.h"
#include "core/paths/new_feeds.h"
#include "core/plugin/module_type_name.h"
#include "core/port/driving_ports.h"
#include "plugins/structure/plan.h"
#include "plugins/structure/replacement.h"

namespace runnel {

namespace internal {

/// The trial period of new modules, and the rollback: keeps replaced modules until their successors have run
/// some cycles without throwing, and puts them back if they do throw.
///
/// Threads:  all under the editor's mutex, but for PutBack(), which may take long; not under the structure lock.
class Probation {
 public:
  Probation(Runtime& runtime, Scheduler& scheduler, Duration timeout)
      : runtime_(runtime), scheduler_(scheduler), timeout_(timeout) {}

  /// Takes those that are to be kept; the rest stays in `replaced`. Throws for lack of memory, and has taken
  /// nothing then.
  void Add(std::vector<Replaced>& replaced);
  /// Takes out all, or those whose successors have proved themselves, or are gone.
  [[nodiscard]] std::vector<UnlistedElement> Take(bool all);
  /// Whether the module of the fault, which has thrown, is on probation.
  [[nodiscard]] bool Concerns(const Fault& fault);
  /// The predecessor of that module is back when this returns. What has been done, in words. Throws if it could not be.
  [[nodiscard]] std::string PutBack(const Fault& fault, OrderedMutex& mutex);
  [[nodiscard]] std::size_t size() const noexcept { return waiting_.size(); }

 private:
  struct Waiting {
    Replaced replaced;
    std::uint64_t until_cycle = 0;  // 0: it has proved itself
  };

  [[nodiscard]] FrameworkElement* Successor(const Waiting& waiting);
  [[nodiscard]] bool HasProved(const Waiting& waiting);
  [[nodiscard]] std::vector<Waiting>::iterator Find(const std::string& path);
  Result<UnlistedElement> PutBack(Waiting& waiting, std::string& done);

  Runtime& runtime_;
  Scheduler& scheduler_;
  const Duration timeout_;
  std::vector<Waiting> waiting_;
  std::vector<UnlistedElement> proved_;  // that nobody has taken yet
};

void Probation::Add(std::vector<Replaced>& replaced) {
  std::vector<std::uint64_t> until(replaced.size(), 0);
  for (std::size_t i = 0; i < replaced.size(); ++i) {
    const auto progress = scheduler_.ProgressOf(replaced[i].path);
    if (progress && replaced[i].probation_cycles > 0) until[i] = progress->cycles + replaced[i].probation_cycles;
  }
  waiting_.reserve(waiting_.size() + replaced.size());
  for (std::size_t i = 0; i < replaced.size(); ++i) {
    if (until[i] > 0) waiting_.push_back({std::move(replaced[i]), until[i]});
  }
  std::erase_if(replaced, [](const Replaced& each) { return !each.before; });
}

FrameworkElement* Probation::Successor(const Waiting& waiting) {
  const std::lock_guard lock(runtime_.structure_mutex());
  const auto found = runtime_.root().Find(waiting.replaced.path);
  const bool is_it = found && (*found)->id() == waiting.replaced.id;
  return is_it ? *found : nullptr;
}

// Who has thrown waits for the answer, however long that takes.
bool Probation::HasProved(const Waiting& waiting) {
  if (waiting.until_cycle == 0 || Successor(waiting) == nullptr) return true;
  const auto progress = scheduler_.ProgressOf(waiting.replaced.path);
  return !progress || (!progress->has_failed && progress->cycles > waiting.until_cycle);
}

// Memory comes before anything is taken out: what is lost on the way would be destroyed while others look at it.
std::vector<UnlistedElement> Probation::Take(bool all) {
  proved_.reserve(proved_.size() + waiting_.size());
  for (Waiting& each : waiting_) {
    if (all || HasProved(each)) each.until_cycle = 0;
  }
  for (Waiting& each : waiting_) {
    if (each.until_cycle == 0) proved_.push_back(std::move(each.replaced.before));
  }
  std::erase_if(waiting_, [](const Waiting& each) { return !each.replaced.before; });
  return std::exchange(proved_, {});
}

std::vector<Probation::Waiting>::iterator Probation::Find(const std::string& path) {
  return std::ranges::find_if(
      waiting_, [&](const Waiting& each) { return each.replaced.path == path && Successor(each) != nullptr; });
}

bool Probation::Concerns(const Fault& fault) {
  const auto found = Find(fault.path);
  if (found == waiting_.end()) return false;
  if (fault.cycle > found->until_cycle) found->until_cycle = 0;
  return found->until_cycle > 0;
}

std::string Probation::PutBack(const Fault& fault, OrderedMutex& mutex) {
  auto hold = scheduler_.HoldCycles({fault.path}, timeout_);
  std::unique_lock lock(mutex);
  const auto found = Find(fault.path);
  const auto progress = scheduler_.ProgressOf(fault.path);
  const bool is_there = found != waiting_.end() && progress && progress->has_failed;
  if (!is_there) return "others have removed it meanwhile";
  const std::string before = FindModuleType(*found->replaced.before);
  std::string done = "the module before (" + (before.empty() ? "made by code" : before) + ") is back in its place";
  auto gone = hold ? PutBack(*found, done) : hold.error();
  if (!gone) throw std::runtime_error("the module before could not be put back: " + gone.error().ToString());
  waiting_.erase(found);
  lock.unlock();
  hold->Release();
  runtime_.Destroy(std::move(*gone));
  return done;
}

// Between two cycles. Leaves `waiting` as it is if it fails. `done` gets what is lost.
Result<UnlistedElement> Probation::PutBack(Waiting& waiting, std::string& done) {
  const ChangeScope all_at_once(runtime_);
  FrameworkElement* const after = Successor(waiting);
  if (after == nullptr) return std::move(waiting.replaced.before);
  const FrameworkElement* const place = NextSibling(*after);
  std::vector<BeforeHandOver::Held> held;  // by one that has failed and goes anyway, too
  for (const auto* each : {after, &*waiting.replaced.before}) (void)Settle(*each, held);
  FrameworkElement& before = *waiting.replaced.before;
  before.VisitAll<Port>([](Port& port) { DrivingState::Of(port).is_later = true; });
  // Connections may have changed meanwhile: what the old module has no port for goes with the new one.
  StructureOverlay overlay(runtime_);
  const PortMatch match = MatchPorts(*after, before, overlay);
  if (match.errors.size() > match.misfits.size()) return match.errors.front();  // it would move, or is held
  for (const Error& each : match.errors) done += "; not taken over: " + each.path + ": " + each.message;
  if (auto possible = overlay.Replace(*after, before, match.ports); !possible) return possible.error();
  InheritAnnotations(before, *after, match.ports);
  auto gone = runtime_.Unlist(*after);
  if (!gone) return gone.error();
  std::size_t moved = 0;
  try {
    for (const auto& [from, to] : match.ports) {
      TakeOver(*to, *from, *after, before);
      ++moved;
    }
    Must(runtime_.List(std::move(waiting.replaced.before), place));
    return gone;
  } catch (...) {
    Retry([&] {
      for (; moved > 0; --moved) {
        const auto& [from, to] = match.ports[moved - 1];
        TakeOver(*from, *to, before, *after);
      }
      (void)runtime_.List(std::move(*gone), place);
    });
    throw;
  }
}

}  // namespace internal

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
               "the structure cannot be changed by an editor from within a cycle, nor under the "
               "structure lock");
  const std::lock_guard lock(shared_->applying);
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
  if (scheduler_ != nullptr) WarnOfIdleModules(request.changes, *scheduler_, outcome.diagnostics);
  if (hold) {
    outcome.hold_time = SteadyClock().Now() - hold->began();
    hold->Release();
  }
  if (shared_->probation) shared_->probation->Add(plan.replaced());
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
