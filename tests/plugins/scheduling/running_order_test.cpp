// The order that is kept while tasks and connections come and go, against the rules carried out as
// they are written, and against orders made anew.

#include "plugins/scheduling/internal/running_order.h"

#include <algorithm>
#include <deque>
#include <map>
#include <random>
#include <set>

#include <gmock/gmock.h>

namespace runnel::internal {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

// Two words that stand for the ports of a connection; nobody looks at what they point to.
PortPair Pair(int number) {
  static const std::vector<char> places(100000);
  const auto* const at = places.data() + 8 * number;
  return {reinterpret_cast<const Port*>(at), reinterpret_cast<const Port*>(at + 4)};
}

using Edge = std::pair<std::size_t, std::size_t>;

/// Tasks by number, and what connects them; can be brought into a RunningOrder, whole or bit by bit.
struct Graph {
  std::vector<Phase> phases;
  std::vector<std::uint64_t> serials;
  std::set<Edge> edges;

  [[nodiscard]] auto Key(std::size_t task) const {
    return std::tuple(phases[task], serials[task], task);
  }
  [[nodiscard]] bool IsFeedback(const Edge& edge) const {
    return phases[edge.first] == Phase::kControl && phases[edge.second] == Phase::kSense;
  }
};

std::set<Edge> CutsOf(const RunningOrder& order, const std::deque<OrderedTask>& tasks) {
  std::set<Edge> cuts;
  const auto index = [&](const OrderedTask* task) {
    return static_cast<std::size_t>(
        std::ranges::find_if(tasks, [&](const auto& each) { return &each == task; }) -
        tasks.begin());
  };
  for (const Dependency* each : order.Cuts()) cuts.emplace(index(each->from), index(each->to));
  return cuts;
}

std::vector<std::size_t> OrderOf(const RunningOrder& order, const std::deque<OrderedTask>& tasks) {
  std::map<const OrderedTask*, std::size_t> index;
  for (std::size_t i = 0; i < tasks.size(); ++i) index[&tasks[i]] = i;
  std::vector<std::size_t> result;
  for (const auto& block : order.tasks().blocks()) {
    for (const OrderedTask* each : block->items) result.push_back(index.at(each));
  }
  return result;
}

struct Sorted {
  std::vector<std::size_t> order;
  std::set<Edge> cuts;
};

/// Rules 1 to 4 of OrderTasks(), word by word and as slow as they come.
class ByTheRules {
 public:
  explicit ByTheRules(const Graph& graph) : graph_(graph), before_(graph.phases.size()) {
    for (const Edge& edge : graph.edges) {
      if (graph.IsFeedback(edge)) continue;
      if (edge.first == edge.second) {
        result_.cuts.insert(edge);
      } else {
        before_[edge.second].insert(edge.first);
      }
    }
    for (std::size_t a = 0; a < before_.size(); ++a) {
      for (std::size_t b = 0; b < before_.size(); ++b) {
        if (graph.serials[a] == graph.serials[b] && graph.Key(a) < graph.Key(b))
          before_[b].insert(a);
      }
    }
    for (std::size_t i = 0; i < before_.size(); ++i) left_.push_back(i);
    std::ranges::sort(left_, {}, [&](std::size_t task) { return graph.Key(task); });
  }

  Sorted Sort() {
    while (!left_.empty()) {
      auto next = std::ranges::find_if(left_, [&](auto task) { return before_[task].empty(); });
      if (next == left_.end()) {
        next = std::ranges::find_if(left_, [&](auto task) { return IsThePlaceToCut(task); });
        for (const std::size_t late : before_[*next]) result_.cuts.emplace(late, *next);
      }
      const std::size_t task = *next;
      left_.erase(next);
      result_.order.push_back(task);
      for (auto& waiting : before_) waiting.erase(task);
    }
    return result_;
  }

 private:
  [[nodiscard]] bool IsThePlaceToCut(std::size_t task) const {
    const bool waits_for_its_element = std::ranges::any_of(before_[task], [&](std::size_t each) {
      return graph_.serials[each] == graph_.serials[task];
    });
    return !waits_for_its_element && std::ranges::all_of(Upstream(task), [&](std::size_t each) {
      return Upstream(each).contains(task);
    });
  }
  [[nodiscard]] std::set<std::size_t> Upstream(std::size_t task) const {
    std::set<std::size_t> found;
    std::vector<std::size_t> open(before_[task].begin(), before_[task].end());
    while (!open.empty()) {
      const std::size_t each = open.back();
      open.pop_back();
      if (!found.insert(each).second) continue;
      open.insert(open.end(), before_[each].begin(), before_[each].end());
    }
    return found;
  }

