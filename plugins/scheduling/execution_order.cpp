#include "plugins/scheduling/execution_order.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <utility>

#include "plugins/scheduling/internal/data_flow.h"

namespace runnel {

namespace {

using internal::DataEdge;

Error CutReport(const DataEdge& edge) {
  return {.message = "the data flow runs in a loop, which is cut here: " + edge.to_port->path() +
                     " reads what " + edge.from_port->path() + " published one cycle before",
          .path = edge.from_port->path(),
          .hint = "nothing needs to be done if one cycle of delay is meant to be there"};
}

class Sorter {
 public:
  explicit Sorter(std::vector<Task> tasks) : tasks_(std::move(tasks)) {
    // Rule 3 becomes the order of the indices. Stable: an element's own order is kept.
    std::ranges::stable_sort(
        tasks_, {}, [](const Task& task) { return std::pair(task.phase, task.element->serial()); });
    before_.resize(tasks_.size());
    edges_ = internal::FindDataEdges(tasks_);
    std::erase_if(edges_, [&](const DataEdge& edge) { return IsFeedback(edge); });
    for (const DataEdge& edge : edges_) before_[edge.to].insert(edge.from);
    AddPhasesOfElements();
  }

  ExecutionOrder Sort() {
    for (std::size_t i = 0; i < tasks_.size(); ++i) Cut(i, {i});
    while (order_.size() < tasks_.size()) {
      std::size_t next = FirstFree();
      if (next == tasks_.size()) {
        next = FirstInALoop();
        const std::set<std::size_t> late = before_[next];
        Cut(next, late);
      }
      Place(next);
    }
    ExecutionOrder result;
    for (const std::size_t index : order_) result.tasks.push_back(std::move(tasks_[index]));
    for (const DataEdge& edge : cuts_) result.cuts.push_back(CutReport(edge));
    return result;
  }

 private:
  [[nodiscard]] bool IsFeedback(const DataEdge& edge) const {
    return tasks_[edge.from].phase == Phase::kControl && tasks_[edge.to].phase == Phase::kSense;
  }

  void AddPhasesOfElements() {
    for (std::size_t later = 0; later < tasks_.size(); ++later) {
      for (std::size_t earlier = 0; earlier < later; ++earlier) {
        if (tasks_[earlier].element == tasks_[later].element) before_[later].insert(earlier);
      }
    }
  }

  [[nodiscard]] bool IsPlaced(std::size_t index) const {
    return std::ranges::find(order_, index) != order_.end();
  }

  [[nodiscard]] std::size_t FirstFree() const {
    std::size_t index = 0;
    while (index < tasks_.size() && (!before_[index].empty() || IsPlaced(index))) ++index;
    return index;
  }

  // A task whose predecessors all come after it too: then its loop is fed by no other loop. An
  // element's later phases wait for the earlier ones in any case, so they are not the place to cut.
  [[nodiscard]] std::size_t FirstInALoop() const {
    std::vector<std::set<std::size_t>> upstream;
    for (std::size_t i = 0; i < tasks_.size(); ++i) upstream.push_back(Upstream(i));
    std::size_t index = 0;
    const auto is_the_place = [&] {
      return !IsPlaced(index) && !WaitsForItsElement(index) &&
             std::ranges::all_of(upstream[index],
                                 [&](std::size_t each) { return upstream[each].contains(index); });
    };
    while (!is_the_place()) ++index;
    return index;
  }

  [[nodiscard]] bool WaitsForItsElement(std::size_t index) const {
    return std::ranges::any_of(before_[index], [&](std::size_t each) {
      return tasks_[each].element == tasks_[index].element;
    });
  }

  [[nodiscard]] std::set<std::size_t> Upstream(std::size_t index) const {
    std::set<std::size_t> found;
    std::vector<std::size_t> open(before_[index].begin(), before_[index].end());
    while (!open.empty()) {
      const std::size_t each = open.back();
      open.pop_back();
      if (!found.insert(each).second) continue;
      open.insert(open.end(), before_[each].begin(), before_[each].end());
    }
    return found;
  }

  // Edges between other tasks than `late` and `index` stay; so does the order of the phases.
  void Cut(std::size_t index, const std::set<std::size_t>& late) {
    for (const DataEdge& edge : edges_) {
      if (edge.to == index && late.contains(edge.from)) cuts_.push_back(edge);
    }
    for (const std::size_t each : late) before_[index].erase(each);
  }

  void Place(std::size_t index) {
    order_.push_back(index);
    for (auto& waiting : before_) waiting.erase(index);
  }

  std::vector<Task> tasks_;
  std::vector<DataEdge> edges_;
  std::vector<std::set<std::size_t>> before_;  // what each task still waits for
  std::vector<std::size_t> order_;
  std::vector<DataEdge> cuts_;
};

}  // namespace

ExecutionOrder OrderTasks(std::vector<Task> tasks) { return Sorter(std::move(tasks)).Sort(); }

}  // namespace runnel
