#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <tuple>
#include <vector>

#include "core/base/error.h"
#include "core/module/executable.h"

namespace runnel {
class Port;
}

namespace runnel::internal {

struct LoopCut;
struct OrderedTask;

/// One connection over which data goes from one task to another.
struct PortPair {
  const Port* from;
  const Port* to;
  friend bool operator==(const PortPair&, const PortPair&) = default;
};

/// `from` runs before `to`, unless the dependency is cut.
struct Dependency {
  OrderedTask* from;
  OrderedTask* to;
  std::vector<PortPair> connections;
  bool is_own = false;       ///< phases of one element: never cut
  bool is_followed = false;  ///< else it is cut, as part of a loop
  std::size_t place_in_from = 0;
  std::size_t place_in_to = 0;
};

/// A task in a RunningOrder; whoever orders tasks derives from it.
struct OrderedTask {
  Phase phase = Phase::kUpdate;
  std::uint64_t id = 0;    ///< of its element
  std::size_t number = 0;  ///< among the tasks of its element
  std::size_t place = 0;   ///< in the order
  std::size_t place_in_all = 0;
  std::vector<std::unique_ptr<Dependency>> outgoing;
  std::vector<Dependency*> incoming;

  /// What comes first where data flow does not decide.
  [[nodiscard]] auto key() const noexcept { return std::tuple(phase, id, number); }

  // Notes of the algorithms.
  std::uint64_t set = 0;
  std::size_t index = 0;
  std::size_t low = 0;
  std::size_t waits_for = 0;
  std::size_t loop_waits_for = 0;   // of the loop whose head it is: tasks outside that feed it
  std::vector<OrderedTask*> heads;  // of loops that wait for this task
  bool is_head = false;
};

/// The tasks of one thread in the order of the data flow, so that what the first one measures reaches
/// the last one in the same cycle. Sorting makes all of it anew: order and cuts are then a function of
/// the tasks and connections alone.
///
/// An edge leads from the task that writes a group to each task that reads a group in which a port
/// is fed by it, through however many interface ports. Besides, the tasks of one element keep the
/// order of their phases. Rules, in this order:
///   1. An edge from a control task into a sense task is the feedback through the robot: not followed,
///      and not reported.
///   2. All other edges are followed, as long as they form no loop.
///   3. Of the tasks that are free to run, the one with the earlier phase comes first, then the one
///      whose element was made earlier (id), then the one named earlier by its element.
///   4. If none is free, the tasks left contain loops. Of those loops that no other loop feeds, the
///      task that rule 3 puts first runs next; the edges into it from tasks that are left are cut,
///      and each of their connections is reported. A task that feeds itself is reported likewise.
///      After 32 such cuts, each within the loop that the one before has left, what is left of it runs
///      by rule 3 alone, and every connection against that is cut.
/// No address and no clock enters: the same application gives the same order and the same cuts.
/// Source:   the sorting of S. Kahn, "Topological sorting of large networks" (1962).
///
/// Threads:  one at a time. Ownership: tasks belong to the caller and stay where they are until they
///           are removed.
/// Effort:   Sort() O(n log n), for n tasks and connections without loops; more where many lie in one
///           loop. A change, O(1), or the number of a task's connections.
class RunningOrder {
 public:
  RunningOrder() = default;
  RunningOrder(const RunningOrder&) = delete;
  RunningOrder& operator=(const RunningOrder&) = delete;

  void Add(OrderedTask& task);
  /// With all its dependencies.
  void Remove(OrderedTask& task);
  /// Data flows from the one to the other over `connection`; the same again is no news. Feedback
  /// from a control task to a sense task is left out.
  void Connect(OrderedTask& from, OrderedTask& to, const PortPair& connection);
  void Disconnect(OrderedTask& from, OrderedTask& to, const PortPair& connection);
  /// Both are tasks of one element.
  void KeepPhases(OrderedTask& earlier, OrderedTask& later);

  /// Whether Sort() has nothing to do. A connection that comes or goes while nothing is cut, and agrees
  /// with the order, changes nothing.
  [[nodiscard]] bool is_sorted() const noexcept { return is_sorted_; }
  void Sort();

  /// As of the last Sort().
  [[nodiscard]] const std::vector<OrderedTask*>& tasks() const noexcept { return tasks_; }
  /// As of now.
  [[nodiscard]] std::size_t size() const noexcept { return all_.size(); }
  /// In the order of the tasks that are fed late. Precondition: is_sorted().
  [[nodiscard]] std::vector<const Dependency*> Cuts() const;

 private:
  Dependency* Find(const OrderedTask& from, const OrderedTask& to) const;
  Dependency& Add(OrderedTask& from, OrderedTask& to);
  static void Remove(Dependency& dependency);
  void Follow(Dependency& added) noexcept;
  [[nodiscard]] bool PlaceAll();
  void CutLoops();
  void EnterLoopAt(const LoopCut& cut);

  std::vector<OrderedTask*> all_;    // in no order
  std::vector<OrderedTask*> tasks_;  // in order
  bool is_sorted_ = true;
  bool has_cuts_ = false;
};

/// Adds a warning for each connection that `order` does not follow; each names both ports.
void ReportCuts(const RunningOrder& order, std::vector<Error>& warnings);

}  // namespace runnel::internal
