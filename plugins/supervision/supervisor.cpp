#include "plugins/supervision/supervisor.h"

#include <algorithm>
#include <mutex>
#include <optional>
#include <set>
#include <utility>

#include "core/base/exception_text.h"
#include "core/paths/path_search.h"
#include "core/port/port.h"
#include "core/types/duration_text.h"
#include "plugins/structure/extension_changes.h"
#include "plugins/structure/value_by_hand.h"
#include "plugins/supervision/serve_requests.h"
#include "plugins/supervision/stop_button.h"
#include "plugins/supervision/watches.h"

namespace runnel {

using internal::StaleWatch;

namespace {

// How often modules are asked for what they want.
constexpr Duration kLookForRequests = std::chrono::milliseconds(50);

}  // namespace

struct Supervisor::Shared {
  struct KnownRule : SupervisionRule {
    bool is_applied = false;  // kPaused
    std::vector<bool> holds = {};  // by reaction.published: set, and neither taken back nor released; under the structure lock
  };
  Shared(Runtime& of_runtime, Scheduler& of_scheduler, Perform how)
      : runtime(of_runtime), scheduler(of_scheduler), perform(std::move(how)) {}

  void Note(Notice notice) {
    const std::lock_guard lock(mutex);
    notices.push_back(std::move(notice));
  }
  void MovePaths(const PathFollowers::Move& move);
  using Which = Reaction SupervisionRule::*;
  void React(KnownRule& rule, Which which, const std::string& path, const std::string& why, Time now, bool is_recovery = false);
  Result<void> CarryOut(KnownRule& rule, Which which, const Reaction& reaction, Time now);
  Result<void> Publish(const SafeValue& safe, const std::function<void(const Port& port)>& before = {});
  Result<void> Release(const std::string& port, Time now);
  // What rules hold there. Under the structure lock.
  void VisitHeld(const Port& port, const std::function<void(KnownRule& rule, std::size_t number)>& visit);
  Time Watch(Time now);
  static std::function<void(const Fault&)> CallOf(const std::shared_ptr<Shared>& shared, std::shared_ptr<KnownRule> rule,
                                                  Which which, std::string why);
  Result<void> AddWatch(const std::shared_ptr<KnownRule>& rule);
  void KeepSafe(Time now);
  void TellOverruns(Time now);

  Runtime& runtime;
  Scheduler& scheduler;
  const Perform perform;

