// Calls that wait for their service while STOP is pressed or released.

#include "core/types/text_format.h"
#include "tests/plugins/services/service_fixture.h"

namespace runnel::test {
namespace {

constexpr const char* kPressedSince = "STOP was pressed or released after this was asked for";

class StoppedCallsTest : public ServiceTest {
 protected:
  std::unique_ptr<AnyCall> Begin(int value, const RobotStop::AsOf& as_of = {}) {
    auto call = EditorTest::At<Port>("/app/server/output/twice").FindAnnotation<Callable>()->NewCall();
    *static_cast<int*>(call->arguments()) = value;
    (void)call->Begin(runtime.clock().Now(), 1s, as_of);
    return call;
  }
  CallStatus Poll(AnyCall& call) { return call.Poll(runtime.clock().Now()); }
  void PressAndRelease() {
    stop.Press("a person");
    ASSERT_TRUE(stop.Release("a person"));
  }

  RobotStop& stop = runtime.robot_stop();
};

TEST_F(StoppedCallsTest, WhatWasCalledBeforeAStopIsNotServedUnderIt) {
  const auto call = Begin(3);
  stop.Press("a person");
  Steps(1);
  EXPECT_EQ(Poll(*call), CallStatus::kFailed);
  EXPECT_THAT(call->error(), HasSubstr(kPressedSince));
  EXPECT_EQ(server().served, 0);
  EXPECT_EQ(server().twice.state().failed, 1u);
}

TEST_F(StoppedCallsTest, NorAfterItsRelease) {
  const auto call = Begin(3);
  PressAndRelease();
  const auto after = Begin(4);
  Steps(1);
  EXPECT_EQ(Poll(*call), CallStatus::kFailed);
  EXPECT_THAT(call->error(), HasSubstr(kPressedSince));
  EXPECT_EQ(Poll(*after), CallStatus::kAnswered);
  EXPECT_EQ(server().served, 1);
}

// The clock stands: all of this is at one time.
TEST_F(StoppedCallsTest, EachStopCountsAlsoWhereTheClockStands) {
  for (int round = 0; round < 3; ++round) {
    PressAndRelease();
    const auto call = Begin(3);
    PressAndRelease();
    EXPECT_TRUE(call->Poll(runtime.clock().Now()) == CallStatus::kPending);
    server().twice.Serve();
    EXPECT_EQ(Poll(*call), CallStatus::kFailed);
  }
  EXPECT_EQ(server().served, 0);
}

TEST_F(StoppedCallsTest, WhatIsCalledUnderAStopIsServedUnderThatOneOnly) {
  stop.Press("a person");
  const auto served = Begin(1);
  Steps(1);
  EXPECT_EQ(Poll(*served), CallStatus::kAnswered);

  const auto released = Begin(2);
  ASSERT_TRUE(stop.Release("a person"));
  Steps(1);
  EXPECT_EQ(Poll(*released), CallStatus::kFailed);

  stop.Press("a person");
  const auto under_another = Begin(3);
  ASSERT_TRUE(stop.Release("a person"));
  stop.Press("a person");
  Steps(1);
  EXPECT_EQ(Poll(*under_another), CallStatus::kFailed);

  const auto pressed_again = Begin(4);
  stop.Press("somebody else");
  Steps(1);
  EXPECT_EQ(Poll(*pressed_again), CallStatus::kFailed);
  EXPECT_EQ(server().served, 1);
}

TEST_F(StoppedCallsTest, WhoSaysSinceWhenHeKnowsIsRefusedAtOnce) {
  const RobotStop::AsOf before = stop.AsOfNow();
  PressAndRelease();
  const auto call = Begin(3, before);
  EXPECT_EQ(Poll(*call), CallStatus::kFailed);
  EXPECT_THAT(call->error(), HasSubstr(kPressedSince));
  const auto known = Begin(3, stop.AsOfNow());
  Steps(1);
  EXPECT_EQ(Poll(*known), CallStatus::kAnswered);
  EXPECT_EQ(server().served, 1);
}

// A command may come from another module, too.
TEST_F(StoppedCallsTest, CallsOfModulesCountAsThoseOfPersonsDo) {
  asker().Ask(3);
  ASSERT_EQ(asker().twice.Send(4), CallStatus::kPending);
  auto future = asker().twice.Begin(5);
  PressAndRelease();
  Steps(1);
  EXPECT_THAT(asker().told, ElementsAre(HasSubstr(std::string("failed: ") + kPressedSince)));
  EXPECT_EQ(future.outcome().status(), CallStatus::kFailed);
  EXPECT_EQ(server().served, 0);
  asker().Ask(6);
  Steps(1);
  EXPECT_THAT(asker().told, ElementsAre(HasSubstr(kPressedSince), "12"));
}

TEST_F(StoppedCallsTest, AModuleThatIsPausedDoesNotServeItWhenItRunsAgain) {
  const auto call = Begin(3);
  ASSERT_TRUE(scheduler.SetPaused("/app/server", true));
  Steps(2);
  EXPECT_EQ(Poll(*call), CallStatus::kPending);
  PressAndRelease();
  ASSERT_TRUE(scheduler.SetPaused("/app/server", false));
  Steps(1);
  EXPECT_EQ(Poll(*call), CallStatus::kFailed);
  EXPECT_EQ(server().served, 0);
}

}  // namespace
}  // namespace runnel::test
