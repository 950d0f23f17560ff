#include "plugins/command_service/hand_leases.h"

#include <gmock/gmock.h>

namespace runnel::test {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Pair;

class HandLeasesTest : public ::testing::Test {
 protected:
  bool Drive(const std::string& lease, std::optional<Duration> deadline = 300ms) {
    return Ask({.lease = lease, .deadline = deadline});
  }
  bool Ask(HandLeases::Request request) {
    request.received = now;
    problem = "";
    if (const auto good = leases.Check("/drive", request, now); !good) {
      problem = good.error().message;
      return false;
    }
    goes_on = leases.Note("/drive", request);
    return true;
  }

  HandLeases leases;
  Time now{1h};
  std::string problem;
  bool goes_on = false;
};

TEST_F(HandLeasesTest, WhoIsHeardOfInTimeDrivesOn) {
  EXPECT_TRUE(Drive("a"));
  EXPECT_FALSE(goes_on);
  for (int i = 0; i < 10; ++i) {
    now += 299ms;
    EXPECT_THAT(leases.Expire(now), IsEmpty());
    EXPECT_TRUE(Drive("a"));
    EXPECT_TRUE(goes_on);
  }
  EXPECT_EQ(leases.StateOf("/drive"), HandState::kDriven);
  EXPECT_EQ(leases.next(), now + 300ms);
}

TEST_F(HandLeasesTest, WhoIsNotHeardOfIsLostAtTheDeadlineAndOnce) {
  Drive("a");
  now += 299ms;
  EXPECT_THAT(leases.Expire(now), IsEmpty());
  now += 1ms;
  EXPECT_THAT(leases.Expire(now), ElementsAre(Pair("/drive", Duration(300ms))));
  EXPECT_THAT(leases.Expire(now), IsEmpty());
  EXPECT_EQ(leases.StateOf("/drive"), HandState::kLost);
  EXPECT_EQ(leases.next(), std::nullopt);
}

TEST_F(HandLeasesTest, WhatComesOfALostHoldIsRefusedAndAnotherHoldIsNot) {
  Drive("a");
  now += 1s;
  (void)leases.Expire(now);
  EXPECT_FALSE(Drive("a"));
  EXPECT_THAT(problem, HasSubstr("has ended"));
  EXPECT_TRUE(Drive("b"));
  EXPECT_EQ(leases.StateOf("/drive"), HandState::kDriven);
}

TEST_F(HandLeasesTest, AValueThatHasWaitedForLongerThanItsDeadlineIsRefused) {
  const Time received = now;
  now += 301ms;
  EXPECT_FALSE(leases.Check("/drive", {.lease = "a", .deadline = 300ms, .received = received}, now));
  EXPECT_TRUE(leases.Check("/drive", {.lease = "a", .deadline = 302ms, .received = received}, now));
  // The deadline counts from when it came, not from when somebody had time for it.
  leases.Note("/drive", {.lease = "a", .deadline = 302ms, .received = received});
  EXPECT_EQ(leases.next(), received + 302ms);
}

TEST_F(HandLeasesTest, OneHoldKeepsOthersOff) {
  Drive("a");
  EXPECT_FALSE(Drive("b"));
  EXPECT_THAT(problem, HasSubstr("somebody else"));
  EXPECT_TRUE(Drive("a", {})) << "its last value";
  EXPECT_EQ(leases.StateOf("/drive"), HandState::kSet);
  EXPECT_TRUE(Drive("b"));
  EXPECT_FALSE(Drive("a")) << "has ended";
}

TEST_F(HandLeasesTest, WhoPublishesWithoutALeaseTakesOver) {
  Drive("a");
  EXPECT_TRUE(Ask({}));
  EXPECT_EQ(leases.StateOf("/drive"), HandState::kSet);
  EXPECT_FALSE(Drive("a"));
  now += 1s;
  EXPECT_THAT(leases.Expire(now), IsEmpty());
}

TEST_F(HandLeasesTest, ReleasedNobodyIsWaitedFor) {
  Drive("a");
  leases.ForgetAll();
  now += 1s;
  EXPECT_THAT(leases.Expire(now), IsEmpty());
  EXPECT_THAT(leases.All(), IsEmpty());
  EXPECT_FALSE(Drive("a"));
}

}  // namespace
}  // namespace runnel::test