  internal::Standstill standstill;  // under the structure lock
  std::set<std::string> late;       // threads of which that has been told; of the thread that looks out, as the next one
  std::vector<std::pair<std::shared_ptr<KnownRule>, StaleWatch>> watches;
  std::vector<std::shared_ptr<KnownRule>> rules;  // their paths are guarded by the structure lock
  std::vector<std::string> later;  // to be released if an undo brings them back; under the structure lock
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
  std::ranges::for_each(later, move);
  for (auto& [rule, watch] : watches) std::ranges::for_each(watch.outputs(), move);
  scheduler.MovePaths(move);
}

void Supervisor::Shared::VisitHeld(const Port& port, const std::function<void(KnownRule& rule, std::size_t number)>& visit) {
  for (const auto& rule : rules) {
    for (std::size_t i = 0; i < rule->holds.size(); ++i) {
      if (!rule->holds[i]) continue;
      const auto held = PathSearch(runtime).FindPort(rule->reaction.published[i].port, PathKind::kElement);
      if (held && *held == &port) visit(*rule, i);
    }
  }
}

Result<void> Supervisor::Shared::Publish(const SafeValue& safe, const std::function<void(const Port& port)>& before) {
  const std::lock_guard lock(runtime.structure_mutex());
  const auto found = PathSearch(runtime).FindPort(safe.port, PathKind::kElement);
  if (!found) return found.error();
  const auto value = safe.value ? ValueOf(**found, *safe.value) : SafeValueOf(**found);
  if (!value) return value.error();
  if (before) before(**found);
  internal::Standstill::LeaveToRule(**found);
  return PublishByHand(**found, value->get(), Port::Setter::kRule);
}

// What a person has set there stays, and what another rule holds there is in force again. Where what feeds a port that
// drives does not run yet, it stands until it has published.
Result<void> Supervisor::Shared::Release(const std::string& port, Time now) {
  const std::lock_guard lock(runtime.structure_mutex());
  const auto found = PathSearch(runtime).FindPort(port, PathKind::kElement);
  if (!found) return found.error();
  const SafeValue* other = nullptr;
  VisitHeld(**found, [&](KnownRule& rule, std::size_t number) { other = &rule.reaction.published[number]; });
  const bool was_released = !(*found)->is_set_by_hand(Port::Setter::kRule);  // by somebody else
  if (was_released) return {};
  if (other != nullptr) return Publish(*other);
  if (!internal::Standstill::TakesOver(**found, scheduler, now)) (*found)->Release(Port::Setter::kRule);
  return {};
}

// Safe values come first, and also if the rest fails.
Result<void> Supervisor::Shared::CarryOut(KnownRule& rule, Which which, const Reaction& reaction, Time now) {
  Result<void> done;
  for (std::size_t i = 0; i < reaction.published.size(); ++i) {
    const auto note = [&](const Port& port) {
      // What somebody has released no rule holds any more.
      if (!port.is_set_by_hand(Port::Setter::kRule)) VisitHeld(port, [](KnownRule& each, std::size_t number) { each.holds[number] = false; });
      if (which != &SupervisionRule::reaction) return;
      rule.holds.resize(reaction.published.size());
      rule.holds[i] = true;
    };
    if (auto published = Publish(reaction.published[i], note); !published && done) done = published;
  }
  if (!reaction.changes.empty()) {
    if (auto changed = perform(reaction.changes); !changed && done) done = changed;
  }
  for (const std::string& each : reaction.released) {
    auto released = Release(each, now);
    if (released) continue;
    const std::lock_guard lock(runtime.structure_mutex());
    later.push_back(each);
    if (done) done = released;
  }
  return done;
}

// What can be said of a reaction that failed is told; the application runs on as it is, and stops if it was to stop.
void Supervisor::Shared::React(KnownRule& rule, Which which, const std::string& path,
                               const std::string& why, Time now, bool is_recovery) {
  const Reaction& given = rule.*which;
  Reaction reaction{.stops_application = given.stops_application};
  // What only ends the run waits for no lock: the module that is stuck may have it.
  if (!given.published.empty() || !given.released.empty() || !given.changes.empty()) {
    const std::lock_guard lock(runtime.structure_mutex());
    reaction = given;  // as it is now, for paths change under the lock
    if (which == &SupervisionRule::otherwise) rule.holds.clear();
  }
  Result<void> done;
  try {
    done = CarryOut(rule, which, reaction, now);
  } catch (...) {  // neither the end of the run nor other reactions hang on it
    done = Error{.message = DescribeException()};
  }
  if (reaction.stops_application) scheduler.StopForFault();
  Notice notice{path, why, now, !done, is_recovery};
  if (!done) {
    notice.message += "; what was to be done about it failed: " + done.error().ToString();
  } else if (!reaction.description.empty()) {
    notice.message += "; " + reaction.description;
  }
  if (reaction.stops_application) notice.message += "; stops the application";
  Note(std::move(notice));
}

void Supervisor::Shared::KeepSafe(Time now) {
  const std::lock_guard lock(runtime.structure_mutex());
  std::erase_if(later, [&](const std::string& each) { return static_cast<bool>(Release(each, now)); });
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
  internal::ServeRequests(runtime, perform, [&](const std::string& path, std::string what, bool is_failure) {
    Note({path, std::move(what), now, is_failure});
  });
  KeepSafe(now);
  TellOverruns(now);
  struct Due {
    std::shared_ptr<KnownRule> rule;
    std::string path;
    std::string why;
    bool is_recovery;
  };
  std::vector<Due> due;
  Time next = now + kLookForRequests;
  if (!watches.empty()) {
    const std::lock_guard lock(runtime.structure_mutex());
    for (auto& [rule, watch] : watches) {
      const auto turn = watch.Look(runtime, now);
      if (turn == StaleWatch::Turn::kStale) {
        due.push_back({rule, rule->of,
                       "nothing new for " + DurationText(now - watch.silent_since()) + ", at most " +
                           DurationText(rule->after) + " is allowed",
                       false});
      } else if (turn == StaleWatch::Turn::kFresh) {
        due.push_back({rule, rule->of, "values come again, for " + DurationText(rule->fresh_after) + " now", true});
      }
      next = std::min(next, watch.next_look());
    }
  }
  // Reactions take the lock for as long as they need it. What becomes safe does before anything is taken back.
  std::ranges::stable_partition(due, [](const Due& each) { return !each.is_recovery; });
  for (const Due& each : due) {
    React(*each.rule, each.is_recovery ? &SupervisionRule::otherwise : &SupervisionRule::reaction, each.path, each.why, now,
          each.is_recovery);
  }
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
  watches.emplace_back(rule, StaleWatch(rule, std::move(outputs)));
  return {};
}

// Weakly, for the scheduler keeps its rules longer than this.
std::function<void(const Fault&)> Supervisor::Shared::CallOf(const std::shared_ptr<Shared>& shared,
                                                             std::shared_ptr<KnownRule> rule, Which which, std::string why) {
  if (((*rule).*which).is_empty()) return {};  // it is told of by the fault alone
  return [shared = std::weak_ptr(shared), rule = std::move(rule), which, why = std::move(why)](const Fault& fault) {
    if (const auto there = shared.lock()) there->React(*rule, which, fault.path, why, fault.time);
  };
}

Result<void> Supervisor::Add(SupervisionRule rule) {
  using When = SupervisionRule::When;
  const auto known = std::make_shared<Shared::KnownRule>(Shared::KnownRule{std::move(rule)});
  if (known->when == When::kStale) {
    if (auto added = shared_->AddWatch(known); !added) return added;
  } else if (known->when == When::kFault && !known->reaction.is_empty()) {
    scheduler_.AddFaultRule({.of = known->of, .call = Shared::CallOf(shared_, known, &SupervisionRule::reaction, "has failed")});
  } else if (known->when == When::kStuck) {
    scheduler_.AddStuckRule({.of = known->of,
                             .after = known->after,
                             .on_stuck = Shared::CallOf(shared_, known, &SupervisionRule::reaction, "is stuck"),
                             .on_return = Shared::CallOf(shared_, known, &SupervisionRule::otherwise, "has returned")});
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
    std::string of;
    {
      const std::lock_guard structure(runtime.structure_mutex());
      const auto found = runtime.root().Find(each->of);
      if (!found) continue;  // it stays as it is
      applies = scheduler_.IsPaused(**found, is_paused ? "" : path);
      of = each->of;
    }
    if (applies == std::exchange(each->is_applied, applies)) continue;
    const Shared::Which which = applies ? &SupervisionRule::reaction : &SupervisionRule::otherwise;
    if (((*each).*which).is_empty()) continue;
    shared_->React(*each, which, of, applies ? "is paused" : "goes on", runtime.clock().Now());
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
