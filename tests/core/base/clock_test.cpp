#include "core/base/clock.h"

#include <cmath>

#include <gtest/gtest.h>

namespace runnel {
namespace {

TEST(ManualClockTest, MovesOnlyWhenTold) {
  ManualClock clock;
  EXPECT_EQ(ToSeconds(clock.Now()), 0.0);
  clock.Advance(FromSeconds(0.25));
  EXPECT_EQ(ToSeconds(clock.Now()), 0.25);
}

TEST(ManualClockTest, NeverMovesBackwards) {
  ManualClock clock;
  clock.Set(Time(FromSeconds(2)));
  clock.Set(Time(FromSeconds(1)));
  EXPECT_EQ(ToSeconds(clock.Now()), 2.0);
}

TEST(SteadyClockTest, DoesNotGoBackwards) {
  const SteadyClock clock;
  const Time first = clock.Now();
  EXPECT_GE(clock.Now(), first);
}

TEST(SteadyClockTest, CoarseTimeIsNoLaterButNotBeforeWhatHasJustHappened) {
  const SteadyClock clock;
  // One after the other: the arguments of one call are evaluated in no stated order.
  const Time tick = clock.CoarseNow(Time{});
  EXPECT_LE(tick, clock.Now());
  const Time event = clock.Now();
  const Time coarse = clock.CoarseNow(event);
  EXPECT_GE(coarse, event);
  EXPECT_LE(coarse, clock.Now());
  const Time future = clock.Now() + std::chrono::hours(1);
  EXPECT_LT(clock.CoarseNow(future), future);
}

// So that the age of a value with a nonsensical stamp is a great age, and no negative one.
TEST(FromSecondsTest, WhatNoDurationHoldsIsTheLongest) {
  EXPECT_EQ(FromSeconds(1e12), kFarthest);
  EXPECT_EQ(FromSeconds(-1e12), -kFarthest);
  EXPECT_EQ(FromSeconds(HUGE_VAL), kFarthest);
  EXPECT_EQ(FromSeconds(-HUGE_VAL), -kFarthest);
  EXPECT_EQ(FromSeconds(std::nan("")), Duration::zero());
  EXPECT_GT(Time(FromSeconds(4e9)) - Time(FromSeconds(-1e12)), Duration::zero());
}

TEST(FromSecondsTest, RoundsToTheNearestNanosecond) {
  EXPECT_EQ(FromSeconds(0.1).count(), 100'000'000);
  EXPECT_EQ(FromSeconds(-0.1).count(), -100'000'000);
}

TEST(SaturatingSum, EndsAtTheLastTime) {
  using std::chrono::seconds;
  EXPECT_EQ(SaturatingSum(Time(seconds(1)), seconds(2)), Time(seconds(3)));
  EXPECT_EQ(SaturatingSum(Time(seconds(-1)), Duration::max()), Time::max() - seconds(1));
  EXPECT_EQ(SaturatingSum(Time(seconds(1)), Duration::max()), Time::max());
  EXPECT_EQ(SaturatingSum(Time::max(), Duration(1)), Time::max());
}

}  // namespace
}  // namespace runnel
