#pragma once

#include <vector>

namespace runnel {

/// What is in a queue of numbers, in its order; the queue is empty then.
template <typename Queue>
std::vector<int> PopAll(Queue& queue) {
  std::vector<int> values;
  for (int value = 0; queue.TryPop(value);) values.push_back(value);
  return values;
}

}  // namespace runnel
