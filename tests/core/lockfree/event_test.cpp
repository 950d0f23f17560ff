#include "core/lockfree/event.h"

#include <atomic>
#include <chrono>
#include <memory>

#include <gmock/gmock.h>

#include "plugins/testing/guards.h"
#include "tests/core/lockfree/notified_by_many.h"
#include "tests/support/threads.h"
#include "tests/support/yielding_atomic.h"

namespace runnel::test {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

TEST(Event, DoesNotSleepIfItIsThereAlready) {
  Event<> event;
  EXPECT_TRUE(event.Wait(steady_clock::time_point(), [] { return true; }));
}

TEST(Event, GivesUpAtTheDeadlineAndNotBefore) {
  Event<> event;
  const auto deadline = steady_clock::now() + milliseconds(20);
  int looks = 0;
  EXPECT_FALSE(event.Wait(deadline, [&] { return ++looks == 0; }));
  EXPECT_GE(steady_clock::now(), deadline);
  EXPECT_LT(looks, 100) << "does not sleep";
  EXPECT_FALSE(event.Wait(steady_clock::time_point(), [] { return false; }));
}

TEST(Event, LooksAgainWhenItWakesForNoReason) {
  Event<> event;
  std::atomic<int> looks{0};
  RunTogether(2, [&](unsigned index) {
    if (index == 0) {
      EXPECT_TRUE(event.Wait(Late(), [&] { return ++looks >= 20; }));
    } else {
      while (looks < 20) event.Notify();
    }
  });
  EXPECT_GE(looks, 20);
}

TEST(Event, NotifyingNobodyIsNoSystemCall) {
  Event<> event;
  // Also after somebody has slept.
  EXPECT_FALSE(event.Wait(steady_clock::now() + milliseconds(1), [] { return false; }));
  SystemCallProbe calls;
  for (int i = 0; i < 100; ++i) event.Notify();
  EXPECT_EQ(calls.Stop(), -1);
}

// Two threads hand a number to and fro: each round sleeps twice if both are quick enough.
template <template <typename> class Atomic>
void PlayPingPong(int rounds) {
  const auto events = std::make_unique<Event<Atomic>[]>(2);
  std::atomic<int> ball{0};
  RunTogether(2, [&](unsigned index) {
    for (int round = 0; round < rounds; ++round) {
      const int mine = 2 * round + static_cast<int>(index);
      ASSERT_TRUE(events[index].Wait(Late(), [&] { return ball.load(std::memory_order_relaxed) == mine; }));
      ball.store(mine + 1, std::memory_order_relaxed);
      events[1 - index].Notify();
    }
  });
  EXPECT_EQ(ball, 2 * rounds);
}

TEST(Event, LosesNoWakeUp) { PlayPingPong<std::atomic>(10000); }
TEST(Event, LosesNoWakeUpWhenOthersComeBetweenAnyTwoSteps) { PlayPingPong<YieldingAtomic>(5000); }

TEST(Event, IsNotifiedByManyAtOnce) {
  Event<> event;
  NotifyByMany(event, [&](const std::atomic<int>& put, int seen) {
    return event.Wait(Late(), [&] { return put.load(std::memory_order_relaxed) > seen; });
  });
}

}  // namespace
}  // namespace runnel::test
