#include "plugins/scheduling/internal/running_order.h"

#include <algorithm>
#include <queue>
#include <utility>

#include "core/base/check.h"
#include "plugins/scheduling/internal/keep_order.h"
#include "plugins/scheduling/internal/loop_cuts.h"

namespace runnel::internal {

namespace {

bool IsFeedback(const OrderedTask& from, const OrderedTask& to) {
  return from.phase == Phase::kControl && to.phase == Phase::kSense;
}

// What is followed leads forward among the tasks.
struct FollowedEdges {
  template <typename Visit>
  void ForEachNext(const OrderedTask& task, Visit&& visit) const {
    for (const auto& each : task.outgoing) {
      if (each->is_followed) visit(*each->to);
    }
  }
  template <typename Visit>
  void ForEachPrevious(const OrderedTask& task, Visit&& visit) const {
    for (const Dependency* each : task.incoming) {
      if (each->is_followed) visit(*each->from);
    }
  }
  [[nodiscard]] std::size_t Work(const OrderedTask& task) const {
    return 1 + task.outgoing.size() + task.incoming.size();
  }
};

// All dependencies, also the cut ones, lead forward among the loops.
struct EdgesOfLoops {
  template <typename Visit>
  void ForEachNext(const Loop& loop, Visit&& visit) const {
    for (const OrderedTask* task : loop.members) {
      for (const auto& each : task->outgoing) {
        if (each->to->loop.get() != &loop) visit(*each->to->loop);
      }
    }
  }
  template <typename Visit>
  void ForEachPrevious(const Loop& loop, Visit&& visit) const {
    for (const OrderedTask* task : loop.members) {
      for (const Dependency* each : task->incoming) {
        if (each->from->loop.get() != &loop) visit(*each->from->loop);
      }
    }
  }
  [[nodiscard]] std::size_t Work(const Loop& loop) const {
    std::size_t work = 1;
    for (const OrderedTask* task : loop.members) {
      work += task->outgoing.size() + task->incoming.size();
    }
    return work;
  }
};

bool IsEarlier(const Dependency* a, const Dependency* b) {
  return std::pair(a->to->key(), a->from->key()) < std::pair(b->to->key(), b->from->key());
}

template <typename Node, typename Edges>
OrderKeeper<Node, Edges> Keeper(BlockList<Node>& list, std::uint64_t& mark, const Edges& edges) {
  return {list, mark, edges};
}

}  // namespace

RunningOrder::~RunningOrder() = default;

void RunningOrder::Add(OrderedTask& task) {
  task.place_in_all = all_.size();
  all_.push_back(&task);
  if (!is_sorted_) return;
  task.loop = std::make_shared<Loop>();
  task.loop->members = {&task};
  loops_.Append(*task.loop);
  tasks_.InsertByRank(task);
}

void RunningOrder::Remove(OrderedTask& task) {
  while (!task.outgoing.empty()) Remove(*task.outgoing.back());
  while (!task.incoming.empty()) Remove(*task.incoming.back());
  all_.back()->place_in_all = task.place_in_all;
  std::swap(all_[task.place_in_all], all_.back());
  all_.pop_back();
  if (!is_sorted_) return;
  tasks_.Remove(task);
  const std::shared_ptr<Loop> loop = std::exchange(task.loop, nullptr);
  std::erase(loop->members, &task);
  if (loop->members.empty()) {
    loops_.Remove(*loop);
  } else {
    Resolve(loop);
  }
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
  return *added;
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
  if (IsFeedback(from, to)) return;
  if (Dependency* const known = Find(from, to)) {
    const bool is_news =
        std::ranges::find(known->connections, connection) == known->connections.end();
    if (is_news) known->connections.push_back(connection);
    return;
  }
  Dependency& added = Add(from, to);
  added.connections.push_back(connection);
  if (is_sorted_) PutInOrder(added);
}

void RunningOrder::Disconnect(OrderedTask& from, OrderedTask& to, const PortPair& connection) {
  Dependency* const known = Find(from, to);
  if (known == nullptr) return;
  std::erase(known->connections, connection);
  if (known->is_own || !known->connections.empty()) return;
  Remove(*known);
  // Between loops, or where a task feeds itself, the order is as good as before.
  if (is_sorted_ && &from != &to && from.loop == to.loop) Resolve(from.loop);
}

void RunningOrder::KeepPhases(OrderedTask& earlier, OrderedTask& later) {
  Dependency* const known = Find(earlier, later);
  Dependency& dependency = known != nullptr ? *known : Add(earlier, later);
  dependency.is_own = true;
  if (!is_sorted_) return;
  if (known == nullptr) {
    PutInOrder(dependency);
  } else if (earlier.loop == later.loop) {
    Resolve(earlier.loop);
  }
}

void RunningOrder::PutInOrder(Dependency& added) {
  OrderedTask& from = *added.from;
  OrderedTask& to = *added.to;
  if (&from == &to) return;
  if (from.loop == to.loop) return Resolve(from.loop);
  const EdgesOfLoops edges;
  if (Keeper(loops_, last_mark_, edges).Put(*from.loop, *to.loop)) return Follow(added);
  Merge(*from.loop, *to.loop);
  Resolve(from.loop);
}

void RunningOrder::Follow(Dependency& dependency) {
  const FollowedEdges edges;
  const bool is_possible = Keeper(tasks_, last_mark_, edges).Put(*dependency.from, *dependency.to);
  RUNNEL_CHECK(is_possible, "a loop of tasks has been cut in the wrong place");
  dependency.is_followed = true;
}

// There is a way from `to` to `from` already: all on such ways are one loop now. What else can be
// reached from `to` comes behind it.
void RunningOrder::Merge(Loop& from, Loop& to) {
  const EdgesOfLoops edges;
  auto keeper = Keeper(loops_, last_mark_, edges);
  std::vector<Loop*> others = keeper.Reached(from, to);
  const std::uint64_t reached = from.mark;
  const std::uint64_t joined = ++last_mark_;
  from.mark = joined;
  std::vector<Loop*> joining{&from};
  for (std::size_t i = 0; i < joining.size(); ++i) {
    edges.ForEachPrevious(*joining[i], [&](Loop& previous) {
      if (previous.mark != reached) return;
      previous.mark = joined;
      joining.push_back(&previous);
    });
  }
  std::erase_if(others, [&](const Loop* each) { return each->mark == joined; });
  keeper.MoveBehind(from, std::move(others));
  const std::shared_ptr<Loop> whole = from.members.front()->loop;
  joining.erase(joining.begin());
  for (Loop* each : joining) {
    loops_.Remove(*each);
    const std::vector<OrderedTask*> members = std::move(each->members);
    for (OrderedTask* task : members) {  // with the last one the loop that they were in goes
      task->loop = whole;
      whole->members.push_back(task);
    }
  }
}

// The dependencies among its tasks have changed: it may have fallen apart, and the cuts may lie
// elsewhere.
void RunningOrder::Resolve(const std::shared_ptr<Loop>& loop) {
  const std::shared_ptr<Loop> whole = loop;
  const std::vector<OrderedTask*> members = whole->members;
  std::vector<Dependency*> inner;
  for (OrderedTask* task : members) {
    for (const auto& each : task->outgoing) {
      if (each->to->loop == whole && each->to != task) inner.push_back(each.get());
    }
  }
  std::vector<Tasks> pieces = FindLoops(members);
  const std::uint64_t cut = ++last_mark_;
  for (Tasks& piece : pieces) {
    if (piece.size() == 1) continue;
    for (const LoopCut& each : CutLoop(piece)) {
      for (Dependency* late : each.cuts) late->mark = cut;
    }
  }
  Loop* last = nullptr;
  for (Tasks& piece : pieces) {
    const auto part = last == nullptr ? whole : std::make_shared<Loop>();
    for (OrderedTask* task : piece) task->loop = part;
    part->members = std::move(piece);
    if (last != nullptr) loops_.InsertAfter(*part, *last);
    last = part.get();
  }
  std::vector<Dependency*> to_follow;
  for (Dependency* each : inner) {
    if (each->mark == cut) each->is_followed = false;
    if (each->mark != cut && !each->is_followed) to_follow.push_back(each);
  }
  std::ranges::sort(to_follow, IsEarlier);
  for (Dependency* each : to_follow) Follow(*each);
}

void RunningOrder::Sort() {
  for (OrderedTask* task : all_) {
    for (const auto& each : task->outgoing) each->is_followed = each->from != each->to;
    task->heads.clear();
    task->is_head = false;
    task->waits_for = 0;
  }
  for (Tasks& members : FindLoops(all_)) {
    const auto loop = std::make_shared<Loop>();
    for (OrderedTask* task : members) task->loop = loop;
    loops_.Append(*loop);
    if (members.size() > 1) {
      for (const LoopCut& cut : CutLoop(members)) EnterLoopAt(cut);
    }
    loop->members = std::move(members);
  }
  PlaceAll();
  is_sorted_ = true;
}

// Its head may run when nothing is left that feeds the loop from outside, and nothing else is free.
void RunningOrder::EnterLoopAt(const LoopCut& cut) {
  for (Dependency* each : cut.cuts) each->is_followed = false;
  cut.head->is_head = true;
  const std::uint64_t inside = ++last_mark_;
  for (OrderedTask* task : cut.loop) task->mark = inside;
  for (OrderedTask* task : cut.loop) {
    for (const Dependency* each : task->incoming) {
      if (each->from->mark == inside || !each->is_followed) continue;
      each->from->heads.push_back(cut.head);
      ++cut.head->waits_for;
    }
  }
}

void RunningOrder::PlaceAll() {
  const auto is_later = [](const OrderedTask* a, const OrderedTask* b) {
    return b->key() < a->key();
  };
  using Queue = std::priority_queue<OrderedTask*, std::vector<OrderedTask*>, decltype(is_later)>;
  Queue free(is_later);
  Queue heads(is_later);
  const auto release = [&](OrderedTask* task) { (task->is_head ? heads : free).push(task); };
  for (OrderedTask* task : all_) {
    for (const Dependency* each : task->incoming) task->waits_for += each->is_followed ? 1 : 0;
    if (task->waits_for == 0) release(task);
  }
  while (!free.empty() || !heads.empty()) {
    Queue& from = free.empty() ? heads : free;
    OrderedTask* const next = from.top();
    from.pop();
    tasks_.Append(*next);
    for (const auto& each : next->outgoing) {
      if (each->is_followed && --each->to->waits_for == 0) release(each->to);
    }
    for (OrderedTask* head : next->heads) {
      if (--head->waits_for == 0) release(head);
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
  std::ranges::sort(cuts, IsEarlier);
  return cuts;
}

}  // namespace runnel::internal
