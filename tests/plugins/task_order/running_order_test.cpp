// The order of tasks and connections that come and go, against the rules carried out as they are
// written, and against that of the same tasks and connections in a new order.

#include "plugins/task_order/running_order.h"

#include <algorithm>
#include <deque>
#include <map>
#include <random>
#include <set>

#include <gmock/gmock.h>

#include "tests/plugins/task_order/running_order_graph.h"

namespace runnel::internal {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Rules 1 to 4 of RunningOrder, word by word and as slow as they come.
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
        if (graph.ids[a] == graph.ids[b] && graph.Key(a) < graph.Key(b)) before_[b].insert(a);
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
    const bool waits_for_its_element =
        std::ranges::any_of(before_[task], [&](std::size_t each) { return graph_.ids[each] == graph_.ids[task]; });
    return !waits_for_its_element &&
           std::ranges::all_of(Upstream(task), [&](std::size_t each) { return Upstream(each).contains(task); });
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
            *std::next(living.graph.edges.begin(), static_cast<std::ptrdiff_t>(random() % living.graph.edges.size())));
      } else {
        living.Toggle({a, random() % size});
      }
      living.Check(round);
      if (::testing::Test::HasFatalFailure()) return;
    }
  }
}

// Where each task feeds almost every other, loops lie in loops deeper than are taken apart singly.
TEST(RunningOrderTest, CutsLoopsThatLieDeepInOneAnotherAlikeHoweverTheyCameAbout) {
  std::mt19937 random(3);
  Living living(RandomGraph(random, 60, 2000));
  for (int round = 0; round < 100; ++round) {
    living.Toggle({random() % 60, random() % 60});
    living.Check(round);
    if (::testing::Test::HasFatalFailure()) return;
  }
}

TEST(RunningOrderTest, ChangesNothingWhereAConnectionAgreesWithIt) {
  Living living(Chain(500));
  living.Toggle({3, 450});
  EXPECT_TRUE(living.order.is_sorted());
  living.Toggle({3, 450});
  EXPECT_TRUE(living.order.is_sorted());
  living.Toggle({450, 3});
  EXPECT_FALSE(living.order.is_sorted());
}

TEST(RunningOrderTest, PutsANewSensorInFrontOfAll) {
  Graph graph = Chain(500);
  graph.phases.push_back(Phase::kUpdate);
  graph.ids.push_back(501);
  Living living(graph);
  living.Toggle({500, 0});
  living.order.Sort();
  EXPECT_EQ(OrderOf(living.order, living.tasks).front(), 500u);
}

TEST(RunningOrderTest, KnowsAConnectionUntilItsLastPairOfPortsHasGone) {
  Living living(Chain(3));
  OrderedTask& a = living.tasks[0];
  OrderedTask& c = living.tasks[2];
  living.order.Connect(c, a, Pair(1));
  living.order.Connect(c, a, Pair(2));
  living.order.Sort();
  EXPECT_EQ(CutsOf(living.order, living.tasks).size(), 1u);
  living.order.Disconnect(c, a, Pair(1));
  EXPECT_TRUE(living.order.is_sorted());
  EXPECT_EQ(CutsOf(living.order, living.tasks).size(), 1u);
  living.order.Disconnect(c, a, Pair(2));
  living.order.Sort();
  EXPECT_THAT(CutsOf(living.order, living.tasks), IsEmpty());
  EXPECT_THAT(OrderOf(living.order, living.tasks), ElementsAre(0, 1, 2));
}

}  // namespace
}  // namespace runnel::internal
