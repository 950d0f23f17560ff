#include <gmock/gmock.h>

#include "plugins/command_service/hand_settings.h"

namespace runnel::test {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

class HandLeasesTest : public ::testing::Test {
 protected:
  bool Drive(const std::string& lease, std::optional<Duration> deadline = 300ms) {
    return Ask({.lease = lease, .deadline = deadline});
  }
  bool Ask(HandHold::Request request) {
    request.received = now;
    problem = "";
    if (!hold) hold = std::make_unique<HandHold>(ended);
    if (const auto good = hold->Check(request, now); !good) {
      problem = good.error().message;
      return false;
    }
    goes_on = hold->Note(request);
    return true;
  }

  std::shared_ptr<EndedLeases> ended = std::make_shared<EndedLeases>();
  std::unique_ptr<HandHold> hold;
  Time now{1h};
  std::string problem;
  bool goes_on = false;
};

TEST_F(HandLeasesTest, WhoIsHeardOfInTimeDrivesOn) {
  EXPECT_TRUE(Drive("a"));
  EXPECT_FALSE(goes_on);
  for (int i = 0; i < 10; ++i) {
    now += 299ms;
    EXPECT_TRUE(Drive("a"));
    EXPECT_TRUE(goes_on);
  }
  EXPECT_EQ(hold->state(), HandState::kDriven);
  EXPECT_EQ(hold->due(), now + 300ms);
}

TEST_F(HandLeasesTest, WhatComesOfALostHoldIsRefusedAndAnotherHoldIsNot) {
  Drive("a");
  now += 1s;
  hold->NoteLost();
  EXPECT_EQ(hold->state(), HandState::kLost);
  EXPECT_EQ(hold->due(), std::nullopt);
  EXPECT_FALSE(Drive("a"));
  EXPECT_THAT(problem, HasSubstr("has ended"));
  EXPECT_TRUE(Drive("b"));
  EXPECT_EQ(hold->state(), HandState::kDriven);
}

// By a button that is held through STOP and its release; the last value, without a deadline, is no motion.
TEST_F(HandLeasesTest, AStopEndsAHoldAndWhoLetsGoIsHeard) {
  EXPECT_TRUE(Drive("a"));
  EXPECT_FALSE(Ask({.lease = "a", .deadline = 300ms, .stops = 2}));
  EXPECT_THAT(problem, HasSubstr("STOP has ended this hold"));
  EXPECT_TRUE(Ask({.lease = "a", .stops = 2}));
  EXPECT_TRUE(Ask({.lease = "b", .deadline = 300ms, .stops = 2}));
}

TEST_F(HandLeasesTest, AValueThatHasWaitedForLongerThanItsDeadlineIsRefused) {
  HandHold late(ended);
  const Time received = now;
  now += 301ms;
  EXPECT_FALSE(late.Check({.lease = "a", .deadline = 300ms, .received = received}, now));
  EXPECT_TRUE(late.Check({.lease = "a", .deadline = 302ms, .received = received}, now));
  // The deadline counts from when it came, not from when somebody had time for it.
  late.Note({.lease = "a", .deadline = 302ms, .received = received});
  EXPECT_EQ(late.due(), received + 302ms);
}

TEST_F(HandLeasesTest, OneHoldKeepsOthersOff) {
  Drive("a");
  EXPECT_FALSE(Drive("b"));
  EXPECT_THAT(problem, HasSubstr("somebody else"));
  EXPECT_TRUE(Drive("a", {})) << "its last value";
  EXPECT_EQ(hold->state(), HandState::kSet);
  EXPECT_TRUE(Drive("b"));
  EXPECT_FALSE(Drive("a")) << "has ended";
}

TEST_F(HandLeasesTest, WhoPublishesWithoutALeaseTakesOver) {
  Drive("a");
  EXPECT_TRUE(Ask({}));
  EXPECT_EQ(hold->state(), HandState::kSet);
  EXPECT_FALSE(Drive("a"));
  EXPECT_EQ(hold->due(), std::nullopt);
}

TEST_F(HandLeasesTest, AHoldThatGoesEndsItsLease) {
  Drive("a");
  hold.reset();
  EXPECT_FALSE(Drive("a"));
  EXPECT_TRUE(Drive("b"));
}

}  // namespace
}  // namespace runnel::test
