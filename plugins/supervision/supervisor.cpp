#include "plugins/supervision/supervisor.h"

#include <algorithm>
#include <mutex>
#include <optional>
#include <set>
#include <utility>

#include "core/paths/path_search.h"
#include "core/port/port.h"
#include "core/types/duration_text.h"
#include "plugins/structure/change_text.h"
#include "plugins/structure/extension_changes.h"
#include "plugins/structure/structure_request.h"
#include "plugins/structure/value_by_hand.h"
#include "plugins/supervision/stop_button.h"
#include "plugins/supervision/watches.h"

namespace runnel {

using internal::StaleWatch;

namespace {

// How often modules are asked for what they want.
constexpr Duration kLookForRequests = std::chrono::milliseconds(50);

// Those that reactions are made of.
void MovePathsOf(Change& change, const std::function<void(std::string& path)>& move) {
  const auto move_ends = [&](auto& tie) {
    move(tie.from);
    move(tie.to);
  };
  if (auto* const cut = std::get_if<DisconnectPorts>(&change)) move_ends(*cut);
  if (auto* const tie = std::get_if<ConnectPorts>(&change)) move_ends(*tie);
  if (auto* const set = std::get_if<SetParameter>(&change)) move(set->path);
  if (auto* const replace = std::get_if<ReplaceModule>(&change)) move(replace->path);
}

}  // namespace

void Reaction::MovePaths(const std::function<void(std::string& path)>& move) {
  for (SafeValue& each : published) move(each.port);
  for (std::string& each : released) move(each);
  for (Change& each : changes) MovePathsOf(each, move);
  move(description);
}

struct Supervisor::Shared {
  struct KnownRule : SupervisionRule {
    bool is_applied = false;  // kPaused
  };
  Shared(Runtime& of_runtime, Scheduler& of_scheduler, Perform how)
      : runtime(of_runtime), scheduler(of_scheduler), perform(std::move(how)) {}

  void Note(Notice notice) {
    const std::lock_guard lock(mutex);
    notices.push_back(std::move(notice));
  }
  void MovePaths(const PathFollowers::Move& move);
  // `reaction`: as it is now, for paths change under the structure lock.
  void React(const Reaction& reaction, const std::string& path, const std::string& why, Time now, bool is_recovery = false);
  Result<void> Publish(const SafeValue& safe);
  Result<void> Release(const std::string& port);
  Time Watch(Time now);
  Result<void> AddWatch(const std::shared_ptr<KnownRule>& rule);
  void ServeRequests(Time now);
  void KeepSafe(Time now);
  void TellOverruns(Time now);

  Runtime& runtime;
  Scheduler& scheduler;
  const Perform perform;