  const Graph& graph_;
  std::vector<std::set<std::size_t>> before_;
  std::vector<std::size_t> left_;
  Sorted result_;
};

void Fill(OrderedTask& task, const Graph& graph, std::size_t number) {
  task.phase = graph.phases[number];
  task.serial = graph.serials[number];
  task.number = number;
}

void ConnectPhases(std::deque<OrderedTask>& tasks, RunningOrder& order) {
  for (OrderedTask& a : tasks) {
    for (OrderedTask& b : tasks) {
      if (a.serial == b.serial && a.key() < b.key()) order.KeepPhases(a, b);
    }
  }
}

Sorted Anew(const Graph& graph) {
  std::deque<OrderedTask> tasks(graph.phases.size());
  RunningOrder order;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    Fill(tasks[i], graph, i);
    order.Add(tasks[i]);
  }
  ConnectPhases(tasks, order);
  for (const Edge& edge : graph.edges) {
    order.Connect(tasks[edge.first], tasks[edge.second], Pair(0));
  }
  order.Sort();
  return {OrderOf(order, tasks), CutsOf(order, tasks)};
}

Graph RandomGraph(std::mt19937& random, std::size_t tasks, std::size_t edges) {
  Graph graph;
  std::uint64_t serial = 0;
  for (std::size_t i = 0; i < tasks; ++i) {
    // Now and then an element with a sense and a control task.
    const bool is_second = i > 0 && graph.phases[i - 1] == Phase::kSense;
    if (!is_second) ++serial;
    const bool is_first = !is_second && random() % 4 == 0 && i + 1 < tasks;
    graph.phases.push_back(is_second ? Phase::kControl : is_first ? Phase::kSense : Phase::kUpdate);
    graph.serials.push_back(serial);
  }
  for (std::size_t i = 0; i < edges; ++i) graph.edges.emplace(random() % tasks, random() % tasks);
  return graph;
}

TEST(RunningOrderTest, IsThatOfTheRules) {
  std::mt19937 random(1);
  for (int round = 0; round < 400; ++round) {
    const std::size_t tasks = 1 + random() % 14;
    const Graph graph = RandomGraph(random, tasks, random() % (2 * tasks));
    const Sorted expected = ByTheRules(graph).Sort();
    const Sorted sorted = Anew(graph);
    ASSERT_EQ(sorted.order, expected.order) << "round " << round;
    ASSERT_EQ(sorted.cuts, expected.cuts) << "round " << round;
  }
}

/// A graph and an order that changes with it.
struct Living {
  explicit Living(Graph start) : graph(std::move(start)), tasks(graph.phases.size()) {
    for (std::size_t i = 0; i < tasks.size(); ++i) {
      Fill(tasks[i], graph, i);
      order.Add(tasks[i]);
    }
    ConnectPhases(tasks, order);
    for (const Edge& edge : graph.edges) {
      order.Connect(tasks[edge.first], tasks[edge.second], Pair(0));
    }
    order.Sort();
  }
  void Toggle(const Edge& edge) {
    OrderedTask& from = tasks[edge.first];
    OrderedTask& to = tasks[edge.second];
    if (graph.edges.erase(edge) > 0) return order.Disconnect(from, to, Pair(0));
    graph.edges.insert(edge);
    order.Connect(from, to, Pair(0));
  }
  // All tasks of its element go, and come back without their connections.
  void Replace(std::size_t task) {
    std::vector<std::size_t> own;
    for (std::size_t i = 0; i < tasks.size(); ++i) {
      if (graph.serials[i] == graph.serials[task]) own.push_back(i);
    }
    for (const std::size_t each : own) {
      order.Remove(tasks[each]);
      std::erase_if(graph.edges,
                    [&](const Edge& edge) { return edge.first == each || edge.second == each; });
    }
    for (const std::size_t each : own) order.Add(tasks[each]);
    for (std::size_t i = 1; i < own.size(); ++i) {
      order.KeepPhases(tasks[own[i - 1]], tasks[own[i]]);
    }
  }
  void Check(int round) const {
    const std::vector<std::size_t> sorted = OrderOf(order, tasks);
    ASSERT_EQ(sorted.size(), tasks.size());
    const std::set<Edge> cuts = CutsOf(order, tasks);
    ASSERT_EQ(cuts, Anew(graph).cuts) << "round " << round;
    std::vector<std::size_t> place(sorted.size());
    for (std::size_t i = 0; i < sorted.size(); ++i) place[sorted[i]] = i;
    for (const Edge& edge : graph.edges) {
      if (graph.IsFeedback(edge) || cuts.contains(edge)) continue;
      ASSERT_LT(place[edge.first], place[edge.second]) << "round " << round;
    }
    for (const OrderedTask& task : tasks) {
      for (const auto& each : task.outgoing) {
        if (each->is_own) {
          ASSERT_TRUE(each->from->place.IsBefore(each->to->place));
        }
      }
    }
  }

