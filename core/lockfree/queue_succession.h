#pragma once

#include <cstddef>
#include <utility>

namespace runnel {

/// Takes the oldest value out of `queues`, each of which has replaced the one before, while writers
/// may still be on their way from one to the next. No writer's value is overtaken by its later ones.
///
/// A writer may fill the old queue after that has been found empty, and then the new one. So a value
/// of a newer queue is taken only if the older ones are still empty when it has been seen: what its
/// writer had put into them before is visible then. An older queue in which a writer has claimed a
/// cell and not filled it yet counts as not empty, since filled cells may lie behind that one.
///
/// @param queues  pointers to them, the oldest first; by index, with size().
/// @param pop_if  pop_if(queue, may): takes the oldest value out of `queue` if may() is true once the
///                value has been seen; returns whether it did (BoundedQueue::TryConsumeIf()).
/// Returns false if there is none, or if the oldest is just on its way.
template <typename Queues, typename PopIf>
[[nodiscard]] bool PopInOrder(const Queues& queues, PopIf&& pop_if) {
  for (std::size_t i = 0; i < queues.size(); ++i) {
    const auto older_are_empty = [&queues, i] {
      for (std::size_t older = 0; older < i; ++older) {
        if (queues[older]->size() > 0) return false;
      }
      return true;
    };
    if (pop_if(*queues[i], older_are_empty)) return true;
  }
  return false;
}

}  // namespace runnel
