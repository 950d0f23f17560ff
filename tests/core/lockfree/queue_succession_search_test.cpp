// Searches the schedules and memory orders of writers that go from one queue to the next while a
// reader empties both.

#include "tests/core/lockfree/search.h"
#include "tests/core/lockfree/searched_atomic.h"
// The search must come first: it renames what the standard headers below use.

#include "core/lockfree/bounded_queue.h"
#include "core/lockfree/queue_succession.h"
#include "core/lockfree/stream_queue.h"

namespace runnel::test {
namespace {

constexpr unsigned kIterations = 100000;

// Each writer puts its first values into the old queue, and its last one into the new one.
struct SuccessionSuite : rl::test_suite<SuccessionSuite, 3> {
  using Queue = BoundedQueue<int, SearchedAtomic>;
  Queue old_queue{4};
  Queue new_queue{2};
  std::array<Queue*, 2> queues{&old_queue, &new_queue};
  std::array<int, 2> last{};

  void TakeOne() {
    (void)PopInOrder(queues, [this](Queue& queue, const auto& may) {
      return queue.TryConsumeIf(may, [this](int value) {
        int& before = last[value / 10];
        RL_ASSERT(value % 10 == before + 1);
        before = value % 10;
      });
    });
  }
  void thread(unsigned index) {
    if (index < 2) {
      const int own = 10 * static_cast<int>(index);
      for (int i = 1; i <= 2; ++i) RL_ASSERT(old_queue.TryPush(own + i));
      RL_ASSERT(new_queue.TryPush(own + 3));
      return;
    }
    for (int attempt = 0; attempt < 5; ++attempt) TakeOne();
  }
  void after() {
    for (int attempt = 0; attempt < 6; ++attempt) TakeOne();
    RL_ASSERT(last[0] == 3 && last[1] == 3);
  }
};

TEST(QueueSuccessionSearch, NoValueOvertakesAnEarlierOneOfItsWriter) {
  EXPECT_TRUE(SearchAtRandom<SuccessionSuite>(kIterations));
}

}  // namespace
}  // namespace runnel::test
