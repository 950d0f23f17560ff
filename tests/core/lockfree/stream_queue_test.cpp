#include "core/lockfree/stream_queue.h"

#include <atomic>
#include <memory>
#include <string>
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

TEST(StreamQueueTest, GivesWhatItTookInOrder) {
  StreamQueue<int> queue(3);
  for (int i : {1, 2, 3}) EXPECT_TRUE(queue.TryPush(int{i}));
  EXPECT_EQ(queue.size(), 3u);
  EXPECT_THAT(PopAll(queue), ElementsAre(1, 2, 3));
  EXPECT_EQ(queue.size(), 0u);
}

TEST(StreamQueueTest, RefusesWhenFullAndLeavesTheValueUntouched) {
  StreamQueue<std::unique_ptr<int>> queue(1);
  EXPECT_TRUE(queue.TryPush(std::make_unique<int>(1)));
  auto second = std::make_unique<int>(2);
  EXPECT_FALSE(queue.TryPush(std::move(second)));
  EXPECT_FALSE(queue.TryEmplace(std::move(second)));
  ASSERT_NE(second, nullptr);
  std::unique_ptr<int> out;
  ASSERT_TRUE(queue.TryPop(out));
  EXPECT_EQ(*out, 1);
  EXPECT_TRUE(queue.TryPush(std::move(second)));
}

TEST(StreamQueueTest, WorksForAnyCapacityOverManyLaps) {
  for (std::size_t capacity : {1u, 2u, 3u, 5u, 8u}) {
    StreamQueue<int> queue(capacity);
    EXPECT_EQ(queue.capacity(), capacity);
    for (int lap = 0; lap < 20; ++lap) {
      for (std::size_t i = 0; i < capacity; ++i) ASSERT_TRUE(queue.TryPush(int{lap}));
      ASSERT_FALSE(queue.TryPush(int{lap}));
      ASSERT_EQ(PopAll(queue), std::vector<int>(capacity, lap));
    }
  }
}

TEST(StreamQueueTest, TakesInAsManyAsHaveBeenTakenOut) {
  StreamQueue<int> queue(3);
  for (int i : {1, 2, 3}) ASSERT_TRUE(queue.TryPush(int{i}));
  int value = 0;
  for (int i = 0; i < 2; ++i) ASSERT_TRUE(queue.TryPop(value));
  EXPECT_TRUE(queue.TryPush(4));
  EXPECT_TRUE(queue.TryPush(5));
  EXPECT_FALSE(queue.TryPush(6));
  EXPECT_THAT(PopAll(queue), ElementsAre(3, 4, 5));
}

TEST(StreamQueueTest, FrontStaysUntilItIsPopped) {
  StreamQueue<std::string> queue(2);
  EXPECT_EQ(queue.Front(), nullptr);
  ASSERT_TRUE(queue.TryPush("first"));
  ASSERT_TRUE(queue.TryPush("second"));
  ASSERT_NE(queue.Front(), nullptr);
  EXPECT_EQ(*queue.Front(), "first");
  EXPECT_EQ(queue.Front(), queue.Front());
  EXPECT_FALSE(queue.TryPush("third"));
  queue.PopFront();
  ASSERT_NE(queue.Front(), nullptr);
  EXPECT_EQ(*queue.Front(), "second");
}

// Can be moved to a new place only, and has no default.
struct Rigid {
  explicit Rigid(int made_as) : number(made_as) {}
  Rigid(Rigid&& other) noexcept = default;
  Rigid& operator=(Rigid&&) = delete;
  const int number;
};

TEST(StreamQueueTest, NeedsNeitherDefaultNorAssignment) {
  StreamQueue<Rigid> queue(2);
  ASSERT_TRUE(queue.TryPush(Rigid(7)));
  ASSERT_NE(queue.Front(), nullptr);
  EXPECT_EQ(queue.Front()->number, 7);
}

TEST(StreamQueueTest, DestroysWhatIsTakenOutAndWhatIsLeft) {
  auto value = std::make_shared<int>(1);
  {
    StreamQueue<std::shared_ptr<int>> queue(4);
    for (int i = 0; i < 4; ++i) ASSERT_TRUE(queue.TryEmplace(value));
    EXPECT_EQ(value.use_count(), 5);
    queue.PopFront();
    EXPECT_EQ(value.use_count(), 4);
    std::shared_ptr<int> out;
    ASSERT_TRUE(queue.TryPop(out));
    EXPECT_EQ(value.use_count(), 4);
    out.reset();
    EXPECT_EQ(value.use_count(), 3);
  }
  EXPECT_EQ(value.use_count(), 1);
}

TEST(StreamQueueTest, RoomForNothingIsAProgrammingError) { EXPECT_THROW(StreamQueue<int>(0), ProgrammingError); }

TEST(StreamQueueTest, UsesTheHeapInItsConstructorOnly) {
  StreamQueue<int> queue(2);
  const test::AllocationGuard guard;
  int value = 1;
  ASSERT_TRUE(queue.TryPush(int{value}));
  ASSERT_TRUE(queue.TryPop(value));
  EXPECT_EQ(guard.allocations(), 0u);
}

// One writer and one reader, while a third asks for the size.
template <template <typename> class Atomic>
void EachValueComesOutOnceInOrderAndWhole(std::size_t capacity, int count) {
  struct Item {
    std::unique_ptr<int> whole;  // can only be moved
    int number = 0;
    int again[20] = {};
  };
  StreamQueue<Item, Atomic> queue(capacity);
  std::atomic<int> wrong{0}, oversized{0};
  std::atomic<bool> done{false};
  test::RunTogether(3, [&](unsigned index) {
    if (index == 0) {
      for (int i = 0; i < count; ++i) {
        Item item{std::make_unique<int>(i), i, {}};
        for (int& each : item.again) each = i;
        test::YieldUntil("there is room", [&] { return queue.TryPush(std::move(item)); });
      }
    } else if (index == 1) {
      for (int i = 0; i < count; ++i) {
        Item item;
        test::YieldUntil("there is a value", [&] { return queue.TryPop(item); });
        if (item.number != i || item.whole == nullptr || *item.whole != i) ++wrong;
        for (const int each : item.again) wrong += each != i;
      }
      done = true;
    } else {
      // Between its two looks both sides go on; it cannot tell more than has ever come.
      while (!done) {
        if (queue.size() > static_cast<std::size_t>(count)) ++oversized;
        std::this_thread::yield();
      }
    }
  });
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(oversized, 0);
  EXPECT_EQ(queue.size(), 0u);
}

TEST(StreamQueueStressTest, EachValueComesOutOnceInOrderAndWhole) {
  for (std::size_t capacity : {1u, 2u, 7u, 64u}) {
    EachValueComesOutOnceInOrderAndWhole<std::atomic>(capacity, 20000);
  }
}

TEST(StreamQueueStressTest, EachValueComesOutOnceAtAnyInterleaving) {
  for (std::size_t capacity : {1u, 2u, 3u}) {
    EachValueComesOutOnceInOrderAndWhole<test::YieldingAtomic>(capacity, 2000);
  }
}

}  // namespace
}  // namespace runnel
