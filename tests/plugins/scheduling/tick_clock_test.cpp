#include "plugins/timing/tick_clock.h"

#include <cstdlib>

#include <gmock/gmock.h>

namespace runnel {
namespace {

using namespace std::chrono_literals;

/// A machine whose time the tests move, with a counter of 3 ticks a nanosecond.
struct FakeMachine {
  static inline bool are_steady = true;
  static inline std::int64_t now = 0;
  static inline std::uint64_t count = 0;
  static inline int questions = 0;

  static bool AreSteady() noexcept { return are_steady; }
  static std::uint64_t Count() noexcept { return count; }
  static Time Now() noexcept {
    ++questions;
    return Time(Duration(now));
  }
};

class TickClocks : public ::testing::Test {
 protected:
  TickClocks() {
    FakeMachine::are_steady = true;
    FakeMachine::now = 5'000'000'000;
    FakeMachine::count = 123'456'789;
  }
  static void Pass(Duration duration, double ticks_per_nanosecond = 3) {
    FakeMachine::now += duration.count();
    FakeMachine::count += static_cast<std::uint64_t>(static_cast<double>(duration.count()) * ticks_per_nanosecond);
  }
  // Lets `duration` pass in steps of 100 ns; returns how far off the clock was at most.
  Duration FurthestOff(BasicTickClock<FakeMachine>& clock, Duration duration, double ticks_per_nanosecond = 3) {
    Duration furthest{};
    for (Duration passed{}; passed < duration; passed += 100ns) {
      Pass(100ns, ticks_per_nanosecond);
      const Time now = clock.Now();
      EXPECT_GE(now, last_);
      last_ = now;
      furthest = std::max(furthest, std::chrono::abs(now - Time(Duration(FakeMachine::now))));
    }
    return furthest;
  }
  static int QuestionsWithin(BasicTickClock<FakeMachine>& clock, Duration duration) {
    const int before = FakeMachine::questions;
    for (Duration passed{}; passed < duration; passed += 100ns) {
      Pass(100ns);
      (void)clock.Now();
    }
    return FakeMachine::questions - before;
  }

  Time last_{};
};

TEST_F(TickClocks, AskTheSystemOnceAMillisecond) {
  BasicTickClock<FakeMachine> clock;
  FurthestOff(clock, 5ms);
  EXPECT_LE(QuestionsWithin(clock, 10ms), 30);  // a few at each turn, where rates are rounded
  EXPECT_GE(QuestionsWithin(clock, 10ms), 9);
}

TEST_F(TickClocks, FollowTheSteadyClock) {
  BasicTickClock<FakeMachine> clock;
  EXPECT_LE(FurthestOff(clock, 20ms), 2ns);
  EXPECT_LE(FurthestOff(clock, 20ms, 3.0005), 1us);  // the steady clock is being slewed
}

TEST_F(TickClocks, DoNotGoByACounterThatChangesItsSpeed) {
  BasicTickClock<FakeMachine> clock;
  FurthestOff(clock, 5ms);
  Pass(10ms, 1.5);
  EXPECT_EQ(FurthestOff(clock, 500us, 1.5), 0ns);
}

TEST_F(TickClocks, AreMisledByAJumpOfTheCounterForAMillisecondAtMost) {
  BasicTickClock<FakeMachine> clock;
  FurthestOff(clock, 5ms);
  FakeMachine::count += 1'500'000;  // half a millisecond
  EXPECT_LE(FurthestOff(clock, 1ms), 501us);
  EXPECT_LE(FurthestOff(clock, 5ms), 501us);  // what has been said is not taken back
  EXPECT_LE(FurthestOff(clock, 5ms), 2ns);
  FakeMachine::count -= 50'000'000;
  EXPECT_LE(FurthestOff(clock, 10ms), 2ns);
}

// The steady clock stands still while a laptop sleeps, or goes on, as the system has it; the counter is
// set to anything.
TEST_F(TickClocks, GoOnFromTheSteadyClockAfterASuspension) {
  for (const Duration steady_clock : {Duration(0), Duration(1h)}) {
    for (const std::uint64_t counter : {std::uint64_t{0}, std::uint64_t{1} << 60}) {
      FakeMachine::count = 123'456'789;
      BasicTickClock<FakeMachine> clock;
      last_ = {};
      FurthestOff(clock, 5ms);
      FakeMachine::now += steady_clock.count();
      FakeMachine::count = counter;
      EXPECT_EQ(FurthestOff(clock, 500us), 0ns);
      EXPECT_LE(FurthestOff(clock, 10ms), 2ns);
    }
  }
}

TEST_F(TickClocks, AskEveryTimeWithoutASteadyCounter) {
  FakeMachine::are_steady = false;
  BasicTickClock<FakeMachine> clock;
  EXPECT_EQ(QuestionsWithin(clock, 1ms), 10'000);
  EXPECT_EQ(FurthestOff(clock, 5ms, 0), 0ns);
}

TEST(TickClockOfTheMachine, LiesBetweenTwoLooksAtTheSteadyClock) {
  TickClock clock;
  const SteadyClock steady;
  for (int i = 0; i < 200'000; ++i) {
    const Time before = steady.Now();
    const Time now = clock.Now();
    ASSERT_GE(now, before - 20us);
    ASSERT_LE(now, steady.Now() + 20us);
  }
}

}  // namespace
}  // namespace runnel
