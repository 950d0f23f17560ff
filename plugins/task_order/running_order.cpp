#include "plugins/task_order/running_order.h"

#include <algorithm>
#include <queue>
#include <utility>

#include "core/base/check.h"
#include "core/port/port.h"
#include "plugins/task_order/loop_cuts.h"

namespace runnel::internal {

void RunningOrder::Add(OrderedTask& task) {
  is_sorted_ = false;
  task.place_in_all = all_.size();
  all_.push_back(&task);
}

void RunningOrder::Remove(OrderedTask& task) {
  is_sorted_ = false;
  while (!task.outgoing.empty()) Remove(*task.outgoing.back());
  while (!task.incoming.empty()) Remove(*task.incoming.back());
  all_.back()->place_in_all = task.place_in_all;
  std::swap(all_[task.place_in_all], all_.back());
  all_.pop_back();
}

Dependency* RunningOrder::Find(const OrderedTask& from, const OrderedTask& to) const {
  if (from.outgoing.size() < to.incoming.size()) {
    for (const auto& each : from.outgoing) {
      if (each->to == &to) return each.get();
    }
  } else {
    for (Dependency* each : to.incoming) {
      if (each->from == &from) return each;
    }
  }
  return nullptr;
}

Dependency& RunningOrder::Add(OrderedTask& from, OrderedTask& to) {
  auto& added = from.outgoing.emplace_back(std::make_unique<Dependency>());
  added->from = &from;
  added->to = &to;
  added->place_in_from = from.outgoing.size() - 1;
  added->place_in_to = to.incoming.size();
  to.incoming.push_back(added.get());
  Follow(*added);
  return *added;
}

// Where nothing is cut, a dependency that leads forward closes no loop and changes nothing. One of a task
// on itself is cut, and lies in no other loop.
void RunningOrder::Follow(Dependency& added) noexcept {
  if (added.from == added.to) return;
  added.is_followed = true;
  if (has_cuts_ || added.to->place <= added.from->place) is_sorted_ = false;
}

void RunningOrder::Remove(Dependency& dependency) {
  auto& incoming = dependency.to->incoming;
  incoming.back()->place_in_to = dependency.place_in_to;
  incoming[dependency.place_in_to] = incoming.back();
  incoming.pop_back();
  auto& outgoing = dependency.from->outgoing;
  outgoing.back()->place_in_from = dependency.place_in_from;
  std::swap(outgoing[dependency.place_in_from], outgoing.back());
  outgoing.pop_back();
}

void RunningOrder::Connect(OrderedTask& from, OrderedTask& to, const PortPair& connection) {
  if (from.phase == Phase::kControl && to.phase == Phase::kSense) return;  // feedback
  Dependency* const known = Find(from, to);
  auto& connections = (known != nullptr ? *known : Add(from, to)).connections;
  if (std::ranges::find(connections, connection) == connections.end()) {
    connections.push_back(connection);
  }
}

void RunningOrder::Disconnect(OrderedTask& from, OrderedTask& to, const PortPair& connection) {
  Dependency* const known = Find(from, to);
  if (known == nullptr) return;
  std::erase(known->connections, connection);
  if (known->is_own || !known->connections.empty()) return;
  Remove(*known);
  if (has_cuts_ && &from != &to) is_sorted_ = false;
}

void RunningOrder::KeepPhases(OrderedTask& earlier, OrderedTask& later) {
  Dependency* const known = Find(earlier, later);
  Dependency& dependency = known != nullptr ? *known : Add(earlier, later);
  dependency.is_own = true;
  if (has_cuts_) is_sorted_ = false;  // what is own is never cut
}

void RunningOrder::Sort() {
  if (is_sorted_) return;
  for (OrderedTask* task : all_) {
    for (const auto& each : task->outgoing) each->is_followed = each->from != each->to;
    task->heads.clear();
    task->is_head = false;
    task->loop_waits_for = 0;
  }
  has_cuts_ = !PlaceAll();
  if (has_cuts_) {
    CutLoops();
    RUNNEL_CHECK(PlaceAll(), "a loop of tasks has been cut in the wrong place");
  }
  is_sorted_ = true;
}

// Of the tasks that are free, the first by rule 3; where none is, the head of a loop. False if loops
// that are not cut keep some from being placed.
bool RunningOrder::PlaceAll() {
  const auto is_later = [](const OrderedTask* a, const OrderedTask* b) { return b->key() < a->key(); };
  using Queue = std::priority_queue<OrderedTask*, std::vector<OrderedTask*>, decltype(is_later)>;
  Queue free(is_later);
  Queue heads(is_later);
  const auto release = [&](OrderedTask* task) { (task->is_head ? heads : free).push(task); };
  tasks_.clear();
  tasks_.reserve(all_.size());
  for (OrderedTask* task : all_) {
    task->waits_for = task->loop_waits_for;
    for (const Dependency* each : task->incoming) task->waits_for += each->is_followed ? 1 : 0;
    if (task->waits_for == 0) release(task);
  }
  while (!free.empty() || !heads.empty()) {
    Queue& from = free.empty() ? heads : free;
    OrderedTask* const next = from.top();
    from.pop();
    next->place = tasks_.size();
    tasks_.push_back(next);
    for (const auto& each : next->outgoing) {
      if (each->is_followed && --each->to->waits_for == 0) release(each->to);
    }
    for (OrderedTask* head : next->heads) {
      if (--head->waits_for == 0) release(head);
    }
  }
  return tasks_.size() == all_.size();
}

// Those that could not be placed lie in loops, or behind them.
void RunningOrder::CutLoops() {
  Tasks left;
  for (OrderedTask* task : all_) {
    if (task->waits_for > 0) left.push_back(task);
  }
  for (const Tasks& loop : FindLoops(left)) {
    if (loop.size() == 1) continue;
    for (const LoopCut& cut : CutLoop(loop)) EnterLoopAt(cut);
  }
}

// Its head may run when nothing is left that feeds the loop from outside, and nothing else is free.
void RunningOrder::EnterLoopAt(const LoopCut& cut) {
  for (Dependency* each : cut.cuts) each->is_followed = false;
  cut.head->is_head = true;
  const std::uint64_t inside = MarkAsSet(cut.loop);
  for (OrderedTask* task : cut.loop) {
    for (const Dependency* each : task->incoming) {
      if (each->from->set == inside || !each->is_followed) continue;
      each->from->heads.push_back(cut.head);
      ++cut.head->loop_waits_for;
    }
  }
}

std::vector<const Dependency*> RunningOrder::Cuts() const {
  std::vector<const Dependency*> cuts;
  for (const OrderedTask* task : all_) {
    for (const auto& each : task->outgoing) {
      if (!each->is_followed) cuts.push_back(each.get());
    }
  }
  std::ranges::sort(cuts, {}, [](const Dependency* each) { return std::pair(each->to->key(), each->from->key()); });
  return cuts;
}

void ReportCuts(const RunningOrder& order, std::vector<Error>& warnings) {
  for (const Dependency* cut : order.Cuts()) {
    std::vector<PortPair> connections = cut->connections;
    std::ranges::sort(connections, {}, [](const PortPair& each) { return std::pair(each.to->id(), each.from->id()); });
    for (const auto& [from, to] : connections) {
      warnings.push_back({.message = "the data flow runs in a loop, which is cut here: " + to->path() + " reads what " +
                                     from->path() + " published one cycle before",
                          .path = from->path(),
                          .hint = "nothing needs to be done if one cycle of delay is meant to be there"});
    }
  }
}

}  // namespace runnel::internal
