#include "plugins/supervision/supervisor.h"

#include <algorithm>
#include <mutex>
#include <utility>

#include "core/paths/path_search.h"
#include "core/port/port.h"
#include "core/types/duration_text.h"
#include "plugins/supervision/stop_button.h"
#include "plugins/supervision/supervisor_shared.h"

namespace runnel {

using internal::StaleWatch;

namespace {

// How often modules are asked for what they want.
constexpr Duration kLookForRequests = std::chrono::milliseconds(50);

}  // namespace

void Supervisor::Shared::MovePaths(const PathFollowers::Move& move) {
  for (const auto& each : rules) {
    move(each->of);
    each->reaction.MovePaths(move);
    each->otherwise.MovePaths(move);
    each->back.MovePaths(move);
  }
  std::ranges::for_each(later, move);
  std::set<std::string> moved;
  for (std::string each : late) {
    move(each);
    moved.insert(std::move(each));
  }
  late = std::move(moved);
  for (auto& [rule, watch] : watches) std::ranges::for_each(watch.outputs(), move);
  scheduler.MovePaths(move);
}

void Supervisor::Shared::KeepSafe(Time now) {
  const std::lock_guard lock(runtime.structure_mutex());
  EachForItself parts;
  parts.Do([&] { PublishMissed(now); });
  (void)ReleaseEach(later, now);
  parts.Do([&] {
    standstill.Look(runtime, scheduler, now, [&](const Port& port, std::string what, bool is_recovery) {
      Note({port.path(), std::move(what), now, false, is_recovery});
    });
  });
  parts.End();
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
  Time next = now + kLookForRequests;
  EachForItself parts;
  parts.Do([&] {
    if (is_real()) return beside.Ask();
    FollowPausesAgain();
    ServeRequests(now);
  });
  parts.Do([&] { KeepSafe(now); });
  parts.Do([&] { TellOverruns(now); });
  parts.Do([&] { next = std::min(next, LookForSilence(now)); });
  parts.End();
  return next;
}

// When to look again.
Time Supervisor::Shared::LookForSilence(Time now) {
  struct Due {
    std::shared_ptr<KnownRule> rule;
    std::string path;
    std::string why;
    bool is_recovery;
    std::size_t watch;
  };
  std::vector<Due> due;
  Time next = Time::max();
  if (!watches.empty()) {
    const std::lock_guard lock(runtime.structure_mutex());
    for (std::size_t i = 0; i < watches.size(); ++i) {
      auto& [rule, watch] = watches[i];
      const auto turn = watch.Look(runtime, now);
      if (turn == StaleWatch::Turn::kStale) {
        due.push_back({rule, rule->of,
                       "nothing new for " + DurationText(now - watch.silent_since()) + ", at most " +
                           DurationText(rule->after) + " is allowed",
                       false, i});
      } else if (turn == StaleWatch::Turn::kFresh) {
        due.push_back({rule, rule->of, "values come again, for " + DurationText(rule->fresh_after) + " now", true, i});
      } else {
        next = std::min(next, watch.next_look());
      }
    }
  }
  // Reactions take the lock for as long as they need it. What becomes safe does before anything is taken back.
  std::stable_partition(due.begin(), due.end(), [](const Due& each) { return !each.is_recovery; });
  // What has not been done for lack of memory stays due.
  EachForItself reactions;
  for (const Due& each : due) {
    reactions.Do([&] {
      React(*each.rule, each.is_recovery ? &SupervisionRule::otherwise : &SupervisionRule::reaction, each.path,
            each.why, now, each.is_recovery);
      const std::lock_guard lock(runtime.structure_mutex());
      StaleWatch& watch = watches[each.watch].second;
      watch.NoteDone(each.is_recovery ? StaleWatch::Turn::kFresh : StaleWatch::Turn::kStale, now);
      next = std::min(next, watch.next_look());
    });
  }
  reactions.End();
  return next;
}

Supervisor::Supervisor(Runtime& runtime, Scheduler& scheduler, Perform perform)
    : scheduler_(scheduler), shared_(std::make_shared<Shared>(runtime, scheduler, std::move(perform))) {
  scheduler_.SetWatchdog([shared = shared_](Time now) { return shared->Watch(now); });
  const std::lock_guard lock(runtime.structure_mutex());
  const std::weak_ptr<Shared> shared = shared_;
  runtime.root().FindOrAnnotate<PathFollowers>().all.push_back([shared](const PathFollowers::Move& move) {
    if (const auto there = shared.lock()) there->MovePaths(move);
  });
  runtime.root().FindOrAnnotate<SwitchedByRules>().all.push_back([shared] {
    std::vector<ChangeSet> back;
    const auto there = shared.lock();
    if (there == nullptr) return back;
    for (auto at = there->switched.rbegin(); at != there->switched.rend(); ++at) back.push_back((*at)->back.changes);
    return back;
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
                                                             std::shared_ptr<KnownRule> rule, Which which,
                                                             std::string why) {
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
    scheduler_.AddFaultRule({.of = known->of,
                             .call = Shared::CallOf(shared_, known, &SupervisionRule::reaction, "has failed"),
                             .ends_run = known->reaction.ends_run});
  } else if (known->when == When::kStuck) {
    scheduler_.AddStuckRule({.of = known->of,
                             .after = known->after,
                             .on_stuck = Shared::CallOf(shared_, known, &SupervisionRule::reaction, "is stuck"),
                             .ends_run = known->reaction.ends_run,
                             .on_return = Shared::CallOf(shared_, known, &SupervisionRule::otherwise, "has returned")});
  }
  const std::lock_guard lock(shared_->runtime.structure_mutex());
  shared_->rules.push_back(known);
  return {};
}

Result<void> Supervisor::Add(StopButtonRule rule) {
  const std::lock_guard lock(shared_->runtime.structure_mutex());
  const auto port = PathSearch(shared_->runtime).FindPort(rule.port, PathKind::kOutput);
  if (!port) return port.error();
  if (auto good = CheckStopButton(**port, rule.releases); !good) return good;
  buttons_.push_back(
      std::make_unique<internal::StopButton>(shared_->runtime, scheduler_, std::move(rule),
                                             [shared = shared_](Notice notice) { shared->Note(std::move(notice)); }));
  return {};
}

// As if what `but_for` pauses went on.
void Supervisor::Shared::FollowPauses(std::string_view but_for) {
  EachForItself reactions;
  for (const auto& each : rules) {
    if (each->when != SupervisionRule::When::kPaused) continue;
    reactions.Do([&] {
      bool applies = false;
      std::string of;
      {
        const std::lock_guard structure(runtime.structure_mutex());
        const auto found = runtime.root().Find(each->of);
        if (!found) return;  // it stays as it is
        applies = scheduler.IsPaused(**found, but_for);
        of = each->of;
      }
      if (applies == each->is_applied) return;
      const Which which = applies ? &SupervisionRule::reaction : &SupervisionRule::otherwise;
      each->is_applied.reset();
      if (!((*each).*which).is_empty())
        React(*each, which, of, applies ? "is paused" : "goes on", runtime.clock().Now(), false, Where::kHere);
      each->is_applied = applies;
    });
  }
  reactions.End();
}

// What was not done to its end, as it is now. Whoever pauses something just now does it himself.
void Supervisor::Shared::FollowPausesAgain() {
  if (!has_pauses_left) return;
  const std::unique_lock lock(pausing, std::try_to_lock);
  if (!lock) return;
  has_pauses_left = false;
  try {
    FollowPauses("");
  } catch (...) {
    has_pauses_left = true;
    throw;
  }
}

// Who goes on finds what the rules have taken back. Who is paused waits for the end of no other one's cycle.
Result<void> Supervisor::SetPaused(std::string_view path, bool is_paused) {
  const RobotStop::AsOf as_of = shared_->runtime.robot_stop().AsOfNow();
  // Whatever comes between: a look later the rules are as they should be.
  const struct LookAgain {
    ~LookAgain() { has_pauses_left = true; }
    std::atomic<bool>& has_pauses_left;
  } look_again{shared_->has_pauses_left};
  const Result<void> paused = is_paused ? scheduler_.SetPaused(path, true) : Result<void>();
  const std::lock_guard lock(shared_->pausing);
  // What is stuck is paused all the same.
  if (auto known = scheduler_.CheckPaused(path); !known) return paused ? known : paused;
  if (auto meant = shared_->runtime.robot_stop().CheckIsKnown(as_of); !is_paused && !meant) return meant;
  shared_->FollowPauses(is_paused ? "" : path);
  // It may have taken long.
  if (auto meant = shared_->runtime.robot_stop().CheckIsKnown(as_of); !is_paused && !meant) {
    shared_->FollowPauses("");
    return meant;
  }
  KeepSafe();  // of who goes on, too: what a rule has connected again has said nothing yet
  return is_paused ? paused : scheduler_.SetPaused(path, false);
}

void Supervisor::KeepSafe() { shared_->KeepSafe(shared_->runtime.clock().Now()); }

std::vector<Supervisor::Silence> Supervisor::Silent() const {
  const Time now = shared_->runtime.clock().Now();
  std::vector<Silence> silent;
  for (const auto& [rule, watch] : shared_->watches) {
    if (watch.is_stale() && shared_->runtime.root().Find(rule->of))
      silent.push_back({rule->of, now - watch.silent_since(), rule->after});
  }
  return silent;
}

void Supervisor::TakeNotices(std::vector<Notice>& to) {
  const std::lock_guard lock(shared_->mutex);
  auto& notices = shared_->notices;
  to.insert(to.end(), std::make_move_iterator(notices.begin()), std::make_move_iterator(notices.end()));
  notices.clear();
}

}  // namespace runnel
