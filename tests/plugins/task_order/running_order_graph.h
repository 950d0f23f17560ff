#pragma once

#include <algorithm>
#include <deque>
#include <map>
#include <random>
#include <set>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "plugins/task_order/running_order.h"

namespace runnel::internal {

// Two words that stand for the ports of a connection; nobody looks at what they point to.
inline PortPair Pair(int number) {
  static const std::vector<char> places(100000);
  const auto* const at = places.data() + 8 * number;
  return {reinterpret_cast<const Port*>(at), reinterpret_cast<const Port*>(at + 4)};
}

using Edge = std::pair<std::size_t, std::size_t>;

/// Tasks by number, and what connects them; can be brought into a RunningOrder, whole or bit by bit.
struct Graph {
  std::vector<Phase> phases;
  std::vector<std::uint64_t> ids;
  std::set<Edge> edges;

  [[nodiscard]] auto Key(std::size_t task) const { return std::tuple(phases[task], ids[task], task); }
  [[nodiscard]] bool IsFeedback(const Edge& edge) const {
    return phases[edge.first] == Phase::kControl && phases[edge.second] == Phase::kSense;
  }
};

inline std::set<Edge> CutsOf(const RunningOrder& order, const std::deque<OrderedTask>& tasks) {
  std::set<Edge> cuts;
  const auto index = [&](const OrderedTask* task) {
    return static_cast<std::size_t>(std::ranges::find_if(tasks, [&](const auto& each) { return &each == task; }) -
                                    tasks.begin());
  };
  for (const Dependency* each : order.Cuts()) cuts.emplace(index(each->from), index(each->to));
  return cuts;
}

inline std::vector<std::size_t> OrderOf(const RunningOrder& order, const std::deque<OrderedTask>& tasks) {
  std::map<const OrderedTask*, std::size_t> index;
  for (std::size_t i = 0; i < tasks.size(); ++i) index[&tasks[i]] = i;
  std::vector<std::size_t> result;
  for (const OrderedTask* each : order.tasks()) result.push_back(index.at(each));
  return result;
}

struct Sorted {
  std::vector<std::size_t> order;
  std::set<Edge> cuts;
};

inline void Fill(OrderedTask& task, const Graph& graph, std::size_t number) {
  task.phase = graph.phases[number];
  task.id = graph.ids[number];
  task.number = number;
}

inline void ConnectPhases(std::deque<OrderedTask>& tasks, RunningOrder& order) {
  for (OrderedTask& a : tasks) {
    for (OrderedTask& b : tasks) {
      if (a.id == b.id && a.key() < b.key()) order.KeepPhases(a, b);
    }
  }
}

inline Sorted Anew(const Graph& graph) {
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

inline Graph RandomGraph(std::mt19937& random, std::size_t tasks, std::size_t edges) {
  Graph graph;
  std::uint64_t id = 0;
  for (std::size_t i = 0; i < tasks; ++i) {
    // Now and then an element with a sense and a control task.
    const bool is_second = i > 0 && graph.phases[i - 1] == Phase::kSense;
    if (!is_second) ++id;
    const bool is_first = !is_second && random() % 4 == 0 && i + 1 < tasks;
    graph.phases.push_back(is_second ? Phase::kControl : is_first ? Phase::kSense : Phase::kUpdate);
    graph.ids.push_back(id);
  }
  for (std::size_t i = 0; i < edges; ++i) graph.edges.emplace(random() % tasks, random() % tasks);
  return graph;
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
      if (graph.ids[i] == graph.ids[task]) own.push_back(i);
    }
    for (const std::size_t each : own) {
      order.Remove(tasks[each]);
      std::erase_if(graph.edges, [&](const Edge& edge) { return edge.first == each || edge.second == each; });
    }
    for (const std::size_t each : own) order.Add(tasks[each]);
    for (std::size_t i = 1; i < own.size(); ++i) {
      order.KeepPhases(tasks[own[i - 1]], tasks[own[i]]);
    }
  }
  void Check(int round) {
    const bool was_sorted = order.is_sorted();
    order.Sort();
    const std::vector<std::size_t> sorted = OrderOf(order, tasks);
    ASSERT_EQ(sorted.size(), tasks.size());
    const std::set<Edge> cuts = CutsOf(order, tasks);
    const Sorted anew = Anew(graph);
    ASSERT_EQ(cuts, anew.cuts) << "round " << round;
    if (!was_sorted) {
      ASSERT_EQ(sorted, anew.order) << "round " << round;
    }
    std::vector<std::size_t> place(sorted.size());
    for (std::size_t i = 0; i < sorted.size(); ++i) place[sorted[i]] = i;
    for (const Edge& edge : graph.edges) {
      if (graph.IsFeedback(edge) || cuts.contains(edge)) continue;
      ASSERT_LT(place[edge.first], place[edge.second]) << "round " << round;
    }
    for (const OrderedTask& task : tasks) {
      for (const auto& each : task.outgoing) {
        if (each->is_own) {
          ASSERT_LT(each->from->place, each->to->place);
        }
      }
    }
  }

  Graph graph;
  std::deque<OrderedTask> tasks;
  RunningOrder order;
};

inline Graph Chain(std::size_t length) {
  Graph graph;
  graph.phases.assign(length, Phase::kUpdate);
  for (std::size_t i = 0; i < length; ++i) graph.ids.push_back(i + 1);
  for (std::size_t i = 1; i < length; ++i) graph.edges.emplace(i - 1, i);
  return graph;
}

}  // namespace runnel::internal
