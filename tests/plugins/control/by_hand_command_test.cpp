// Values that are set by hand from a terminal.

#include "tests/plugins/control/control_fixture.h"

namespace runnel::test {

TEST_F(ControlTest, SetsAPortByHandAndReleasesIt) {
  ASSERT_EQ(Change("connect /a/out /b/in").code, 0);
  const Told set = Ask("publish /b/in -5");
  EXPECT_EQ(set.code, 0) << set.errors;
  EXPECT_THAT(set.output, HasSubstr("'runnel release /app/b/input/in' ends that"));
  EXPECT_THAT(Ask("echo /b/in count=1").output, HasSubstr("  -5\n"));
  EXPECT_THAT(Ask("ls /b").output, HasSubstr("set by hand = -5"));
  EXPECT_THAT(Ask("log").output, HasSubstr("publish /app/b/input/in -5"));
  EXPECT_EQ(Ask("release /b/in").code, 0);
  EXPECT_THAT(Ask("ls /b").output, ::testing::Not(HasSubstr("by hand")));
  EXPECT_THAT(Ask("release /b/in").errors, HasSubstr("is not set by hand"));
  EXPECT_THAT(Ask("release").errors, HasSubstr("STOP is not in force"));
}

TEST_F(ControlTest, PublishesByHandAgainAndAgain) {
  ASSERT_EQ(Ask("publish /a/out 9 rate=500").code, 0);
  const Told told = Ask("echo /a/out count=3");
  EXPECT_EQ(std::count(told.output.begin(), told.output.end(), '\n'), 3);
  EXPECT_THAT(told.output, HasSubstr("  9"));
  EXPECT_THAT(Ask("ls /a").output, HasSubstr("set by hand = 9"));
  EXPECT_THAT(Ask("release /a/out").output, HasSubstr("released /app/a/output/out"));
}

TEST_F(ControlTest, APortThatIsBlockedTakesNoOtherValue) {
  EXPECT_THAT(Ask("block /b/in").errors, HasSubstr("no safe value"));
  ASSERT_TRUE(dynamic_cast<Port&>(*runtime.root().Find("/app/b/input/in").value()).SetLimits({.default_value = 0}));
  EXPECT_THAT(Ask("block /b/in").output, HasSubstr("/app/b/input/in is blocked"));
  EXPECT_THAT(Ask("publish /b/in 5").errors, HasSubstr("is blocked; release it first"));
  EXPECT_EQ(Ask("release /b/in").code, 0);
  EXPECT_THAT(Ask("publish /b/in 5 deadline=60s").output, HasSubstr("for 60s, then at rest"));
  EXPECT_EQ(Ask("release /b/in").code, 0);
}

TEST_F(ControlTest, RefusesWhatCannotBeSetByHand) {
  EXPECT_THAT(Ask("publish /b/in many").errors, HasSubstr("many"));
  EXPECT_THAT(Ask("publish /b/in 5 deadline=soon").errors, HasSubstr("soon"));
  EXPECT_THAT(Ask("publish /b/in 5 deadline=61s").errors, HasSubstr("from 10ms to 60s"));
  EXPECT_THAT(Ask("publish /b/inn 5").errors, HasSubstr("did you mean 'in'?"));
  EXPECT_THAT(Ask("publish /b/in 5 rate=often").errors, HasSubstr("rate"));
  EXPECT_THAT(Ask("publish /b/in").errors, HasSubstr("wants a value"));
  EXPECT_THAT(Ask("publish /b 5").errors, HasSubstr("is not a port"));
}

}  // namespace runnel::test
