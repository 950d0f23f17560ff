#include "core/lockfree/wake_event.h"

#include <atomic>
#include <chrono>
#include <memory>
#include <thread>
#include <vector>

#include <gmock/gmock.h>

#include "tests/core/lockfree/told_by_many.h"
#include "tests/support/system_call_probe.h"
#include "tests/support/threads.h"
#include "tests/support/wait_until.h"
#include "tests/support/yielding_atomic.h"

namespace runnel::test {
namespace {

using std::chrono::milliseconds;

Time In(Duration duration) { return SteadyClock().Now() + duration; }

TEST(WakeEvent, NotificationsThatComeBeforeAddUpToOne) {
  WakeEvent event;
  event.Notify();
  event.Notify();
  event.Wait();
  const Time deadline = In(milliseconds(20));
  event.WaitUntil(deadline);
  EXPECT_GE(SteadyClock().Now(), deadline) << "the second one was still there";
}

TEST(WakeEvent, ADeadlineThatHasPassedIsNoWait) {
  WakeEvent event;
  event.WaitUntil(Time());
  event.WaitUntil(Time(milliseconds(-1)));
  event.Notify();
  event.Wait();
}

TEST(WakeEvent, NotifyingWhoIsAwakeIsNoSystemCall) {
  WakeEvent event;
  event.WaitUntil(In(milliseconds(1)));  // also after it has slept
  SystemCallProbe calls;
  for (int i = 0; i < 100; ++i) event.Notify();
  EXPECT_EQ(calls.Stop(), -1);
}

// Two threads play ping-pong: each round sleeps twice if both are quick enough.
template <template <typename> class Atomic>
void PassNoticesOn(int rounds) {
  Bell<Atomic> bell;
  Sleeper<Atomic> sleepers[] = {{bell, 1}, {bell, 2}};
  (void)sleepers[0].Notice();
  RunTogether(2, [&](unsigned index) {
    Sleeper<Atomic>& other = sleepers[1 - index];
    for (int round = 0; round < rounds; ++round) {
      ASSERT_TRUE(sleepers[index].Wait(Late()));
      other.Notify();
    }
  });
}

TEST(Bell, LosesNoNotice) { PassNoticesOn<std::atomic>(10000); }
TEST(Bell, LosesNoNoticeWhenOthersComeBetweenAnyTwoSteps) { PassNoticesOn<YieldingAtomic>(5000); }

TEST(WakeEvent, IsToldByManyAtOnce) {
  WakeEvent event;
  TellByMany(event, [&](const std::atomic<int>&, int) {
    event.Wait();
    return true;
  });
}

// More than have room on one bell.
TEST(WakeUps, WakeAllWhoSleepInEachRound) {
  constexpr unsigned kSleepers = 40;
  constexpr int kRounds = 50;
  std::vector<std::unique_ptr<WakeEvent>> events;
  for (unsigned i = 0; i < kSleepers; ++i) events.push_back(std::make_unique<WakeEvent>());
  WakeEvent all_have_woken;
  std::atomic<unsigned> woken{0};
  RunTogether(kSleepers + 1, [&](unsigned index) {
    for (int round = 0; round < kRounds; ++round) {
      if (index < kSleepers) {
        events[index]->Wait();
        if (woken.fetch_add(1) + 1 == kSleepers) all_have_woken.Notify();
        continue;
      }
      {
        WakeUps wake_ups;
        for (const auto& event : events) wake_ups.Add(*event);
      }
      all_have_woken.Wait();
      EXPECT_EQ(woken.exchange(0), kSleepers);
    }
  });
}

// Those on one bell are woken together, at the end: until then nothing calls the system.
TEST(WakeUps, CallTheSystemOnceForThoseOnOneBell) {
  constexpr unsigned kSleepers = 4;
  WakeEvent events[kSleepers];
  std::atomic<unsigned> about_to_sleep{0};
  RunTogether(kSleepers + 1, [&](unsigned index) {
    if (index < kSleepers) {
      ++about_to_sleep;
      events[index].Wait();
      return;
    }
    WaitUntil("all are about to sleep", [&] { return about_to_sleep >= kSleepers; });
    std::this_thread::sleep_for(milliseconds(20));  // for the better: so that they are asleep
    WakeUps wake_ups;
    SystemCallProbe calls;
    for (WakeEvent& event : events) wake_ups.Add(event);
    EXPECT_EQ(calls.Stop(), -1);
  });
}

}  // namespace
}  // namespace runnel::test
