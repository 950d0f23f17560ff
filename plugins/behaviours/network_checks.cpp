#include <algorithm>
#include <deque>
#include <optional>
#include <set>
#include <utility>

#include "plugins/behaviours/network.h"

namespace runnel {

namespace {

using Set = std::set<std::size_t>;

// Who is active whenever this one is, itself included: by stimulation from one alone, or as it needs them.
Set ActiveWith(const BehaviourNetwork& network, std::size_t place) {
  Set active;
  std::deque<std::size_t> waiting{place};
  while (!waiting.empty()) {
    const std::size_t next = waiting.front();
    waiting.pop_front();
    if (!active.insert(next).second) continue;
    const NetworkNode& node = network.nodes[next];
    waiting.insert(waiting.end(), node.needs_all.begin(), node.needs_all.end());
    if (node.needs_any.size() == 1) waiting.push_back(node.needs_any.front());
    if (node.stimulators.size() == 1 && !node.has_foreign_stimulation) waiting.push_back(node.stimulators.front());
  }
  return active;
}

// One of `inhibited` that one of `active` inhibits.
std::optional<std::pair<std::size_t, std::size_t>> FindInhibition(const BehaviourNetwork& network, const Set& active,
                                                                  const Set& inhibited) {
  for (const std::size_t each : inhibited) {
    for (const std::size_t by : network.nodes[each].inhibitors) {
      if (active.contains(by)) return std::pair(by, each);
    }
  }
  return std::nullopt;
}

bool IsAnyOf(const std::vector<std::size_t>& places, const std::vector<bool>& can_be) {
  return std::ranges::any_of(places, [&](std::size_t each) { return can_be[each]; });
}

// Whether each may be active, as far as stimulation goes: the largest set that holds itself up from what is enabled.
std::vector<bool> CanBeStimulated(const BehaviourNetwork& network) {
  std::vector<bool> can_be(network.nodes.size(), false);
  for (bool has_changed = true; has_changed;) {
    has_changed = false;
    for (std::size_t i = 0; i < network.nodes.size(); ++i) {
      const NetworkNode& node = network.nodes[i];
      const bool is_stimulated =
          node.mode == StimulationMode::kEnabled ||
          (node.mode == StimulationMode::kAuto && (node.has_foreign_stimulation || IsAnyOf(node.stimulators, can_be)));
      const bool has_any = node.needs_any.empty() || IsAnyOf(node.needs_any, can_be);
      const bool has_all = std::ranges::all_of(node.needs_all, [&](std::size_t each) { return can_be[each]; });
      if (can_be[i] || !is_stimulated || !has_any || !has_all) continue;
      can_be[i] = has_changed = true;
    }
  }
  return can_be;
}

std::string NamesOf(const BehaviourNetwork& network, const std::vector<std::size_t>& places) {
  std::string names;
  for (const std::size_t each : places) names += (names.empty() ? "" : ", ") + network.nodes[each].name;
  return names;
}

std::string WhyNotStimulated(const BehaviourNetwork& network, const NetworkNode& node) {
  if (node.mode == StimulationMode::kAuto && node.stimulators.empty()) return "nothing stimulates it";
  if (node.mode == StimulationMode::kAuto) {
    return "only " + NamesOf(network, node.stimulators) + " would stimulate it, which can never be active";
  }
  return "those whose activity it needs can never be active";
}

// Large networks may have more loops than anybody can wait for.
constexpr int kMostSteps = 200'000;

/// From who decides to who depends.
struct Edge {
  std::size_t to;
  bool inhibits;
  bool is_late;
  bool is_from_elsewhere;
};
using Edges = std::vector<std::vector<Edge>>;

Edges EdgesOf(const BehaviourNetwork& network) {
  Edges edges(network.nodes.size());
  for (std::size_t to = 0; to < network.nodes.size(); ++to) {
    const NetworkNode& node = network.nodes[to];
    const auto add = [&](std::size_t from, bool inhibits) {
      edges[from].push_back({to, inhibits, std::ranges::find(node.late, from) != node.late.end(),
                             std::ranges::find(node.elsewhere, from) != node.elsewhere.end()});
    };
    for (const std::size_t from : node.inhibitors) add(from, true);
    for (const auto* const list : {&node.stimulators, &node.needs_all, &node.needs_any}) {
      for (const std::size_t from : *list) add(from, false);
    }
  }
  return edges;
}

/// Goes through all loops that pass no behaviour twice, and tells those that can oscillate, one for the same behaviours.
class LoopSearch {
 public:
  explicit LoopSearch(const BehaviourNetwork& network) : network_(network), edges_(EdgesOf(network)) {}

  std::vector<NetworkFlaw> Find() {
    // From each, through those that come after it: so each loop is found at its first one only. The shortest come first.
    for (std::size_t most = 1; most <= edges_.size() && steps_ < kMostSteps; ++most) {
      for (start_ = 0; start_ < edges_.size(); ++start_) Follow(start_, most);
    }
    return std::move(flaws_);
  }

