// Loops of a network in which activities come and go without end.

#include <algorithm>
#include <set>

#include "plugins/behaviours/network.h"

namespace runnel {

namespace {

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

std::vector<NetworkFlaw> FindOscillations(const BehaviourNetwork& network) { return LoopSearch(network).Find(); }

}  // namespace runnel
