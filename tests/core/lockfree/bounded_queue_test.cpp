#include "core/lockfree/bounded_queue.h"

#include <atomic>
#include <memory>
#include <vector>

#include <gmock/gmock.h>

#include "plugins/testing/guards.h"
#include "tests/core/lockfree/pop_all.h"
#include "tests/support/threads.h"
#include "tests/support/wait_until.h"
#include "tests/support/yielding_atomic.h"

namespace runnel {
namespace {

using testing::ElementsAre;

TEST(BoundedQueueTest, GivesWhatItTookInOrder) {
  BoundedQueue<int> queue(3);
  for (int i : {1, 2, 3}) EXPECT_TRUE(queue.TryPush(int{i}));
  EXPECT_EQ(queue.size(), 3u);
  EXPECT_THAT(PopAll(queue), ElementsAre(1, 2, 3));
  EXPECT_EQ(queue.size(), 0u);
}

TEST(BoundedQueueTest, RefusesWhenFullAndLeavesTheValueUntouched) {
  BoundedQueue<std::unique_ptr<int>> queue(1);
  EXPECT_TRUE(queue.TryPush(std::make_unique<int>(1)));
  auto second = std::make_unique<int>(2);
  EXPECT_FALSE(queue.TryPush(std::move(second)));
  ASSERT_NE(second, nullptr);
  std::unique_ptr<int> out;
  ASSERT_TRUE(queue.TryPop(out));
  EXPECT_EQ(*out, 1);
  EXPECT_TRUE(queue.TryPush(std::move(second)));
}

TEST(BoundedQueueTest, WorksForAnyCapacityOverManyLaps) {
  for (std::size_t capacity : {1u, 2u, 3u, 5u, 8u}) {
    BoundedQueue<int> queue(capacity);
    EXPECT_EQ(queue.capacity(), capacity);
    for (int lap = 0; lap < 20; ++lap) {
      for (std::size_t i = 0; i < capacity; ++i) ASSERT_TRUE(queue.TryPush(int{lap}));
      ASSERT_FALSE(queue.TryPush(int{lap}));
      ASSERT_EQ(PopAll(queue), std::vector<int>(capacity, lap));
    }
  }
}

TEST(BoundedQueueTest, HoldsNothingOfWhatHasBeenTakenOut) {
  BoundedQueue<std::shared_ptr<int>> queue(2);
  auto value = std::make_shared<int>(1);
  const std::weak_ptr<int> watch = value;
  ASSERT_TRUE(queue.TryPush(std::move(value)));
  ASSERT_TRUE(queue.TryPop(value));
  value.reset();
  EXPECT_TRUE(watch.expired());
}

TEST(BoundedQueueTest, DestroysWhatIsLeft) {
  auto value = std::make_shared<int>(1);
  const std::weak_ptr<int> watch = value;
  {
    BoundedQueue<std::shared_ptr<int>> queue(2);
    ASSERT_TRUE(queue.TryPush(std::move(value)));
  }
  EXPECT_TRUE(watch.expired());
}

TEST(BoundedQueueTest, RoomForNothingIsAProgrammingError) { EXPECT_THROW(BoundedQueue<int>(0), ProgrammingError); }

TEST(BoundedQueueTest, UsesTheHeapInItsConstructorOnly) {
  BoundedQueue<int> queue(2);
  const test::AllocationGuard guard;
  int value = 1;
  ASSERT_TRUE(queue.TryPush(int{value}));
  ASSERT_TRUE(queue.TryPop(value));
  EXPECT_EQ(guard.allocations(), 0u);
}

// Two writers and two readers: every value comes out once, and those of one writer in its order.
template <template <typename> class Atomic>
void EachValueIsTakenOnceAndInOrder(std::size_t capacity, int per_writer) {
  struct Item {
    unsigned writer = 0;
    int number = 0;
    std::unique_ptr<int> whole;  // a value taken twice would be seen as a lost pointer
  };
  BoundedQueue<Item, Atomic> queue(capacity);
  std::atomic<int> taken{0}, disorder{0}, empty{0};
  std::vector<std::atomic<int>> count(static_cast<std::size_t>(2 * per_writer));
  test::RunTogether(4, [&](unsigned index) {
    if (index < 2) {
      for (int i = 0; i < per_writer; ++i) {
        Item item{index, i, std::make_unique<int>(i)};
        test::YieldUntil("there is room", [&] { return queue.TryPush(std::move(item)); });
      }
      return;
    }
    int last[2] = {-1, -1};
    for (;;) {
      Item item;
      bool is_there = false;
      test::YieldUntil("there is a value, or all have been taken", [&] {
        is_there = queue.TryPop(item);
        return is_there || taken == 2 * per_writer;
      });
      if (!is_there) return;
      ++taken;
      if (item.number <= last[item.writer]) ++disorder;
      last[item.writer] = item.number;
      if (item.whole == nullptr || *item.whole != item.number) ++empty;
      ++count[item.writer * static_cast<std::size_t>(per_writer) + static_cast<std::size_t>(item.number)];
    }
  });
  EXPECT_EQ(disorder, 0);
  EXPECT_EQ(empty, 0);
  for (const auto& each : count) EXPECT_EQ(each, 1);
}

TEST(BoundedQueueStressTest, EachValueIsTakenOnceAndInOrder) {
  EachValueIsTakenOnceAndInOrder<std::atomic>(4, 20000);
  EachValueIsTakenOnceAndInOrder<std::atomic>(1, 5000);
}

TEST(BoundedQueueStressTest, EachValueIsTakenOnceAtAnyInterleaving) {
  for (std::size_t capacity : {1u, 2u, 3u}) {
    EachValueIsTakenOnceAndInOrder<test::YieldingAtomic>(capacity, 1000);
  }
}

}  // namespace
}  // namespace runnel