  internal::Standstill standstill;  // under the structure lock
  std::set<std::string> late;       // threads of which that has been told; of the thread that looks out, as the next one
  std::vector<StaleWatch> watches;
  std::vector<std::shared_ptr<KnownRule>> rules;  // their paths are guarded by the structure lock
  std::mutex pausing;  // one after the other; before all others
  OrderedMutex mutex{LockLevel::kLeaf};
  std::vector<Notice> notices;  // guarded by mutex
};

void Supervisor::Shared::MovePaths(const PathFollowers::Move& move) {
  for (const auto& each : rules) {
    move(each->of);
    each->reaction.MovePaths(move);
    each->otherwise.MovePaths(move);
  }
  for (StaleWatch& each : watches) std::ranges::for_each(each.outputs(), move);
  scheduler.MovePaths(move);
}

Result<void> Supervisor::Shared::Publish(const SafeValue& safe) {
  const std::lock_guard lock(runtime.structure_mutex());
  const auto found = PathSearch(runtime).FindPort(safe.port, PathKind::kElement);
  if (!found) return found.error();
  const auto value = safe.value ? ValueOf(**found, *safe.value) : SafeValueOf(**found);
  if (!value) return value.error();
  internal::Standstill::LeaveToRule(**found);
  return PublishByHand(**found, value->get(), Port::Setter::kRule);
}

// Somebody else may have released it. What a person has set there stays.
Result<void> Supervisor::Shared::Release(const std::string& port) {
  const std::lock_guard lock(runtime.structure_mutex());
  const auto found = PathSearch(runtime).FindPort(port, PathKind::kElement);
  if (!found) return found.error();
  (*found)->Release(Port::Setter::kRule);
  return {};
}

// Safe values come first, and also if the rest fails. What can be said of a reaction that failed is told; the
// application runs on as it is, and stops if it was to stop.
void Supervisor::Shared::React(const Reaction& reaction, const std::string& path,
                               const std::string& why, Time now, bool is_recovery) {
  Result<void> done;
  for (const SafeValue& each : reaction.published) {
    if (auto published = Publish(each); !published && done) done = published;
  }
  if (!reaction.changes.empty()) {
    if (auto changed = perform(reaction.changes); !changed && done) done = changed;
  }
  for (const std::string& each : reaction.released) {
    if (auto released = Release(each); !released && done) done = released;
  }
  Notice notice{path, why, now, !done, is_recovery};
  if (!done) {
    notice.message += "; what was to be done about it failed: " + done.error().ToString();
  } else if (!reaction.description.empty()) {
    notice.message += "; " + reaction.description;
  }
  if (reaction.stops_application) {
    notice.message += "; stops the application";
    scheduler.StopForFault();
  }
  Note(std::move(notice));
}

// What modules ask for, in the order in which they were made. A request may delete who has asked.
void Supervisor::Shared::ServeRequests(Time now) {
  struct Asked {
    std::uint64_t id;
    std::string path;
    std::string text;
  };
  std::vector<Asked> all;
  const auto find = [this](std::uint64_t id) -> StructureRequest* {
    for (StructureRequest* each : StructureRequests::Of(runtime)->all()) {
      if (each->element().id() == id && each->is_asked()) return each;
    }
    return nullptr;
  };
  {
    const std::lock_guard lock(runtime.structure_mutex());
    const StructureRequests* const requests = StructureRequests::Of(runtime);
    if (requests == nullptr) return;
    for (const StructureRequest* each : requests->all()) {
      // Beside the tree nobody runs, and asks for nothing.
      if (!each->is_asked() || each->element().life_cycle() != LifeCycle::kReady) continue;
      all.push_back({each->element().id(), each->element().path(), std::string(each->text())});
    }
  }
  for (const Asked& each : all) {
    Diagnostics diagnostics;
    const PlacedChanges placed = ParseChanges(each.text, {each.path}, diagnostics);
    const Result<void> done =
        diagnostics.ok() ? perform(placed.changes) : Result<void>(diagnostics.errors().front());
    Note({each.path,
          done ? "has had it done: " + each.text
               : "asked in vain for: " + each.text + ": " + done.error().ToString(),
          now, !done});
    const std::lock_guard lock(runtime.structure_mutex());
    if (StructureRequest* const request = find(each.id)) request->Answer(done);
  }
}

void Supervisor::Shared::KeepSafe(Time now) {
  const std::lock_guard lock(runtime.structure_mutex());
  standstill.Look(runtime, scheduler, now,
                  [&](const Port& port, std::string what, bool is_recovery) {
                    Note({port.path(), std::move(what), now, false, is_recovery});
                  });
}

// Told once when it begins, and once when it ends.
void Supervisor::Shared::TellOverruns(Time now) {
  const std::lock_guard lock(runtime.structure_mutex());
  // No larger than what a function keeps without memory of its own: this is looked at between cycles.
  scheduler.VisitThreadStatistics([this, &now](const std::string& path, const CycleStatistics& all) {
    if (all.is_late == late.contains(path)) return;
    if (all.is_late) {
      late.insert(path);
    } else {
      late.erase(path);
    }
    const std::string count =
        std::to_string(all.recent_overruns) + " of its last " + std::to_string(all.recent_cycles) + " cycles";
    Note({path, all.is_late ? "overruns: " + count + " took longer than its period" : "keeps its period again", now,
          false, !all.is_late});
  });
}

Time Supervisor::Shared::Watch(Time now) {
  ServeRequests(now);
  KeepSafe(now);
  TellOverruns(now);
  struct Due {
    Reaction reaction;
    std::string path;
    std::string why;
    bool is_recovery;
  };
  std::vector<Due> due;
  Time next = now + kLookForRequests;
  if (!watches.empty()) {
    const std::lock_guard lock(runtime.structure_mutex());
    for (StaleWatch& watch : watches) {
      const auto turn = watch.Look(runtime, now);
      const SupervisionRule& rule = watch.rule();
      if (turn == StaleWatch::Turn::kStale) {
        due.push_back({rule.reaction, rule.of,
                       "nothing new for " + DurationText(now - watch.silent_since()) + ", at most " +
                           DurationText(rule.after) + " is allowed",
                       false});
      } else if (turn == StaleWatch::Turn::kFresh) {
        due.push_back(
            {rule.otherwise, rule.of, "values come again, for " + DurationText(rule.fresh_after) + " now", true});
      }
      next = std::min(next, watch.next_look());
    }
  }
  // Reactions take the lock for as long as they need it.
  for (const Due& each : due) React(each.reaction, each.path, each.why, now, each.is_recovery);
  return next;
}

Supervisor::Supervisor(Runtime& runtime, Scheduler& scheduler, Perform perform)
    : scheduler_(scheduler),
      shared_(std::make_shared<Shared>(runtime, scheduler, std::move(perform))) {
  scheduler_.SetWatchdog([shared = shared_](Time now) { return shared->Watch(now); });
  const std::lock_guard lock(runtime.structure_mutex());
  auto* followers = runtime.root().FindAnnotation<PathFollowers>();
  if (followers == nullptr) followers = &runtime.root().Annotate(std::make_unique<PathFollowers>());
  followers->all.push_back([shared = std::weak_ptr(shared_)](const PathFollowers::Move& move) {
    if (const auto there = shared.lock()) there->MovePaths(move);
  });
}

Supervisor::~Supervisor() { scheduler_.SetWatchdog({}); }

Result<void> Supervisor::Shared::AddWatch(const std::shared_ptr<KnownRule>& rule) {
  const std::lock_guard lock(runtime.structure_mutex());
  const auto refuse = [&](const char* message, const char* hint = "") {
    return Error{.message = message, .path = rule->of, .position = rule->position, .hint = hint};
  };
  const auto found = runtime.root().Find(rule->of);
  if (!found) return found.error();
  const auto* const port = dynamic_cast<const Port*>(*found);
  if (port == nullptr) return refuse("is not a port");
  if (rule->after <= Duration::zero() || rule->fresh_after < Duration::zero()) {
    return refuse("a time-out must be positive");
  }
  std::vector<std::string> outputs;
  for (const Port* output : port->Sources()) outputs.push_back(output->path());
  if (outputs.empty()) {
    return refuse("cannot become stale, as nothing is connected to it", "connect it, or leave out the rule");
  }
  watches.emplace_back(rule, std::move(outputs));
  return {};
}

// Weakly, for the scheduler keeps its rules longer than this.
std::function<void(const Fault&)> Supervisor::CallOf(std::shared_ptr<const SupervisionRule> rule,
                                                     Reaction SupervisionRule::*which, std::string why) const {
  if (((*rule).*which).is_empty()) return {};  // it is told of by the fault alone
  return [shared = std::weak_ptr(shared_), rule, which, why](const Fault& fault) {
    const auto there = shared.lock();
    if (there == nullptr) return;
    Reaction now;
    {
      const std::lock_guard lock(there->runtime.structure_mutex());
      now = (*rule).*which;
    }
    there->React(now, fault.path, why, fault.time);
  };
}

Result<void> Supervisor::Add(SupervisionRule rule) {
  using When = SupervisionRule::When;
  const auto known = std::make_shared<Shared::KnownRule>(Shared::KnownRule{std::move(rule)});
  if (known->when == When::kStale) {
    if (auto added = shared_->AddWatch(known); !added) return added;
  } else if (known->when == When::kFault && !known->reaction.is_empty()) {
    scheduler_.AddFaultRule({.of = known->of, .call = CallOf(known, &SupervisionRule::reaction, "has failed")});
  } else if (known->when == When::kStuck) {
    scheduler_.AddStuckRule({.of = known->of,
                             .after = known->after,
                             .on_stuck = CallOf(known, &SupervisionRule::reaction, "is stuck"),
                             .on_return = CallOf(known, &SupervisionRule::otherwise, "has returned")});
  }
  shared_->rules.push_back(known);
  return {};
}

Result<void> Supervisor::Add(StopButtonRule rule) {
  const std::lock_guard lock(shared_->runtime.structure_mutex());
  const auto port = PathSearch(shared_->runtime).FindPort(rule.port, PathKind::kOutput);
  if (!port) return port.error();
  if (auto good = CheckStopButton(**port); !good) return good;
  buttons_.push_back(std::make_unique<internal::StopButton>(
      shared_->runtime, std::move(rule), [shared = shared_](Notice notice) { shared->Note(std::move(notice)); }));
  return {};
}

// Who goes on finds what the rules have taken back.
Result<void> Supervisor::SetPaused(std::string_view path, bool is_paused) {
  const std::lock_guard lock(shared_->pausing);
  if (is_paused) {
    if (auto paused = scheduler_.SetPaused(path, true); !paused) return paused;
  } else if (auto known = scheduler_.CheckPaused(path); !known) {
    return known;
  }
  Runtime& runtime = shared_->runtime;
  for (const auto& each : shared_->rules) {
    if (each->when != SupervisionRule::When::kPaused) continue;
    bool applies = false;
    Reaction reaction;
    std::string of;
    {
      const std::lock_guard structure(runtime.structure_mutex());
      const auto found = runtime.root().Find(each->of);
      if (!found) continue;  // it stays as it is
      applies = scheduler_.IsPaused(**found, is_paused ? "" : path);
      reaction = applies ? each->reaction : each->otherwise;
      of = each->of;
    }
    if (applies == std::exchange(each->is_applied, applies)) continue;
    if (reaction.is_empty()) continue;
    shared_->React(reaction, of, applies ? "is paused" : "goes on", runtime.clock().Now());
  }
  if (is_paused) KeepSafe();
  return is_paused ? Result<void>() : scheduler_.SetPaused(path, false);
}

void Supervisor::KeepSafe() { shared_->KeepSafe(shared_->runtime.clock().Now()); }

std::vector<Notice> Supervisor::TakeNotices() {
  const std::lock_guard lock(shared_->mutex);
  return std::exchange(shared_->notices, {});
}

}  // namespace runnel
