#include "tests/core/lockfree/searched_atomic.h"
// The search must come first: it renames what the standard headers below use.

#include "core/lockfree/bounded_queue.h"

namespace runnel::test {
namespace {

constexpr unsigned kIterations = 100000;

// Two writers, two readers: each value is taken once, and what one put in before pushing the other
// may touch after popping. Room for one forces every lap.
struct BoundedQueueSuite : rl::test_suite<BoundedQueueSuite, 4> {
  BoundedQueue<SearchedPlain, SearchedAtomic> queue{2};
  rl::var<int> seen[5];

  void before() {
    for (auto& each : seen) each($) = 0;
  }
  void thread(unsigned index) {
    if (index < 2) {
      for (int i = 1; i <= 2; ++i) {
        (void)queue.TryPush(SearchedPlain(static_cast<int>(2 * index) + i));
      }
      return;
    }
    for (int i = 0; i < 2; ++i) {
      SearchedPlain value;
      if (!queue.TryPop(value)) continue;
      RL_ASSERT(value.Get() >= 1 && value.Get() <= 4);
      auto& count = seen[value.Get()];
      RL_ASSERT(count($) == 0);
      count($) = 1;
    }
  }
};

TEST(BoundedQueueSearch, EachValueIsTakenOnceAndWhole) {
  EXPECT_TRUE(Search<BoundedQueueSuite>(kIterations));
}

}  // namespace
}  // namespace runnel::test
