// What is done when a rule applies.

#include <chrono>
#include <iterator>
#include <thread>

#include "core/base/retry.h"
#include "core/element/attempt.h"
#include "core/paths/path_search.h"
#include "core/plugin/module_type_name.h"
#include "core/port/port.h"
#include "core/types/text_format.h"
#include "plugins/parameters/value_to_save.h"
#include "plugins/structure/element_state.h"
#include "plugins/structure/module_values.h"
#include "plugins/structure/value_by_hand.h"
#include "plugins/supervision/supervisor_shared.h"

namespace runnel {

namespace {

// What is to be safe and finds no memory has not been done, and is due until it is.
template <typename Act>
Result<void> AttemptOrThrow(const Act& act) {
  try {
    return act();
  } catch (const std::bad_alloc&) {
    throw;
  } catch (...) {
    return CaughtError();
  }
}

// Of what finds no memory nothing has been done. It may be there in a moment.
template <typename Act>
auto WithMemory(const Act& act) {
  constexpr int kAttempts = 1000;
  for (int attempt = 1;; ++attempt) {
    try {
      return act();
    } catch (const std::bad_alloc&) {
      if (attempt == kAttempts) throw;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
}

// Kept with a module that a rule has put in the place of another: what had been set at that, and its type.
struct ReplacedByRule final : Annotation {
  explicit ReplacedByRule(const ReplaceModule& back) : type(back.type), state(back.state) {}
  [[nodiscard]] std::unique_ptr<Annotation> ForReplacement() const override {
    return std::make_unique<ReplacedByRule>(*this);
  }
  [[nodiscard]] std::unique_ptr<Annotation> ForCopy() const override { return nullptr; }
  std::string type;
  GivenState state;
};

// A module that comes back gets what has been set where the one of the rule has no place for it: marks, limits, a block.
void GiveBack(Runtime& runtime, ChangeSet& changes) {
  const std::lock_guard lock(runtime.structure_mutex());
  for (Change& each : changes) {
    auto* const replace = std::get_if<ReplaceModule>(&each);
    const auto module = replace != nullptr ? PathSearch(runtime).Find(replace->path) : Error{};
    const auto* const replaced = module ? (*module)->FindAnnotation<ReplacedByRule>() : nullptr;
    if (replaced != nullptr && replaced->type == replace->type) replace->state = replaced->state;
  }
}

}  // namespace

void Supervisor::Shared::VisitHeld(const Port& port,
                                   const std::function<void(KnownRule& rule, std::size_t number)>& visit) {
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

// Under the structure lock. What could not be released is left, and due at the next look.
Result<void> Supervisor::Shared::ReleaseEach(std::list<std::string>& ports, Time now) {
  Result<void> done;
  for (auto port = ports.begin(); port != ports.end();) {
    bool is_released = false;
    EachForItself().Do([&] {
      auto released = Release(*port, now);
      is_released = released.has_value();
      if (!released && done) done = std::move(released);
    });
    port = is_released ? ports.erase(port) : std::next(port);
  }
  return done;
}

// Files that are saved until it is taken back have what people have made there. What a rule before has made is none of
// theirs. `noted`: by changes and elements what an attempt before has kept.
void Supervisor::Shared::NotePassing(KnownRule& rule, Which which, ChangeSet back,
                                     std::vector<std::pair<std::size_t, std::uint64_t>>& noted) {
  std::size_t number = 0;
  const std::lock_guard lock(runtime.structure_mutex());
  const auto note = [&, this](const std::string& path, const std::string& before, PathKind kind,
                              MadeByRule::Lacking lacking = {}) -> FrameworkElement* {
    const auto found = PathSearch(runtime).Find(path, kind);
    if (!found) return nullptr;
    const auto* const parameter = dynamic_cast<const Configurable*>(*found);
    std::string now = parameter != nullptr ? parameter->ToText() : FindModuleType(**found);
    const std::pair mark(number, (*found)->id());
    if (std::ranges::find(noted, mark) != noted.end()) return *found;
    noted.reserve(noted.size() + 1);
    (*found)->Annotate(
        std::make_unique<MadeByRule>(MadeByRule::Before(**found, before), std::move(now), std::move(lacking)));
    noted.push_back(mark);
    return *found;
  };
  for (const Change& each : back) {
    ++number;
    if (const auto* const set = std::get_if<SetParameter>(&each)) note(set->path, set->value, PathKind::kParameter);
    const auto* const replace = std::get_if<ReplaceModule>(&each);
    if (replace == nullptr) continue;
    const auto module = PathSearch(runtime).Find(replace->path);
    const auto* const made = module ? (*module)->FindAnnotation<MadeByRule>() : nullptr;
    auto lacking = made != nullptr && made->now == replace->type ? made->lacking : MadeByRule::Lacking();
    for (const internal::ParameterRecord& one : *replace->parameters) {
      if (one.is_of_part || !(one.values.own.is_set() || one.is_named)) continue;
      const std::string value = runnel::ToText(*one.values.type, one.values.own.value.get());
      const bool is_there = note(replace->path + "/" + one.name, value, PathKind::kParameter) != nullptr;
      const auto before = replace->state->noted().Find(one.path);
      if (is_there || !before) continue;
      const std::string* const loaded = LoadedValue::Of(**before);
      lacking[one.name] = {MadeByRule::Before(**before, value),
                           loaded != nullptr ? std::optional(*loaded) : std::nullopt};
    }
    for (const auto& [name, value] : lacking) {
      FrameworkElement* const again = note(replace->path + "/" + name, value.first, PathKind::kParameter);
      if (again != nullptr && value.second) again->Annotate(std::make_unique<LoadedValue>(*value.second));
    }
    note(replace->path, replace->type, PathKind::kElement, std::move(lacking));
    const auto* const replaced = module ? (*module)->FindAnnotation<ReplacedByRule>() : nullptr;
    const bool is_first = replaced == nullptr || replaced->type == replace->type;
    if (module && is_first) (*module)->Annotate(std::make_unique<ReplacedByRule>(*replace));
  }
  std::erase_if(back, [](const Change& each) {
    return !std::holds_alternative<ConnectPorts>(each) && !std::holds_alternative<DisconnectPorts>(each);
  });
  std::erase(switched, &rule);
  rule.back.changes.clear();
  if (which != &SupervisionRule::reaction) return;
  rule.back.changes = std::move(back);
  switched.push_back(&rule);
}

void Supervisor::Shared::Beside(std::function<void()> act, bool is_long) {
  {
    const std::lock_guard lock(mutex);
    if (is_real() && (is_long || !acts.empty())) acts.push_back(std::exchange(act, nullptr));
  }
  if (act) return act();
  try {
    beside.Ask();
  } catch (...) {  // Watch() asks, too
  }
}

void Supervisor::Shared::WorkBeside() {
  EachForItself parts;
  for (std::unique_lock lock(mutex); !acts.empty();) {
    lock.unlock();
    parts.Do(acts.front());
    lock.lock();
    std::list<std::function<void()>> done;
    done.splice(done.end(), acts, acts.begin());
    lock.unlock();
    done.clear();  // with all that it holds, which may want other locks
    lock.lock();
  }
  parts.Do([&] { FollowPausesAgain(); });
  parts.Do([&] { ServeRequests(runtime.clock().Now()); });
  parts.End();
}

// Safe values come first, and also if the rest fails.
Result<void> Supervisor::Shared::PublishAll(KnownRule& rule, Which which, const Reaction& reaction) {
  Result<void> done;
  for (std::size_t i = 0; i < reaction.published.size(); ++i) {
    const auto note = [&](const Port& port) {
      // What somebody has released no rule holds any more.
      if (!port.is_set_by_hand(Port::Setter::kRule))
        VisitHeld(port, [](KnownRule& each, std::size_t number) { each.holds[number] = false; });
      if (which != &SupervisionRule::reaction) return;
      rule.holds.resize(reaction.published.size());
      rule.holds[i] = true;
    };
    auto published = Publish(reaction.published[i], note);
    if (which == &SupervisionRule::reaction) {
      const std::lock_guard lock(runtime.structure_mutex());
      rule.misses.resize(reaction.published.size());
      rule.misses[i] = !published;
    }
    if (!published && done) done = published;
  }
  return done;
}

void Supervisor::Shared::PublishMissed(Time now) {
  EachForItself parts;
  for (const auto& rule : rules) {
    for (std::size_t i = 0; i < rule->misses.size(); ++i) {
      const SafeValue& safe = rule->reaction.published[i];
      if (!rule->misses[i] || !PathSearch(runtime).FindPort(safe.port, PathKind::kElement)) continue;
      parts.Do([&] {
        rule->holds.resize(rule->misses.size());
        const auto done = AttemptOrThrow([&] { return Publish(safe); });
        rule->misses[i] = false;
        rule->holds[i] = done.has_value();
        Note({safe.port,
              "is there again; what a rule wants there meanwhile " +
                  (done ? "is set" : "cannot be set: " + done.error().ToString()),
              now, !done});
      });
    }
  }
  parts.End();
}

Result<void> Supervisor::Shared::CarryOut(KnownRule& rule, Which which, Reaction& reaction, Time now) {
  std::list<std::string> left = std::move(reaction.released);
  auto done = Attempt([&]() -> Result<void> {
    if (reaction.changes.empty()) return {};
    WithMemory([&] { GiveBack(runtime, reaction.changes); });
    const auto back = WithMemory([&] { return perform(reaction.changes); });
    if (!back) return back.error();
    std::vector<std::pair<std::size_t, std::uint64_t>> noted;
    if (Retry([&] { NotePassing(rule, which, *back, noted); })) return {};
    return Error{.message = "files will have its values"};
  });
  if (left.empty()) return done;
  const std::lock_guard lock(runtime.structure_mutex());
  auto released = ReleaseEach(left, now);
  later.splice(later.end(), left);
  if (done) done = std::move(released);
  return done;
}

// What can be said of a reaction that failed is told; the application runs on as it is, and ends if it was to end.
void Supervisor::Shared::React(KnownRule& rule, Which which, const std::string& path, const std::string& why, Time now,
                               bool is_recovery, Where where) try {
  const Reaction& given = rule.*which;
  Reaction reaction{.ends_run = given.ends_run};
  // What only ends the run waits for no lock: the module that is stuck may have it.
  if (!given.published.empty() || !given.released.empty() || !given.changes.empty()) {
    const std::lock_guard lock(runtime.structure_mutex());
    reaction = given;  // as it is now, for paths change under the lock
    if (which == &SupervisionRule::otherwise) rule.holds.clear(), rule.misses.clear();
  }
  const auto published = AttemptOrThrow([&] { return PublishAll(rule, which, reaction); });
  const bool is_long = !reaction.changes.empty();
  const bool is_short = !is_long && reaction.released.empty();  // it waits behind no other one
  auto rest = [this, &rule, which, published, reaction = std::move(reaction),
               notice = Notice{path, why, now, false, is_recovery}]() mutable {
    const auto carried_out = Attempt([&] { return CarryOut(rule, which, reaction, notice.time); });
    const Result<void>& done = published ? carried_out : published;
    if (reaction.ends_run) scheduler.EndForFault();
    // It is done by then, and not done again where there is no memory to tell of it.
    EachForItself().Do([&] {
      notice.is_failure = !done;
      if (!done) {
        notice.message += "; what was to be done about it failed: " + done.error().ToString();
      } else if (!reaction.description.empty()) {
        notice.message += "; " + reaction.description;
      }
      if (reaction.ends_run) notice.message += "; ends the run";
      Note(std::move(notice));
    });
  };
  if (where == Where::kHere || is_short) return rest();
  Beside(std::move(rest), is_long);
} catch (...) {  // no memory: it is due, but for the end of the run, which needs none
  if ((rule.*which).ends_run) scheduler.EndForFault();
  throw;
}

}  // namespace runnel
