#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <tuple>
#include <vector>

#include "core/module/executable.h"
#include "plugins/scheduling/internal/block_list.h"

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
  std::uint64_t mark = 0;  // of the algorithms
};

/// Tasks each of which feeds all the others, and most often one task alone.
struct Loop {
  BlockPlace<Loop> place;
  std::vector<OrderedTask*> members;
  std::uint64_t mark = 0;
  [[nodiscard]] static std::size_t rank() noexcept { return 0; }
};

/// A task in a RunningOrder; whoever orders tasks derives from it.
struct OrderedTask {
  Phase phase = Phase::kUpdate;
  std::uint64_t serial = 0;  ///< of its element
  std::size_t number = 0;    ///< among the tasks of its element
  BlockPlace<OrderedTask> place;
  std::size_t place_in_all = 0;
  std::vector<std::unique_ptr<Dependency>> outgoing;
  std::vector<Dependency*> incoming;
  std::shared_ptr<Loop> loop;

  [[nodiscard]] std::size_t rank() const noexcept { return static_cast<std::size_t>(phase); }
  /// What comes first where data flow does not decide.
  [[nodiscard]] auto key() const noexcept { return std::tuple(phase, serial, number); }

  // Notes of the algorithms.
  std::uint64_t mark = 0;
  std::uint64_t set = 0;
  std::size_t index = 0;
  std::size_t low = 0;
  std::size_t waits_for = 0;
  std::vector<OrderedTask*> heads;  // of loops that wait for this task
  bool is_head = false;
};

/// Keeps the tasks of one thread in the order of the data flow while tasks and connections come and
/// go. The rules are those of OrderTasks() (execution_order.h); what is cut is always a function of
/// the tasks and connections alone. A change that agrees with the order moves nothing; one that does
/// not moves the fewer of the tasks that have to go up and those that have to go down.
///
/// Threads:  one at a time. Ownership: tasks belong to the caller and stay where they are until they
///           are removed.
/// Effort:   Sort() O(n log n), for n tasks and connections without loops; a change, the tasks that
///           can be reached from its ends without leaving the stretch of the order between them, and
///           the tasks of the loops that it opens or closes.
/// Source:   Pearce, Kelly, "A dynamic topological sort algorithm for directed acyclic graphs"
///           (2006), with the two-way search of Alpern et al., "Incremental evaluation of
///           computational circuits" (1990).
class RunningOrder {
 public:
  RunningOrder() = default;
  ~RunningOrder();
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

  /// Until this is called there is no order; then it is that of the rules.
  void Sort();

  [[nodiscard]] const BlockList<OrderedTask>& tasks() const noexcept { return tasks_; }
  [[nodiscard]] std::size_t size() const noexcept { return all_.size(); }
  /// In the order of the tasks that are fed late.
  [[nodiscard]] std::vector<const Dependency*> Cuts() const;

 private:
  Dependency* Find(const OrderedTask& from, const OrderedTask& to) const;
  Dependency& Add(OrderedTask& from, OrderedTask& to);
  static void Remove(Dependency& dependency);
  void PutInOrder(Dependency& added);
  void Follow(Dependency& dependency);
  void Merge(Loop& from, Loop& to);
  void Resolve(const std::shared_ptr<Loop>& loop);
  void EnterLoopAt(const LoopCut& cut);
  void PlaceAll();

  std::vector<OrderedTask*> all_;  // in no order
  BlockList<OrderedTask> tasks_;
  BlockList<Loop> loops_;  // so that no dependency leads backwards, but those within one
  bool is_sorted_ = false;
  std::uint64_t last_mark_ = 0;
};

}  // namespace runnel::internal
