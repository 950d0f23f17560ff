#include "plugins/supervision/supervisor.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <optional>
#include <utility>

#include "core/paths/path_search.h"
#include "core/port/port.h"
#include "core/types/duration_text.h"
#include "plugins/structure/change_text.h"
#include "plugins/structure/structure_request.h"
#include "plugins/structure/value_by_hand.h"
#include "plugins/supervision/stale_watch.h"
#include "plugins/supervision/standstill.h"
#include "plugins/supervision/stop_button.h"

namespace runnel {

using internal::StaleWatch;

namespace {

// For so long cycles are counted before it is told that they come late, or come in time again.
constexpr Duration kCounted = std::chrono::seconds(1);
// How often modules are asked for what they want.
constexpr Duration kLookForRequests = std::chrono::milliseconds(50);

}  // namespace

struct Supervisor::Shared {
  Shared(Runtime& of_runtime, Scheduler& of_scheduler, Perform how)
      : runtime(of_runtime), scheduler(of_scheduler), perform(std::move(how)) {}

  void Note(Notice notice) {
    const std::lock_guard lock(mutex);
    notices.push_back(std::move(notice));
  }
  void React(const Reaction& reaction, const std::string& path, const std::string& why, Time now, bool is_recovery = false);
  Result<void> Publish(const SafeValue& safe);
  Result<void> Release(const std::string& port);
  Time Watch(Time now);
  void ServeRequests(Time now);
  void KeepSafe(Time now);
  void CountOverruns(Time now);

  Runtime& runtime;
  Scheduler& scheduler;
  const Perform perform;
  // Whether a rule of modules that are paused has been applied.
  struct KnownPause {
    PauseReaction rule;
    bool is_applied = false;
  };

