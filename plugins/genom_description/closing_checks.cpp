#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "plugins/genom_description/component_rules.h"

namespace runnel::genom {

namespace {

using States = std::map<std::string, Codel*, std::less<>>;

// All codels that can run after `from`, and itself. Says by the result whether the end is among what they yield.
bool Reach(const States& states, Codel* from, bool Codel::*mark) {
  std::vector<Codel*> open = {from};
  bool has_end = false;
  from->*mark = true;
  while (!open.empty()) {
    const Codel* codel = open.back();
    open.pop_back();
    for (const Type* event : codel->yields) {
      const auto next = states.find(event->name);
      if (next == states.end()) {
        has_end |= event->name == "ether";
        continue;
      }
      if (next->second->*mark) continue;
      next->second->*mark = true;
      open.push_back(next->second);
    }
  }
  return has_end;
}

}  // namespace

void BuildStateMachine(const std::vector<Codel*>& codels, States& states, Problems& problems) {
  states.clear();
  for (Codel* codel : codels) {
    codel->is_reached_from_start = codel->is_reached_from_stop = false;
    for (const Type* event : codel->triggers) {
      const auto [at, is_new] = states.emplace(event->name, codel);
      if (is_new || at->second == codel) continue;
      problems.Add(codel->place, "two codels run in state '" + event->name + "'",
                   problems.DeclaredAt(at->second->place));
    }
  }
}

void CheckStateMachine(const States& states, bool needs_start, Place place, Problems& problems) {
  const auto start = states.find("start");
  const auto stop = states.find("stop");
  if (needs_start && start == states.end()) {
    problems.Add(place, "no codel runs in state 'start', where each activity begins",
                 "add one: codel<start> NAME() yield ether;");
    return;
  }
  if (start != states.end()) Reach(states, start->second, &Codel::is_reached_from_start);
  if (stop != states.end() && !Reach(states, stop->second, &Codel::is_reached_from_stop)) {
    problems.Add(stop->second->place,
                 "from state 'stop' nothing leads to 'ether', so an interrupted activity never ends",
                 "let it, or what follows it, yield ether");
  }
  std::set<const Codel*> seen;
  for (const auto& [state, codel] : states) {
    if (!codel->is_reached_from_start && !codel->is_reached_from_stop) {
      problems.Add(codel->place, "state '" + state + "' is reached neither from 'start' nor from 'stop'");
    }
    if (!seen.insert(codel).second) continue;
    for (const Type* event : codel->yields) {
      if (event->name == "ether" || states.contains(event->name)) continue;
      problems.Add(codel->place, "codel '" + codel->name + "' yields '" + event->name + "', in which no codel runs",
                   "add one: codel<" + event->name + "> NAME() yield ether;");
    }
  }
}

namespace {

constexpr double kLongest = 1e9;  // s

// In microseconds, as the clock counts.
std::int64_t Microseconds(double seconds) {
  return static_cast<std::int64_t>(std::llround(std::fmin(seconds, kLongest) * 1e6));
}

void CheckDelay(const Task& task, Problems& problems) {
  const Property* delay = Find(task.properties, PropertyKind::kDelay);
  if (delay == nullptr) return;
  const Property* period = Find(task.properties, PropertyKind::kPeriod);
  if (period == nullptr) {
    problems.Add(delay->place, "task '" + task.name + "' has a delay and no period",
                 "say its period, or leave the delay out");
  } else if (delay->number >= period->number) {
    problems.Add(delay->place, "the delay of task '" + task.name + "' is not less than its period",
                 problems.DeclaredAt(period->place));
  }
}

}  // namespace

void CheckTimes(Component& component, Problems& problems) {
  std::int64_t divisor = 1'000'000;
  const Property* rate = Find(component.properties, PropertyKind::kClockRate);
  for (const Task* task : component.tasks) {
    CheckDelay(*task, problems);
    for (const PropertyKind kind : {PropertyKind::kPeriod, PropertyKind::kDelay}) {
      const Property* time = Find(task->properties, kind);
      if (time == nullptr) continue;
      const std::int64_t value = Microseconds(time->number);
      divisor = std::gcd(divisor, value);
      const std::int64_t tick = rate == nullptr ? 0 : Microseconds(rate->number);
      if (tick == 0 || value % tick == 0) continue;
      problems.Add(time->place,
                   "the " + std::string(NameOf(kind)) + " of task '" + task->name +
                       "' is no multiple of the clock rate of '" + component.name + "'",
                   "leave the clock rate out, or: " + problems.DeclaredAt(rate->place));
    }
  }
  component.clock_rate = rate != nullptr && rate->number > 0 ? rate->number : static_cast<double>(divisor) * 1e-6;
}

namespace {

// Those that stand in the headers: what codels run in, or yield.
bool IsUsed(const Component& component, const Type& event) {
  if (event.name == "ether" && event.Is(TypeKind::kEvent)) return true;
  return std::ranges::any_of(component.codels(), [&](const Codel* codel) {
    return std::ranges::find(codel->triggers, &event) != codel->triggers.end() ||
           std::ranges::find(codel->yields, &event) != codel->yields.end();
  });
}

// What the headers in C call like that, nullptr if nothing.
const Type* FindInHeaders(const Component& component, std::string_view name) {
  const auto find = [&](const Scope* scope, std::string_view own) -> const Type* {
    if (scope == nullptr) return nullptr;
    const auto found = scope->types.find(own);
    if (found == scope->types.end()) return nullptr;
    const bool is_event = found->second->Is(TypeKind::kEvent) || found->second->Is(TypeKind::kPauseEvent);
    return !is_event || IsUsed(component, *found->second) ? found->second : nullptr;
  };
  if (!name.starts_with(component.name + "_")) return nullptr;
  name.remove_prefix(component.name.size() + 1);
  if (const Type* found = find(component.scope, name)) return found;
  return name.starts_with("pause_") ? find(component.pause_scope, name.substr(6)) : nullptr;
}

}  // namespace

void WarnOfCodelNames(const Component& component, Problems& problems) {
  if (TextOf(component.properties, PropertyKind::kLanguage, "c") != "c") return;
  std::vector<std::string_view> told;
  for (const Codel* codel : component.codels()) {
    const Type* const found = FindInHeaders(component, codel->name);
    if (found == nullptr || std::ranges::find(told, codel->name) != told.end()) continue;
    told.push_back(codel->name);
    problems.Warn(codel->place,
                  "codel '" + codel->name + "' has the name that " + KindAndName(*found) + " has in the headers in C",
                  "codels do not compile with both; give the codel another name");
  }
}

namespace {

using Source = ParameterSource;

bool IsPrefix(const std::vector<PathStep>& a, const std::vector<PathStep>& b) {
  const std::size_t shared = std::min(a.size(), b.size());
  return std::equal(a.begin(), a.begin() + static_cast<std::ptrdiff_t>(shared), b.begin());
}

bool Reads(const Parameter& parameter, bool is_of_service) {
  // What goes into a service is written into the ids.
  return parameter.direction == (is_of_service ? Direction::kOut : Direction::kIn);
}

bool Conflict(const Parameter& a, const Parameter& b, bool b_is_of_service = false) {
  if (a.source != b.source) return false;
  if (a.source == Source::kPort) return a.port == b.port;
  if (a.source != Source::kIds || !IsPrefix(a.path, b.path)) return false;
  return !Reads(a, false) || !Reads(b, b_is_of_service);
}

bool Conflict(const std::vector<Parameter>& a, const std::vector<Parameter>& b, bool b_is_of_service = false) {
  return std::ranges::any_of(a, [&](const Parameter& one) {
    return std::ranges::any_of(b, [&](const Parameter& other) { return Conflict(one, other, b_is_of_service); });
  });
}

// Codels of one task never overlap; nor do those of the control task, which have none.
bool CanOverlap(const Codel& codel, const Codel& other) {
  if (codel.task == other.task) return false;
  const bool are_activities =
      codel.task != nullptr && codel.service != nullptr && other.task != nullptr && other.service != nullptr;
  // A service starts when what it interrupts has ended.
  return !are_activities || !Interrupts(*other.service, *codel.service);
}

}  // namespace

bool Names(PropertyKind relation, const Service& service, const Service& other) {
  const Property* named = Find(service.properties, relation);
  const bool is_all = relation == PropertyKind::kInterrupts || &service != &other;
  return named != nullptr && std::ranges::any_of(named->texts, [&](const std::string& name) {
           return name == other.name || (name == "all" && is_all);
         });
}

void WarnOfServicesThatNeverStart(const Component& component, Problems& problems) {
  std::set<const Service*> starting;
  const auto may_start = [&](const Service* service) {
    return std::ranges::all_of(component.services, [&](const Service* other) {
      return !Names(PropertyKind::kAfter, *service, *other) ||
             (starting.contains(other) && !Names(PropertyKind::kBefore, *service, *other));
    });
  };
  for (std::size_t before = 1; before != starting.size();) {
    before = starting.size();
    for (const Service* each : component.services) {
      if (may_start(each)) starting.insert(each);
    }
  }
  for (const Service* each : component.services) {
    if (starting.contains(each)) continue;
    problems.Warn(each->place,
                  std::string(NameOf(each->kind)) + " '" + each->name +
                      "' can never start: it is after what cannot come before it",
                  "look at its 'after', and at that of the services there");
  }
}

std::vector<const Codel*> ConflictingCodels(const Codel& codel) {
  std::vector<const Codel*> conflicting;
  for (const Codel* other : codel.component->codels()) {
    if (CanOverlap(codel, *other) && Conflict(codel.parameters, other->parameters)) conflicting.push_back(other);
  }
  return conflicting;
}

std::vector<const Service*> ConflictingServices(const Codel& codel) {
  std::vector<const Service*> conflicting;
  if (codel.task == nullptr) return conflicting;
  for (const Service* service : codel.component->services) {
    if (Conflict(codel.parameters, service->parameters, true)) conflicting.push_back(service);
  }
  return conflicting;
}

std::vector<const Codel*> ConflictingCodels(const Service& service) {
  std::vector<const Codel*> conflicting;
  for (const Codel* codel : service.component->codels()) {
    if (codel->task != nullptr && Conflict(codel->parameters, service.parameters, true)) conflicting.push_back(codel);
  }
  return conflicting;
}

void CheckAsyncCodels(const Component& component, Problems& problems) {
  for (const Codel* codel : component.codels()) {
    if (!codel->is_async) continue;
    const std::string hint = "what it uses is not protected while it runs: copy it in another codel";
    for (const Codel* other : ConflictingCodels(*codel)) {
      // These run before and after all others.
      const bool is_permanent = other->task != nullptr && other->service == nullptr;
      if (is_permanent) {
        const auto start = other->task->states.find("start");
        if (start != other->task->states.end() && start->second == other) continue;
        if (!other->is_reached_from_start) continue;
      }
      problems.Add(codel->place, "async codel '" + codel->name + "' uses what codel '" + other->name + "' uses", hint);
    }
    for (const Service* other : ConflictingServices(*codel)) {
      problems.Add(codel->place, "async codel '" + codel->name + "' uses what attribute '" + other->name + "' uses",
                   hint);
    }
  }
}

}  // namespace runnel::genom
