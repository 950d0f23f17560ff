#include "plugins/scheduling/cycle_watchdog.h"

#include <algorithm>
#include <utility>

#include "core/element/element_path.h"
#include "core/types/duration_text.h"
#include "plugins/scheduling/fault_dispatcher.h"
#include "plugins/scheduling/scheduled_element.h"

namespace runnel {

namespace {

constexpr Duration kShortestInterval = std::chrono::milliseconds(1);
constexpr Duration kLongestInterval = std::chrono::milliseconds(100);
constexpr int kLooksInTime = 4;

Time Now() { return SteadyClock().Now(); }

}  // namespace

void CycleWatchdog::Add(StuckRule rule) {
  const std::lock_guard lock(mutex_);
  rules_.push_back(std::make_shared<KnownRule>(KnownRule{std::move(rule), false}));
  Change();
}

void CycleWatchdog::SetLimit(const std::string& of, Duration after) {
  const std::lock_guard lock(mutex_);
  std::erase_if(rules_, [&](const auto& each) { return each->is_limit && each->rule.of == of; });
  const bool has_default = std::ranges::any_of(rules_, [](const auto& each) { return each->IsDefault(); });
  if (after > Duration{} || has_default) {
    rules_.push_back(std::make_shared<KnownRule>(KnownRule{{.of = of, .after = after}, true}));
  }
  Change();
}

std::vector<StuckRule> CycleWatchdog::rules() const {
  const std::lock_guard lock(mutex_);
  std::vector<StuckRule> rules;
  for (const auto& each : rules_) rules.push_back(each->rule);
  return rules;
}

bool CycleWatchdog::has_rules() const {
  const std::lock_guard lock(mutex_);
  return !rules_.empty();
}

void CycleWatchdog::MovePaths(const std::function<void(std::string& path)>& move) {
  const std::lock_guard lock(mutex_);
  for (const auto& each : rules_) move(each->rule.of);
}

// Under the mutex, as what follows.
void CycleWatchdog::MakeRoom() {
  for (Watched& each : watched_) {
    for (auto* const rules : {&each.fired, &each.returned}) rules->reserve(rules->size() + rules_.size());
  }
}

// Whom nobody asks for anything has no thread.
void CycleWatchdog::Change() {
  MakeRoom();
  if (lookout_ && !rules_.empty()) lookout_->Ask();
}

void CycleWatchdog::Begin() {
  const std::lock_guard lock(mutex_);
  if (!lookout_) lookout_ = std::make_unique<Lookout>([this] { return LookAround(); });
  Change();
}

void CycleWatchdog::Follow(Runners runners) {
  const std::lock_guard lock(mutex_);
  std::vector<Watched> watched;
  watched.reserve(runners.size());  // none is moved before there is room for all
  for (auto& runner : runners) {
    const auto known = std::ranges::find(watched_, runner, &Watched::runner);
    watched.push_back(known != watched_.end() ? std::move(*known) : Watched{.runner = std::move(runner)});
  }
  watched_ = std::move(watched);
  MakeRoom();
}

void CycleWatchdog::End() {
  std::unique_ptr<Lookout> ended;  // waits for its look without the lock
  const std::lock_guard lock(mutex_);
  ended.swap(lookout_);
}

// Under the mutex.
Duration CycleWatchdog::Interval() const {
  Duration shortest = kLongestInterval * kLooksInTime;
  for (const auto& each : rules_) {
    if (each->rule.after > Duration{}) shortest = std::min(shortest, each->rule.after);
  }
  return std::max(shortest / kLooksInTime, kShortestInterval);
}

std::optional<Time> CycleWatchdog::LookAround() {
  std::unique_lock lock(mutex_);
  if (rules_.empty()) return {};
  Look(Now());
  const Time next = Now() + Interval();
  if (std::ranges::all_of(watched_, [](const Watched& each) { return each.fired.empty(); })) return next;
  lock.unlock();
  const std::lock_guard listening(listening_);
  if (listener_) listener_();
  return next;
}

void CycleWatchdog::SetListener(std::function<void()> listener) {
  const std::lock_guard listening(listening_);
  listener_ = std::move(listener);
}

bool CycleWatchdog::IsAbout(const KnownRule& known, const std::string& path, const std::string& thread) const {
  if (!known.IsDefault()) return thread == known.rule.of || IsAtOrBelow(path, known.rule.of);
  return std::ranges::none_of(rules_,
                              [&](const auto& each) { return !each->IsDefault() && IsAbout(*each, path, thread); });
}

// That a module is stuck is known, and the run ends, also where there is no memory to tell of it; that is told later.
void CycleWatchdog::Look(Time now) {
  for (Watched& each : watched_) {
    try {
      Look(each, now);
      TellReturned(each);
      TellStuck(each, now);
    } catch (...) {
      const auto ends = [](const auto& known) { return known->rule.ends_run; };
      const auto first = each.fired.begin() + static_cast<std::ptrdiff_t>(each.told);
      if (std::any_of(first, each.fired.end(), ends)) faults_.EndForFault();
    }
  }
}

void CycleWatchdog::Look(Watched& watched, Time now) {
  const RunningTask::State state = watched.runner->running().Look();
  if (state.element == nullptr || state != watched.state) {
    watched.fired.resize(watched.told);
    if (std::exchange(watched.told, 0) > 0) {
      watched.returned.swap(watched.fired);
      watched.path_of_returned.swap(watched.path);
      watched.lasted = now - watched.seen;
    }
    watched.path.clear();
    watched.state = state;
    watched.seen = now;
    return;
  }
  const Duration since = now - watched.seen;
  for (const auto& known : rules_) {
    const Duration after = known->rule.after;
    if (after == Duration{} || since < after || std::ranges::count(watched.fired, known) > 0) continue;
    const auto note = [&](const std::string& path) {
      if (IsAbout(*known, path, watched.runner->path())) watched.fired.push_back(known);
    };
    ScheduledElement::WithPath(state.element, std::ref(note));
  }
}

void CycleWatchdog::TellStuck(Watched& watched, Time now) {
  for (; watched.told < watched.fired.size(); ++watched.told) {
    const StuckRule& rule = watched.fired[watched.told]->rule;
    const auto keep = [&](const std::string& path) { watched.path = path; };
    ScheduledElement::WithPath(watched.state.element, std::ref(keep));
    Tell(watched,
         {.path = watched.path,
          .message = "has not returned from its cycle for " + DurationText(now - watched.seen) + "; at most " +
                     DurationText(rule.after) + " is allowed",
          .kind = Fault::Kind::kStuck},
         rule.on_stuck, rule.ends_run);
  }
}

void CycleWatchdog::TellReturned(Watched& watched) {
  bool is_told = false;
  for (auto& rules = watched.returned; !rules.empty(); rules.erase(rules.begin())) {
    const auto& call = rules.front()->rule.on_return;
    if (std::exchange(is_told, true) && !call) continue;
    Tell(watched,
         {.path = watched.path_of_returned,
          .message = "has returned from its cycle, after " + DurationText(watched.lasted),
          .is_mended = true,
          .kind = Fault::Kind::kReturned},
         call);
  }
}

void CycleWatchdog::Tell(const Watched& watched, Fault fault, const std::function<void(const Fault&)>& call,
                         bool ends_run) {
  fault.time = clock_.Now();
  fault.cycle = watched.runner->cycles_begun();
  faults_.Raise(std::make_unique<FaultRecord>(std::move(fault), call, ends_run));
}

std::vector<StuckModule> CycleWatchdog::Stuck() const {
  const std::lock_guard lock(mutex_);
  std::vector<StuckModule> stuck;
  for (const Watched& each : watched_) {
    if (each.fired.empty() || each.runner->running().Look() != each.state) continue;
    stuck.push_back({each.path, each.runner->path(), Now() - each.seen});
  }
  return stuck;
}

bool CycleWatchdog::IsStuck(const CycleRunner& runner, Duration patience) const {
  const std::lock_guard lock(mutex_);
  return std::ranges::any_of(watched_, [&](const Watched& each) {
    const bool takes_long = each.state.element != nullptr && (!each.fired.empty() || Now() - each.seen > patience);
    return each.runner.get() == &runner && takes_long && runner.running().Look() == each.state;
  });
}

}  // namespace runnel