  internal::Standstill standstill;  // under the structure lock
  // What has been counted of a thread, and told.
  struct KnownThread {
    std::uint64_t cycles = 0;
    std::uint64_t overruns = 0;
    bool is_late = false;
  };
  std::map<std::string, KnownThread>
      threads;  // by path; of the thread that looks out, as the next ones
  std::optional<Time> counted;
  std::vector<StaleWatch> watches;  // of the thread that looks out
  std::mutex pausing;               // one after the other; before all others
  std::vector<KnownPause> pauses;   // guarded by pausing
  OrderedMutex mutex{LockLevel::kLeaf};
  std::vector<Notice> notices;  // guarded by mutex
};

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

// Told once when most cycles of a thread take longer than its period, and once when hardly any does so any more.
void Supervisor::Shared::CountOverruns(Time now) {
  if (counted && now < *counted + kCounted) return;
  const std::lock_guard lock(runtime.structure_mutex());
  // No larger than what a function keeps without memory of its own: this is looked at between cycles.
  scheduler.VisitThreadStatistics([this, &now](const std::string& path, const CycleStatistics& all) {
    KnownThread& known = threads[path];
    const std::uint64_t cycles = all.cycles - known.cycles;
    const std::uint64_t overruns = all.overruns - known.overruns;
    const bool was_late = known.is_late;
    const bool is_late = counted && overruns * (was_late ? 10 : 2) > cycles;
    if (counted && cycles == 0) return;
    known = {all.cycles, all.overruns, is_late};
    if (is_late == was_late) return;
    const std::string count =
        std::to_string(overruns) + " of its last " + std::to_string(cycles) + " cycles";
    Note(
        {path,
         is_late ? "overruns: " + count + " took longer than its period" : "keeps its period again",
         now, false, !is_late});
  });
  counted = now;
}

Time Supervisor::Shared::Watch(Time now) {
  ServeRequests(now);
  KeepSafe(now);
  CountOverruns(now);
  std::vector<std::pair<const StaleWatch*, StaleWatch::Turn>> turns;
  Time next = now + kLookForRequests;
  if (!watches.empty()) {
    const std::lock_guard lock(runtime.structure_mutex());
    for (StaleWatch& watch : watches) {
      const auto turn = watch.Look(runtime, now);
      if (turn != StaleWatch::Turn::kNone) turns.emplace_back(&watch, turn);
      next = std::min(next, watch.next_look());
    }
  }
  // Reactions take the lock for as long as they need it.
  for (const auto& [watch, turn] : turns) {
    const StaleRule& rule = watch->rule();
    if (turn == StaleWatch::Turn::kStale) {
      React(rule.on_stale, rule.input,
            "nothing new for " + DurationText(now - watch->silent_since()) + ", at most " +
                DurationText(rule.after) + " is allowed",
            now);
    } else {
      React(rule.on_fresh, rule.input,
            "values come again, for " + DurationText(rule.fresh_after) + " now", now, true);
    }
  }
  return next;
}

Supervisor::Supervisor(Runtime& runtime, Scheduler& scheduler, Perform perform)
    : scheduler_(scheduler),
      shared_(std::make_shared<Shared>(runtime, scheduler, std::move(perform))) {
  scheduler_.SetWatchdog([shared = shared_](Time now) { return shared->Watch(now); });
}

Supervisor::~Supervisor() { scheduler_.SetWatchdog({}); }

Result<void> Supervisor::Add(StaleRule rule) {
  const std::lock_guard lock(shared_->runtime.structure_mutex());
  const auto found = shared_->runtime.root().Find(rule.input);
  if (!found) return found.error();
  const auto* const port = dynamic_cast<const Port*>(*found);
  if (port == nullptr) return Error{.message = "is not a port", .path = rule.input};
  if (rule.after <= Duration::zero() || rule.fresh_after < Duration::zero()) {
    return Error{.message = "a time-out must be positive", .path = rule.input};
  }
  std::vector<std::string> outputs;
  for (const Port* output : port->Sources()) outputs.push_back(output->path());
  if (outputs.empty()) {
    return Error{.message = "cannot become stale, as nothing is connected to it",
                 .path = rule.input,
                 .hint = "connect it, or leave out the rule"};
  }
  shared_->watches.emplace_back(std::move(rule), std::move(outputs));
  return {};
}

// Weakly, for the scheduler keeps its rules longer than this.
std::function<void(const Fault&)> Supervisor::CallOf(const Reaction& reaction,
                                                     const std::string& why) const {
  return [shared = std::weak_ptr(shared_), reaction, why](const Fault& fault) {
    if (const auto there = shared.lock()) there->React(reaction, fault.path, why, fault.time);
  };
}

void Supervisor::Add(FaultReaction rule) {
  scheduler_.AddFaultRule({.of = rule.of, .call = CallOf(rule.reaction, "has failed")});
}

// One without a reaction is told of by the fault alone.
void Supervisor::Add(StuckReaction rule) {
  StuckRule watched{.of = rule.of, .after = rule.after};
  if (!rule.on_stuck.is_empty()) watched.on_stuck = CallOf(rule.on_stuck, "is stuck");
  if (!rule.on_return.is_empty()) watched.on_return = CallOf(rule.on_return, "has returned");
  scheduler_.AddStuckRule(std::move(watched));
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

void Supervisor::Add(PauseReaction rule) {
  const std::lock_guard lock(shared_->pausing);
  shared_->pauses.push_back({std::move(rule)});
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
  for (Shared::KnownPause& each : shared_->pauses) {
    bool applies = false;
    {
      const std::lock_guard structure(runtime.structure_mutex());
      const auto found = runtime.root().Find(each.rule.of);
      if (!found) continue;  // it stays as it is
      applies = scheduler_.IsPaused(**found, is_paused ? "" : path);
    }
    if (applies == std::exchange(each.is_applied, applies)) continue;
    const Reaction& reaction = applies ? each.rule.on_pause : each.rule.on_resume;
    if (reaction.is_empty()) continue;
    shared_->React(reaction, each.rule.of, applies ? "is paused" : "goes on", runtime.clock().Now());
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
