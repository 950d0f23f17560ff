#include "core/channel/input_queue.h"

#include <array>
#include <string>
#include <vector>

#include "tests/core/port/port_fixture.h"

namespace runnel::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// The queue itself, of both kinds, for values of type int.
class IntQueue {
 public:
  IntQueue(std::size_t capacity, OnFull on_full, Writers writers) : queue_(capacity, on_full, writers) {}

  bool Push(int value, const Publication& publication, std::uint64_t source) {
    return queue_.Push(&value, publication, source);
  }
  void PutFirst(int value, std::uint64_t sequence, std::uint64_t source) {
    queue_.PutFirst(&value, {0, sequence, 0}, source);
  }
  bool Pop(internal::HeldValue<int>& held, std::uint64_t& source) {
    return queue_.Pop([&](internal::Queued<int>& queued) {
      source = queued.source;
      internal::MoveTo<int>(held, queued);
    });
  }
  std::vector<int> PopAll() {
    std::vector<int> values;
    internal::HeldValue<int> held;
    for (std::uint64_t source = 0; Pop(held, source);) values.push_back(held.value());
    return values;
  }
  [[nodiscard]] const InputQueueBase& base() const { return queue_; }

 private:
  InputQueue<internal::Queued<int>> queue_;
};

TEST(InputQueueTest, FirstValueComesBeforeLaterOnes) {
  for (const Writers writers : {Writers::kOne, Writers::kSeveral}) {
    IntQueue queue(4, OnFull::kRefuse, writers);
    queue.PutFirst(10, 1, 7);
    EXPECT_EQ(queue.base().size(), 1u);
    ASSERT_TRUE(queue.Push(20, {0, 2, 0}, 7));
    ASSERT_TRUE(queue.Push(30, {0, 3, 0}, 7));
    EXPECT_EQ(queue.base().size(), 3u);
    EXPECT_THAT(queue.PopAll(), ElementsAre(10, 20, 30));
    EXPECT_EQ(queue.base().size(), 0u);
  }
}

TEST(InputQueueTest, FirstValueOvertakesALaterOneThatWasFaster) {
  IntQueue queue(4, OnFull::kRefuse, Writers::kOne);
  ASSERT_TRUE(queue.Push(20, {0, 2, 0}, 7));
  queue.PutFirst(10, 1, 7);
  EXPECT_THAT(queue.PopAll(), ElementsAre(10, 20));
}

TEST(InputQueueTest, FirstValueDoesNotOvertakeThoseBeforeItself) {
  IntQueue queue(4, OnFull::kRefuse, Writers::kOne);
  ASSERT_TRUE(queue.Push(10, {0, 1, 0}, 7));
  ASSERT_TRUE(queue.Push(20, {0, 2, 0}, 7));
  queue.PutFirst(20, 2, 7);
  EXPECT_THAT(queue.PopAll(), ElementsAre(10, 20));
}

TEST(InputQueueTest, EachPolicyCountsWhatIsLostWhateverTheWriters) {
  struct Case {
    OnFull on_full;
    bool taken;
    std::vector<int> left;
  };
  for (const Writers writers : {Writers::kOne, Writers::kSeveral}) {
    for (const Case& each : {Case{OnFull::kDropOldest, true, {4, 5}}, Case{OnFull::kDropNewest, true, {1, 2}},
                             Case{OnFull::kRefuse, false, {1, 2}}}) {
      IntQueue queue(2, each.on_full, writers);
      for (int i = 1; i <= 5; ++i) {
        EXPECT_EQ(queue.Push(i, {0, static_cast<std::uint64_t>(i), 0}, 7), i <= 2 || each.taken);
      }
      EXPECT_EQ(queue.base().dropped(), 3u);
      EXPECT_EQ(queue.PopAll(), each.left);
    }
  }
}

// What waits in a queue keeps what it was published with, but for the order among sources, which it has by its
// place.
TEST(InputQueueTest, EntryTellsSourceAndPublication) {
  for (const Writers writers : {Writers::kOne, Writers::kSeveral}) {
    IntQueue queue(2, OnFull::kRefuse, writers);
    ASSERT_TRUE(queue.Push(5, {11, 12, 13, 15}, 14));
    internal::HeldValue<int> held;
    std::uint64_t source = 0;
    ASSERT_TRUE(queue.Pop(held, source));
    EXPECT_EQ(held.value(), 5);
    EXPECT_EQ(source, 14u);
    EXPECT_EQ(held.publication().timestamp, 11);
    EXPECT_EQ(held.publication().sequence, 12u);
    EXPECT_EQ(held.publication().publication_time, 15);
  }
}

}  // namespace
}  // namespace runnel::test
