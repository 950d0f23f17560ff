// Values of a machine with another clock.
#include "plugins/network_discovery/writer_clock.h"

#include <cstring>
#include <thread>
#include <utility>

#include <gmock/gmock.h>

#include "tests/plugins/network/network_member.h"

namespace runnel::test {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::HasSubstr;

TEST(WriterClockTest, TheSmallestDelayOfLateTells) {
  WriterClock clock;
  const Time start(seconds(1000));
  EXPECT_FALSE(clock.least().has_value());
  clock.Note(milliseconds(40), start);
  EXPECT_EQ(clock.ahead(), Duration{});  // as the network takes it
  clock.Note(-milliseconds(900), start + milliseconds(1));
  clock.Note(-milliseconds(700), start + milliseconds(2));
  EXPECT_EQ(clock.ahead(), milliseconds(900));
  // The clock is set: after a while that is believed.
  for (int i = 1; i < 150; ++i) clock.Note(milliseconds(20), start + seconds(i));
  EXPECT_EQ(clock.ahead(), Duration{});
}

// Whether its clock is behind or its values are held up cannot be told from here.
TEST(WriterClockTest, WhatIsHeldUpIsOldHoweverLong) {
  WriterClock clock;
  for (int i = 0; i < 600; ++i) clock.Note(milliseconds(400), Time(seconds(1000 + i)));
  EXPECT_EQ(clock.least(), milliseconds(400));
  EXPECT_EQ(clock.ahead(), Duration{});
}

TEST(WriterClockTest, WhatTakesMuchLongerThanOthersWasHeldUp) {
  WriterClock clock;
  Time now(seconds(1000));
  const auto held_up = [&](Duration delay, Duration gap = milliseconds(100)) {
    return clock.HeldUp(delay, now += gap);
  };
  EXPECT_EQ(held_up(milliseconds(400)), Duration{}) << "nobody knows: its clock may be behind";
  EXPECT_EQ(held_up(milliseconds(430)), Duration{});
  EXPECT_NEAR(ToSeconds(held_up(seconds(3), seconds(3))), 2.6, 0.01) << "a link that was down";
  EXPECT_EQ(held_up(milliseconds(420)), Duration{});
  // A queue that grows, and stays so: nothing of it is news.
  for (int i = 1; i <= 26; ++i) (void)held_up(milliseconds(400 + i * 100));
  for (int i = 0; i < 1000; ++i) EXPECT_GT(held_up(seconds(3)), milliseconds(2400)) << i;
  EXPECT_EQ(held_up(milliseconds(420)), Duration{});
}

TEST(WriterClockTest, AClockThatHasBeenSetJumps) {
  WriterClock clock;
  Time now(seconds(1000));
  const auto held_up = [&](Duration delay) { return clock.HeldUp(delay, now += milliseconds(100)); };
  (void)held_up(milliseconds(1));
  EXPECT_EQ(held_up(seconds(10)), Duration{});
  EXPECT_EQ(held_up(seconds(10)), Duration{});
  EXPECT_EQ(held_up(-seconds(10)), Duration{}) << "and back";
  // Two clocks do not go alike.
  Duration delay = -seconds(10);
  for (int i = 0; i < 100'000; ++i) ASSERT_EQ(held_up(delay += std::chrono::microseconds(5)), Duration{}) << i;
}

// What both clocks say, until so much has come that it is known what is usual.
TEST(WriterClockTest, OfAWriterThatNobodyKnowsWhatComesMayHaveBeenHeldUp) {
  WriterClock clock;
  Time now(seconds(1000));
  const auto ago = [&](Duration delay, Duration gap) {
    EXPECT_EQ(clock.HeldUp(delay, now += gap), Duration{});
    return now - clock.sent();
  };
  EXPECT_EQ(ago(seconds(3), {}), seconds(3));
  EXPECT_EQ(ago(seconds(3), milliseconds(100)), seconds(3));
  EXPECT_EQ(ago(milliseconds(3200), milliseconds(200)), milliseconds(3200)) << "as within a burst with a pause";
  EXPECT_EQ(ago(seconds(3), WriterClock::kToKnow), Duration{}) << "its clock is behind";
  EXPECT_EQ(ago(milliseconds(3200), milliseconds(200)), Duration{}) << "no longer than networks take";
  (void)clock.HeldUp(seconds(5), now += seconds(2));
  EXPECT_NEAR(ToSeconds(now - clock.sent()), 2, 0.01) << "this was held up";
}

TEST(WriterClockTest, OfABurstThatWasHeldUpNothingIsNew) {
  WriterClock clock;
  Time now(seconds(1000));
  for (int i = 0; i < 100;
       ++i) {  // written 100 ms apart, come 10 ms apart: of 1 s, so that it takes longer than is waited
    const Duration delay = seconds(9) - milliseconds(90) * i;
    (void)clock.HeldUp(delay, now += milliseconds(10));
    ASSERT_EQ(now - clock.sent(), delay > WriterClock::kMostOfNetworks ? delay : Duration{}) << i;
  }
  (void)clock.HeldUp(milliseconds(1), now += milliseconds(100));
  EXPECT_EQ(now, clock.sent());
}

TEST(WriterClockTest, AnHourIsNoDelayButOfWhatIsKept) {
  const Time now(std::chrono::hours(2));
  WriterClock clock;
  (void)clock.HeldUp(std::chrono::hours(1), now);
  EXPECT_EQ(clock.sent(), now);
  WriterClock of_latched;
  (void)of_latched.HeldUp(std::chrono::hours(1), now, kFarthest);
  EXPECT_EQ(of_latched.sent(), now - std::chrono::hours(1));
  WriterClock from_before_this_machine_ran;
  (void)from_before_this_machine_ran.HeldUp(std::chrono::hours(3), now, kFarthest);
  EXPECT_EQ(from_before_this_machine_ran.sent(), Time());
}

class OtherClockTest : public testing::Test {
 protected:
  // Sent by that clock, so long ago by this one; returns when it is said to have been measured here.
  Time Send(double x, Duration ahead, Duration ago) {
    octets_ = std::make_shared<Octets>(20);
    (*octets_)[1] = std::byte(1);
    std::memcpy(octets_->data() + 4, &x, sizeof x);
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    stamp_ = (std::chrono::duration_cast<Duration>(now) + ahead - ago).count();
    EXPECT_TRUE(writer_->Write(octets_, stamp_));
    WaitUntil("it has come", [&] { return robot_.module.goal.Get().x == x; });
    return robot_.module.goal.Read().timestamp();
  }
  void Begin(bool keeps_stamps = true) {
    robot_.Take({.topic = "/a/place", .keeps_stamps = keeps_stamps}, robot_.module.goal);
    robot_.Begin();
    other_ = Must(engine_->Join({.name = "other"}, table_));
    const auto form = Must(ValueForm::Make(TypeOf<Place>(), "", ""));
    writer_ = Must(
        other_->MakeWriter({.topic = "rt/a/place", .type = form->codec->dds_type(), .user_data = form->user_data}, {}));
    WaitUntil("it is read", [&] { return robot_.Text().find("written by other") != std::string::npos; });
  }

  const std::shared_ptr<WireEngine> engine_ = MakeFakeWire();
  Member robot_{*engine_, "robot"};
  DiscoveryTable table_{[] {}};
  std::unique_ptr<WireParticipant> other_;
  std::unique_ptr<WireWriter> writer_;
  // Of what was sent last.
  std::shared_ptr<Octets> octets_;
  std::int64_t stamp_ = 0;
};

TEST_F(OtherClockTest, OfAClockThatIsAheadAgesAreSeen) {
  Begin();
  const Time fresh = Send(1, seconds(10), {});
  const Time old = Send(2, seconds(10), seconds(100));
  EXPECT_LT(old, fresh);  // it would be as old as its arrival
  robot_.WaitFor("s ahead of this one's");
  EXPECT_THAT(robot_.Text(), HasSubstr("on its way by both clocks"));
}

// A command that waited while the link was down does not become one from after a STOP that was released meanwhile.
TEST_F(OtherClockTest, WhatWasHeldUpIsAsOldAsItIsThoughItsArrivalCounts) {
  Begin(false);
  Time before = robot_.runtime.clock().Now();
  EXPECT_GE(Send(1, seconds(10), {}), before);
  std::this_thread::sleep_for(milliseconds(400));  // as while a link is down: a clock that is set makes no gap
  before = robot_.runtime.clock().Now();
  EXPECT_LE(Send(2, seconds(10), milliseconds(600)), before - milliseconds(100));
  before = robot_.runtime.clock().Now();
  EXPECT_GE(Send(3, seconds(10), {}), before);
}

// Whoever has lost a reader and found it again sends the newest value again, whether or not that one has noticed.
TEST_F(OtherClockTest, WhatIsSentAgainLongAfterwardsIsTakenOnce) {
  Begin(false);
  (void)Send(1, {}, {});
  ASSERT_TRUE(writer_->Write(octets_, stamp_));  // but two of a queue may be alike
  WaitUntilQuiet(*engine_);
  EXPECT_THAT(robot_.Text(), HasSubstr(", 2 came"));
  std::this_thread::sleep_for(milliseconds(1100));
  ASSERT_TRUE(writer_->Write(octets_, stamp_));
  WaitUntilQuiet(*engine_);
  EXPECT_THAT(robot_.Text(), HasSubstr(", 2 came"));
  (void)Send(2, {}, {});
  EXPECT_THAT(robot_.Text(), HasSubstr(", 3 came"));
}

// As above, but nothing had come before.
TEST_F(OtherClockTest, TheFirstValuesThatWereSentBeforeAReleaseStayFromBeforeIt) {
  Begin(false);
  EXPECT_TRUE(robot_.runtime.robot_stop().Press("a test"));
  ASSERT_TRUE(robot_.runtime.robot_stop().Release("a test"));
  const Time released = robot_.runtime.clock().Now();
  EXPECT_LT(Send(1, {}, seconds(40)), released - seconds(20));
  EXPECT_LT(Send(2, {}, seconds(10)), released) << "what was held up with it";
  EXPECT_GT(Send(3, {}, {}), released);
}

TEST_F(OtherClockTest, OfSeveralThatWriteEachIsShownWithItsOwnDelay) {
  Begin();
  (void)Send(1, {}, {});
  const auto third = Must(engine_->Join({.name = "third"}, table_));
  const auto form = Must(ValueForm::Make(TypeOf<Place>(), "", ""));
  const auto first = std::exchange(
      writer_, Must(third->MakeWriter(
                   {.topic = "rt/a/place", .type = form->codec->dds_type(), .user_data = form->user_data}, {})));
  WaitUntil("it is read", [&] { return robot_.Text().find("written by third") != std::string::npos; });
  (void)Send(2, {}, seconds(40));
  {
    const std::lock_guard lock(robot_.runtime.structure_mutex());
    EXPECT_THAT(robot_.link().Picture(), HasSubstr("\"delay\":40."));
  }
  writer_.reset();  // before whose it is
}

TEST_F(OtherClockTest, WhatIsHeldUpOrOfAClockThatIsBehindIsOld) {
  Begin();
  for (int i = 1; i <= 3; ++i) {
    const Time before = robot_.runtime.clock().Now();
    EXPECT_LE(Send(i, {}, seconds(10)), before - seconds(9));
  }
  robot_.WaitFor("s old when they come");
}

}  // namespace
}  // namespace runnel::test
