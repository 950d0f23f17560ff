#include "plugins/behaviours/spin.h"

#include <algorithm>

#include "plugins/model_checker/spin.h"

namespace runnel {

namespace {

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
