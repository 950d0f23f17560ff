#include "core/lockfree/latest_value.h"

#include <array>
#include <atomic>

#include <gtest/gtest.h>

#include "plugins/testing/guards.h"
#include "tests/support/threads.h"
#include "tests/support/yielding_atomic.h"

namespace runnel {
namespace {

struct Pose {
  double x;
  double y;
  float heading;
};

TEST(LatestValueTest, HasNothingBeforeTheFirstPublication) {
  LatestValue<int> latest;
  int value = 7;
  Publication publication;
  EXPECT_FALSE(latest.Read(value, publication));
  EXPECT_EQ(value, 7);
  EXPECT_EQ(latest.sequence(), 0u);
}

TEST(LatestValueTest, GivesTheNewestValueWithItsStampNumberAndOrder) {
  LatestValue<Pose> latest;
  for (int i = 1; i <= 10; ++i) latest.Publish({1.0 * i, 2.0 * i, 0.5F}, 100 * i, 200 * i, 7);
  Pose pose{};
  Publication publication;
  ASSERT_TRUE(latest.Read(pose, publication));
  EXPECT_EQ(pose.x, 10.0);
  EXPECT_EQ(pose.y, 20.0);
  EXPECT_EQ(pose.heading, 0.5F);
  EXPECT_EQ(publication.timestamp, 1000);
  EXPECT_EQ(publication.publication_time, 2000);
  EXPECT_EQ(publication.sequence, 10u);
  EXPECT_EQ(publication.order, 7u);
  EXPECT_EQ(latest.sequence(), 10u);
}

TEST(LatestValueTest, CarriesTypesThatFillNoWholeWords) {
  LatestValue<std::array<char, 3>> latest;
  latest.Publish({'a', 'b', 'c'}, 0);
  std::array<char, 3> characters{};
  Publication publication;
  ASSERT_TRUE(latest.Read(characters, publication));
  EXPECT_EQ(characters, (std::array<char, 3>{'a', 'b', 'c'}));
}

TEST(LatestValueTest, PublishesAndReadsWithoutTheHeap) {
  LatestValue<Pose> latest;
  Pose pose{};
  Publication publication;
  const test::AllocationGuard guard;
  latest.Publish(pose, 1);
  ASSERT_TRUE(latest.Read(pose, publication));
  EXPECT_EQ(guard.allocations(), 0u);
}

// A writer that laps its readers again and again.
template <template <typename> class Atomic, std::size_t kCells>
void ReadersSeeWholeValuesInOrder(std::uint64_t publications) {
  using Words = std::array<std::uint64_t, 8>;
  LatestValue<Words, Atomic, kCells> latest;
  std::atomic<std::uint64_t> torn{0}, backward{0}, reads{0};
  test::RunTogether(3, [&](unsigned index) {
    if (index == 0) {
      for (std::uint64_t i = 1; i <= publications; ++i) {
        Words words;
        words.fill(i);
        latest.Publish(words, static_cast<std::int64_t>(i), -static_cast<std::int64_t>(i), i);
      }
      return;
    }
    for (std::uint64_t last = 0; last < publications;) {
      Words words;
      Publication publication;
      if (!latest.Read(words, publication)) continue;
      Words expected;
      expected.fill(publication.sequence);
      if (words != expected || publication.order != publication.sequence ||
          static_cast<std::uint64_t>(publication.timestamp) != publication.sequence ||
          publication.publication_time != -publication.timestamp) {
        ++torn;
      }
      if (publication.sequence < last) ++backward;
      last = publication.sequence;
      ++reads;
    }
  });
  EXPECT_EQ(torn, 0u);
  EXPECT_EQ(backward, 0u);
  EXPECT_GE(reads, 2u);
}

TEST(LatestValueStressTest, ReadersSeeWholeValuesInOrder) {
  ReadersSeeWholeValuesInOrder<std::atomic, 4>(100000);
  ReadersSeeWholeValuesInOrder<std::atomic, 1>(20000);
}

TEST(LatestValueStressTest, ReadersSeeWholeValuesInOrderAtAnyInterleaving) {
  ReadersSeeWholeValuesInOrder<test::YieldingAtomic, 1>(1000);
  ReadersSeeWholeValuesInOrder<test::YieldingAtomic, 2>(1000);
  ReadersSeeWholeValuesInOrder<test::YieldingAtomic, 4>(1000);
}

}  // namespace
}  // namespace runnel
