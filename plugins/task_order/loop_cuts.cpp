#include "plugins/task_order/loop_cuts.h"

#include <algorithm>
#include <atomic>

namespace runnel::internal {

std::uint64_t MarkAsSet(const Tasks& tasks) noexcept {
  static std::atomic<std::uint64_t> last{0};
  const std::uint64_t set = last.fetch_add(1, std::memory_order_relaxed) + 1;
  for (OrderedTask* task : tasks) task->set = set;
  return set;
}

namespace {

// Without recursion: a chain may be as long as the application is large.
class LoopFinder {
 public:
  explicit LoopFinder(const Tasks& tasks) : set_(MarkAsSet(tasks)) {
    for (OrderedTask* task : tasks) task->index = kUnseen;
    for (OrderedTask* task : tasks) {
      if (task->index == kUnseen) SearchFrom(*task);
    }
    std::ranges::reverse(loops_);
  }
  std::vector<Tasks> TakeLoops() { return std::move(loops_); }

 private:
  static constexpr std::size_t kUnseen = 0;
  struct Step {
    OrderedTask* task;
    std::size_t next = 0;
  };

  void SearchFrom(OrderedTask& start) {
    Enter(start);
    while (!path_.empty()) {
      Step& step = path_.back();
      OrderedTask& task = *step.task;
      if (step.next < task.outgoing.size()) {
        OrderedTask& to = *task.outgoing[step.next++]->to;
        if (to.set != set_) continue;
        if (to.index == kUnseen) {
          Enter(to);
        } else {
          task.low = std::min(task.low, to.index);
        }
      } else {
        path_.pop_back();
        if (!path_.empty()) path_.back().task->low = std::min(path_.back().task->low, task.low);
        if (task.low == task.index) TakeLoop(task);
      }
    }
  }

  void Enter(OrderedTask& task) {
    task.index = task.low = ++entered_;
    open_.push_back(&task);
    path_.push_back({&task});
  }

  void TakeLoop(const OrderedTask& first) {
    Tasks& loop = loops_.emplace_back();
    do {
      loop.push_back(open_.back());
      loop.back()->set = 0;  // no longer to be looked at
      open_.pop_back();
    } while (loop.back() != &first);
  }

  const std::uint64_t set_;
  std::size_t entered_ = 0;
  std::vector<Step> path_;
  Tasks open_;
  std::vector<Tasks> loops_;
};

bool WaitsForItsElement(const OrderedTask& task) {
  return std::ranges::any_of(task.incoming,
                             [&](const Dependency* each) { return each->is_own && each->from->set == task.set; });
}

LoopCut CutOnce(Tasks loop) {
  const std::uint64_t set = MarkAsSet(loop);
  OrderedTask* head = nullptr;
  for (OrderedTask* task : loop) {
    const bool is_earlier = head == nullptr || task->key() < head->key();
    if (is_earlier && !WaitsForItsElement(*task)) head = task;
  }
  std::vector<Dependency*> cuts;
  for (Dependency* each : head->incoming) {
    if (each->from->set == set && each->from != head) cuts.push_back(each);
  }
  return {head, std::move(loop), std::move(cuts)};
}

// All that leads backwards in the order of rule 3. Phases of one element never do.
LoopCut CutEverywhere(Tasks loop) {
  const std::uint64_t set = MarkAsSet(loop);
  std::ranges::sort(loop, {}, [](const OrderedTask* task) { return task->key(); });
  std::vector<Dependency*> cuts;
  for (OrderedTask* task : loop) {
    for (Dependency* each : task->incoming) {
      if (each->from->set == set && task->key() < each->from->key()) cuts.push_back(each);
    }
  }
  OrderedTask* const head = loop.front();
  return {head, std::move(loop), std::move(cuts)};
}

}  // namespace

std::vector<Tasks> FindLoops(const Tasks& tasks) { return LoopFinder(tasks).TakeLoops(); }

std::vector<LoopCut> CutLoop(Tasks loop) {
  struct Open {
    Tasks loop;
    int depth;
  };
  std::vector<LoopCut> cuts;
  std::vector<Open> open;
  open.push_back({std::move(loop), 0});
  while (!open.empty()) {
    Open next = std::move(open.back());
    open.pop_back();
    if (next.depth == kDeepestLoop) {
      cuts.push_back(CutEverywhere(std::move(next.loop)));
      continue;
    }
    cuts.push_back(CutOnce(std::move(next.loop)));
    Tasks others = cuts.back().loop;
    std::erase(others, cuts.back().head);
    for (Tasks& each : FindLoops(others)) {
      if (each.size() > 1) open.push_back({std::move(each), next.depth + 1});
    }
  }
  return cuts;
}

}  // namespace runnel::internal
