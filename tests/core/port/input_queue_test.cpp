#include "core/port/input_queue.h"

#include <array>
#include <string>
#include <vector>

#include "tests/core/port/port_fixture.h"

namespace runnel::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// The queue itself, of both kinds.
template <typename T>
internal::HeldValue<T> Held(const T& value, std::uint64_t sequence) {
  return internal::HeldValue<T>(value, Publication{0, sequence, 0});
}
std::vector<int> PopAll(InputQueue<int>& queue) {
  std::vector<int> values;
  for (InputQueue<int>::Entry entry; queue.Pop(entry);) values.push_back(entry.held.value());
  return values;
}

TEST(InputQueueTest, FirstValueComesBeforeLaterOnes) {
  for (const Writers writers : {Writers::kOne, Writers::kSeveral}) {
    InputQueue<int> queue(4, OnFull::kRefuse, writers);
    queue.PutFirst(Held(10, 1), 7);
    EXPECT_EQ(queue.size(), 1u);
    ASSERT_TRUE(queue.Push(20, {0, 2, 0}, 7));
    ASSERT_TRUE(queue.Push(30, {0, 3, 0}, 7));
    EXPECT_EQ(queue.size(), 3u);
    EXPECT_THAT(PopAll(queue), ElementsAre(10, 20, 30));
    EXPECT_EQ(queue.size(), 0u);
  }
}

TEST(InputQueueTest, FirstValueOvertakesALaterOneThatWasFaster) {
  InputQueue<int> queue(4, OnFull::kRefuse, Writers::kOne);
  ASSERT_TRUE(queue.Push(20, {0, 2, 0}, 7));
  queue.PutFirst(Held(10, 1), 7);
  EXPECT_THAT(PopAll(queue), ElementsAre(10, 20));
}

TEST(InputQueueTest, FirstValueDoesNotOvertakeThoseBeforeItself) {
  InputQueue<int> queue(4, OnFull::kRefuse, Writers::kOne);
  ASSERT_TRUE(queue.Push(10, {0, 1, 0}, 7));
  ASSERT_TRUE(queue.Push(20, {0, 2, 0}, 7));
  queue.PutFirst(Held(20, 2), 7);
  EXPECT_THAT(PopAll(queue), ElementsAre(10, 20));
}

TEST(InputQueueTest, EachPolicyCountsWhatIsLostWhateverTheWriters) {
  struct Case {
    OnFull on_full;
    bool taken;
    std::vector<int> left;
  };
  for (const Writers writers : {Writers::kOne, Writers::kSeveral}) {
    for (const Case& each :
         {Case{OnFull::kDropOldest, true, {4, 5}}, Case{OnFull::kDropNewest, true, {1, 2}},
          Case{OnFull::kRefuse, false, {1, 2}}}) {
      InputQueue<int> queue(2, each.on_full, writers);
      for (int i = 1; i <= 5; ++i) {
        EXPECT_EQ(queue.Push(i, {0, static_cast<std::uint64_t>(i), 0}, 7), i <= 2 || each.taken);
      }
      EXPECT_EQ(queue.dropped(), 3u);
      EXPECT_EQ(PopAll(queue), each.left);
    }
  }
}

// What waits in a queue keeps what it was published with.
TEST(InputQueueTest, EntryTellsSourceAndPublication) {
  for (const Writers writers : {Writers::kOne, Writers::kSeveral}) {
    InputQueue<int> queue(2, OnFull::kRefuse, writers);
    ASSERT_TRUE(queue.Push(5, {11, 12, 13}, 14));
    InputQueue<int>::Entry entry;
    ASSERT_TRUE(queue.Pop(entry));
    EXPECT_EQ(entry.held.value(), 5);
    EXPECT_EQ(entry.source, 14u);
    EXPECT_EQ(entry.held.publication().timestamp, 11);
    EXPECT_EQ(entry.held.publication().sequence, 12u);
    EXPECT_EQ(entry.held.publication().order, 13u);
  }
}

}  // namespace
}  // namespace runnel::test
