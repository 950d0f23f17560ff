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
    problems.Add(stop->second->place, "from state 'stop' nothing leads to 'ether', so an interrupted activity never ends",
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

}  // namespace runnel::genom