  Graph graph;
  std::deque<OrderedTask> tasks;
  RunningOrder order;
};

TEST(RunningOrderTest, StaysGoodAndCutsTheSameHoweverItCameAbout) {
  std::mt19937 random(2);
  for (const std::size_t size : {4, 12, 40, 150}) {
    Living living(RandomGraph(random, size, size / 2));
    for (int round = 0; round < 600; ++round) {
      const std::size_t a = random() % size;
      // Mostly few connections, so that most loops are small and fall apart again.
      const bool takes_away = living.graph.edges.size() > size && random() % 3 > 0;
      if (random() % 20 == 0) {
        living.Replace(a);
      } else if (takes_away) {
        living.Toggle(
            *std::next(living.graph.edges.begin(),
                       static_cast<std::ptrdiff_t>(random() % living.graph.edges.size())));
      } else {
        living.Toggle({a, random() % size});
      }
      living.Check(round);
      if (::testing::Test::HasFatalFailure()) return;
    }
  }
}

Graph Chain(std::size_t length) {
  Graph graph;
  graph.phases.assign(length, Phase::kUpdate);
  for (std::size_t i = 0; i < length; ++i) graph.serials.push_back(i + 1);
  for (std::size_t i = 1; i < length; ++i) graph.edges.emplace(i - 1, i);
  return graph;
}

std::size_t ChangedBlocks(const RunningOrder& order) {
  return static_cast<std::size_t>(std::ranges::count_if(
      order.tasks().blocks(), [](const auto& each) { return each->is_changed; }));
}

TEST(RunningOrderTest, ChangesNothingWhereAConnectionAgreesWithIt) {
  Living living(Chain(500));
  for (const auto& block : living.order.tasks().blocks()) block->is_changed = false;
  living.Toggle({3, 450});
  living.Toggle({3, 450});
  EXPECT_EQ(ChangedBlocks(living.order), 0u);
}

TEST(RunningOrderTest, PutsANewSensorInFrontOfAllWithoutMovingThem) {
  Graph graph = Chain(500);
  graph.phases.push_back(Phase::kUpdate);
  graph.serials.push_back(501);
  Living living(graph);
  for (const auto& block : living.order.tasks().blocks()) block->is_changed = false;
  living.Toggle({500, 0});
  EXPECT_EQ(OrderOf(living.order, living.tasks).front(), 500u);
  EXPECT_LE(ChangedBlocks(living.order), 2u);
}

TEST(RunningOrderTest, KeepsItsBlocksFilledWhenMuchIsTakenOut) {
  Graph graph = Chain(1000);
  graph.edges.clear();
  Living living(graph);
  for (std::size_t i = 0; i < 1000; ++i) {
    if (i % 10 != 0) living.order.Remove(living.tasks[i]);
  }
  EXPECT_EQ(living.order.size(), 100u);
  EXPECT_LE(living.order.tasks().blocks().size(), 20u);
  for (std::size_t i = 0; i < 1000; ++i) {
    if (i % 10 != 0) living.order.Add(living.tasks[i]);
  }
  EXPECT_EQ(OrderOf(living.order, living.tasks).size(), 1000u);
}

// Always in the same place, so that the labels run out.
TEST(RunningOrderTest, FindsRoomBetweenTwoTasksAgainAndAgain) {
  Graph graph = Chain(20000);
  graph.edges.clear();
  for (std::size_t i = 2; i < 20000; ++i) graph.edges.emplace(i, 1);
  Living living(graph);
  for (std::size_t i = 2; i < 20000; ++i) living.Toggle({i, 1});
  for (std::size_t i = 2; i < 20000; ++i) {
    living.Toggle({0, i});
    living.Toggle({i, 1});
  }
  const std::vector<std::size_t> order = OrderOf(living.order, living.tasks);
  EXPECT_EQ(order.front(), 0u);
  EXPECT_EQ(order.back(), 1u);
}

TEST(RunningOrderTest, KnowsAConnectionUntilItsLastPairOfPortsHasGone) {
  Living living(Chain(3));
  OrderedTask& a = living.tasks[0];
  OrderedTask& c = living.tasks[2];
  living.order.Connect(c, a, Pair(1));
  living.order.Connect(c, a, Pair(2));
  EXPECT_EQ(CutsOf(living.order, living.tasks).size(), 1u);
  living.order.Disconnect(c, a, Pair(1));
  EXPECT_EQ(CutsOf(living.order, living.tasks).size(), 1u);
  living.order.Disconnect(c, a, Pair(2));
  EXPECT_THAT(CutsOf(living.order, living.tasks), IsEmpty());
  EXPECT_THAT(OrderOf(living.order, living.tasks), ElementsAre(0, 1, 2));
}

}  // namespace
}  // namespace runnel::internal
