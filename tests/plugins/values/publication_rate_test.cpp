// How often ports publish, as people are told it.

#include <chrono>

#include <gmock/gmock.h>

#include "core/module/group.h"
#include "core/port/output.h"
#include "plugins/values/watched_port.h"

namespace runnel::test {
namespace {

using namespace std::chrono_literals;

class PublicationRateTest : public ::testing::Test {
 protected:
  PublicationRateTest() { runtime.set_clock(clock); }
  // Publishes each `period` for so long, and looks each half second, as a page does.
  std::vector<double> RatesDuring(Duration length, Duration period, Duration first = 0ms) {
    std::vector<double> rates;
    const Time begun = clock.Now();
    for (Duration at = 0ms; at < length; at += 10ms) {
      clock.Set(begun + at);
      if (period > 0ms && at >= first && (at - first) % period == 0ms) out.Publish(1);
      if (at % 500ms == 0ms) rates.push_back(Look());
    }
    clock.Set(begun + length);
    return rates;
  }
  double Look() {
    const std::lock_guard lock(runtime.structure_mutex());
    return rate.Look(Publications::Of(out), clock.Now());
  }

  ManualClock clock;
  Runtime runtime;
  Group& app = runtime.Create<Group>(runtime.root(), "app");
  Output<int> out{app, "out"};
  PublicationRate rate;
};

TEST_F(PublicationRateTest, FiveHertzAreNeverFourOrSix) {
  RatesDuring(1s, 200ms);
  EXPECT_THAT(RatesDuring(5s, 200ms), ::testing::Each(::testing::DoubleNear(5, 1e-9)));
}

TEST_F(PublicationRateTest, WhatComesLessOftenThanSomebodyLooksHasItsRate) {
  RatesDuring(5s, 1600ms);
  EXPECT_THAT(RatesDuring(8s, 1600ms, 1400ms), ::testing::Each(::testing::DoubleNear(1 / 1.6, 1e-9)));
}

TEST_F(PublicationRateTest, NothingForTwoPeriodsIsNoRateAndTheGapDoesNotCount) {
  RatesDuring(2s, 200ms);
  RatesDuring(1s, 0ms);
  EXPECT_EQ(Look(), 0);
  RatesDuring(1s, 200ms);
  EXPECT_NEAR(Look(), 5, 1e-9);
}

TEST_F(PublicationRateTest, OnePublicationIsNoRate) {
  out.Publish(1);
  EXPECT_THAT(RatesDuring(2s, 0ms), ::testing::Each(0));
}

}  // namespace
}  // namespace runnel::test