 private:
  void Follow(std::size_t at, std::size_t most) {
    if (++steps_ > kMostSteps) return;
    for (const Edge& edge : edges_[at]) {
      const bool is_closed = edge.to == start_;
      if (edge.to < start_ || is_closed != (path_.size() + 1 == most) || (!is_closed && IsOnPath(edge.to))) continue;
      path_.push_back(&edge);
      is_closed ? Judge() : Follow(edge.to, most);
      path_.pop_back();
    }
  }
  [[nodiscard]] bool IsOnPath(std::size_t node) const {
    return std::ranges::any_of(path_, [node](const Edge* each) { return each->to == node; });
  }
  void Judge() {
    const auto inhibitions = std::ranges::count_if(path_, &Edge::inhibits);
    const auto late = MostLate();
    const bool is_odd = inhibitions % 2 == 1;
    if (!is_odd && (inhibitions == 0 || late < 2)) return;
    std::set<std::size_t> behaviours;
    for (const Edge* each : path_) behaviours.insert(each->to);
    if (!told_.insert(std::move(behaviours)).second) return;
    flaws_.push_back(is_odd ? NetworkFlaw{network_.nodes[start_].behaviour->path(),
                                          "can oscillate, for its own activity inhibits it in the end: " + Text(),
                                          "take one of these connections away"}
                            : NetworkFlaw{network_.nodes[start_].behaviour->path(),
                                          "can oscillate, for all go on and off together: " + Text() + "; " +
                                              std::to_string(late) + " of these can come a cycle late",
                                          "let one connection of the loop be late, and have one thread run them all"});
  }
  // How many of the loop's connections can be a cycle late.
  [[nodiscard]] std::ptrdiff_t MostLate() const {
    const auto from_elsewhere = std::ranges::count_if(path_, &Edge::is_from_elsewhere);
    const auto late = std::ranges::count_if(path_, &Edge::is_late);
    return from_elsewhere > 0 ? from_elsewhere + late : std::min(late, std::ssize(path_) - 1);
  }
  [[nodiscard]] std::string Text() const {
    std::string text = network_.nodes[start_].name;
    for (const Edge* each : path_) {
      text += (each->inhibits ? " inhibits " : " activates ") + network_.nodes[each->to].name;
      if (each != path_.back()) text += ", which";
    }
    return text;
  }

  const BehaviourNetwork& network_;
  const Edges edges_;
  std::size_t start_ = 0;
  std::vector<const Edge*> path_;
  std::set<std::set<std::size_t>> told_;
  std::vector<NetworkFlaw> flaws_;
  int steps_ = 0;
};

}  // namespace

std::vector<NetworkFlaw> FindUnreachable(const BehaviourNetwork& network) {
  std::vector<NetworkFlaw> flaws;
  const std::vector<bool> can_be = CanBeStimulated(network);
  for (std::size_t i = 0; i < network.nodes.size(); ++i) {
    const NetworkNode& node = network.nodes[i];
    if (node.mode == StimulationMode::kDisabled) continue;  // as somebody wants it
    if (!can_be[i]) {
      flaws.push_back({node.behaviour->path(), "can never be active: " + WhyNotStimulated(network, node),
                       "connect its stimulation, or set stimulation_mode to enabled"});
      continue;
    }
    const Set with = ActiveWith(network, i);
    const auto inhibition = FindInhibition(network, with, with);
    if (!inhibition) continue;
    const auto& [by, who] = *inhibition;
    flaws.push_back({node.behaviour->path(),
                     "can never be fully active: " + network.nodes[by].name +
                         ", without which it is not active, inhibits " +
                         (who == i ? "it" : network.nodes[who].name + ", without which it is not, either"),
                     "take one of the two connections away"});
  }
  return flaws;
}

std::vector<NetworkFlaw> FindConflicts(const BehaviourNetwork& network) {
  std::vector<NetworkFlaw> flaws;
  const std::vector<bool> can_be = CanBeStimulated(network);
  for (const SharedActuator& actuator : network.shared) {
    for (std::size_t i = 0; i < actuator.behaviours.size(); ++i) {
      for (std::size_t k = i + 1; k < actuator.behaviours.size(); ++k) {
        const std::size_t one = actuator.behaviours[i], other = actuator.behaviours[k];
        if (!can_be[one] || !can_be[other]) continue;
        const Set with_one = ActiveWith(network, one), with_other = ActiveWith(network, other);
        if (FindInhibition(network, with_one, with_other) || FindInhibition(network, with_other, with_one)) continue;
        flaws.push_back({actuator.path,
                         network.nodes[one].name + " and " + network.nodes[other].name +
                             " command it, and can be active at once without a fusion",
                         "connect both with a behaviours/fusion, and that with it"});
      }
    }
  }
  return flaws;
}

// Loops of a network in which activities come and go without end.

std::vector<NetworkFlaw> FindOscillations(const BehaviourNetwork& network) { return LoopSearch(network).Find(); }

}  // namespace runnel
