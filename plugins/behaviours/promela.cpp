#include "plugins/behaviours/promela.h"

#include <algorithm>
#include <functional>

#include <fmt/format.h>

#include "plugins/model_checker/spin.h"

namespace runnel {

namespace {

constexpr int kPatience = 3;  // cycles

using PlaceName = std::function<std::string(std::size_t place)>;
std::string Joined(const std::vector<std::size_t>& places, const PlaceName& name, const char* separator,
                   const char* none) {
  std::string text;
  for (const std::size_t each : places) text += (text.empty() ? "" : separator) + name(each);
  return text.empty() ? none : "(" + text + ")";
}

std::string Active(std::size_t place) { return fmt::format("active_{}", place); }
std::string NotActive(std::size_t place) { return "!" + Active(place); }

bool Has(const std::vector<std::size_t>& places, std::size_t place) {
  return std::ranges::find(places, place) != places.end();
}

// Of the behaviours at `places`, as the one at `at` sees them: late ones as they were in the cycle before, those of other threads
// as they were or are.
std::string Seen(const BehaviourNetwork& network, std::size_t at, const std::vector<std::size_t>& places,
                 const char* before, const char* separator, const char* none) {
  const NetworkNode& node = network.nodes[at];
  const auto name = [&](std::size_t each) {
    if (Has(node.elsewhere, each)) return fmt::format("{}seen_{}_{}", before, at, each);
    return fmt::format("{}{}_{}", before, Has(node.late, each) ? "before" : "active", each);
  };
  return Joined(places, name, separator, none);
}

// Whether somebody sees what it was before.
bool IsSeenLate(const BehaviourNetwork& network, std::size_t place) {
  return std::ranges::any_of(
      network.nodes, [&](const NetworkNode& node) { return Has(node.late, place) || Has(node.elsewhere, place); });
}

bool HasWill(const NetworkNode& node) { return node.needs_any.empty(); }

std::string Stimulated(const BehaviourNetwork& network, std::size_t at) {
  const NetworkNode& node = network.nodes[at];
  if (node.mode != StimulationMode::kAuto) return node.mode == StimulationMode::kEnabled ? "true" : "false";
  if (node.has_foreign_stimulation) return "true";  // whether it is, is part of whether it wants to
  return Seen(network, at, node.stimulators, "", " || ", "false");
}

std::string Declarations(const BehaviourNetwork& network, bool is_fair) {
  std::string text;
  for (std::size_t i = 0; i < network.nodes.size(); ++i) {
    text += fmt::format("bool active_{};  /* {} */\n", i, network.nodes[i].name);
    if (IsSeenLate(network, i)) text += fmt::format("bool before_{};\n", i);
    for (const std::size_t each : network.nodes[i].elsewhere) text += fmt::format("bool seen_{}_{};\n", i, each);
    if (!HasWill(network.nodes[i])) continue;
    text += fmt::format("bool wants_{};\n", i);
    if (is_fair) text += fmt::format("byte same_{};\n", i);
  }
  return text;
}

std::string Choice(std::size_t i, bool is_fair) {
  if (!is_fair) return fmt::format("      if :: wants_{0} = false :: wants_{0} = true fi;\n", i);
  return fmt::format(
      "      if\n"
      "      :: wants_{0} && !active_{0}\n"
      "      :: (!wants_{0} || active_{0}) && same_{0} < {1} -> same_{0} = same_{0} + 1\n"
      "      :: (!wants_{0} || active_{0}) -> wants_{0} = !wants_{0}; same_{0} = 1\n"
      "      fi;\n",
      i, kPatience);
}

std::string OneCycle(const BehaviourNetwork& network, bool is_fair) {
  std::string text;
  for (std::size_t i = 0; i < network.nodes.size(); ++i) {
    if (IsSeenLate(network, i)) text += fmt::format("      before_{0} = active_{0};\n", i);
    if (HasWill(network.nodes[i])) text += Choice(i, is_fair);
  }
  std::string format, arguments;
  for (std::size_t i = 0; i < network.nodes.size(); ++i) {
    const NetworkNode& node = network.nodes[i];
    for (const std::size_t each : node.elsewhere) {
      text += fmt::format("      if :: seen_{0}_{1} = before_{1} :: seen_{0}_{1} = active_{1} fi;\n", i, each);
    }
    text += fmt::format(
        "      active_{} = {} && {} && {} && {};\n", i, Stimulated(network, i),
        Seen(network, i, node.inhibitors, "!", " && ", "true"), Seen(network, i, node.needs_all, "", " && ", "true"),
        HasWill(node) ? fmt::format("wants_{}", i) : Seen(network, i, node.needs_any, "", " || ", "false"));
    format += "%d";
    arguments += fmt::format(", active_{}", i);
  }
  return text + "      printf(\"runnel " + format + "\\n\"" + arguments + ")";
}

std::string Formula(const NetworkProperty& property) {
  const std::string goal = Joined(property.active, Active, " && ", "true");
  if (property.others.empty()) return "<> " + goal;
  return "[] (" + Joined(property.others, Active, " && ", "true") + " -> <> " + goal + ")";
}

// A line has "0101…", a digit for each behaviour.
Counterexample ReadRun(const SpinAnswer& answer, std::size_t behaviours) {
  Counterexample run;
  run.repeats_from = answer.repeats_from;
  for (const std::string& line : answer.run) {
    std::vector<bool> active;
    for (std::size_t i = 0; i < std::min(behaviours, line.size()); ++i) active.push_back(line[i] == '1');
    run.cycles.push_back(std::move(active));
  }
  return run;
}

}  // namespace

std::string PromelaText(const BehaviourNetwork& network, const NetworkProperty* property) {
  const bool is_fair = property != nullptr && property->kind == NetworkProperty::Kind::kEventually;
  std::string text = "/* A network of behaviours. */\n" + Declarations(network, is_fair) +
                     "\nactive proctype cycles() {\n  do\n  :: atomic {\n" + OneCycle(network, is_fair);
  if (property != nullptr && !is_fair) {
    text += ";\n      assert(!(" + Joined(property->active, Active, " && ", "true") + " && " +
            Joined(property->others, NotActive, " && ", "true") + "))";
  }
  text += "\n    }\n  od\n}\n";
  if (is_fair) text += "\nltl property { " + Formula(*property) + " }\n";
  return text;
}

Result<SpinVerdict> CheckBySpin(const BehaviourNetwork& network, const NetworkProperty& property) {
  const bool is_never = property.kind == NetworkProperty::Kind::kNever;
  SpinSearch search;
  search.options = is_never ? std::vector<std::string>{"-bfs"} : std::vector<std::string>{"-a", "-m1000000"};
  const auto answer = RunSpin(PromelaText(network, &property), search);
  if (!answer) return answer.error();
  if (answer->holds) return SpinVerdict{.holds = true};
  return SpinVerdict{.holds = false, .counterexample = ReadRun(*answer, network.nodes.size())};
}

std::string TellCounterexample(const BehaviourNetwork& network, const Counterexample& counterexample) {
  std::string text;
  for (std::size_t cycle = 0; cycle < counterexample.cycles.size(); ++cycle) {
    const auto& active = counterexample.cycles[cycle];
    const bool begins_loop = cycle == counterexample.repeats_from;
    if (cycle > 0 && !begins_loop && active == counterexample.cycles[cycle - 1]) continue;
    std::string names;
    for (std::size_t i = 0; i < active.size(); ++i) {
      if (active[i]) names += (names.empty() ? "" : ", ") + network.nodes[i].name;
    }
    text += (text.empty() ? "" : "; then ") + std::string(begins_loop ? "over and over: " : "") +
            (names.empty() ? "nobody" : names);
  }
  return text;
}

}  // namespace runnel
