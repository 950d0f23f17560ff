#include "core/lockfree/wake_event.h"

#include <atomic>
#include <chrono>
#include <memory>
#include <thread>
#include <vector>

#include <gmock/gmock.h>

#include "plugins/testing/guards.h"
#include "tests/core/lockfree/notified_by_many.h"
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
void PassNotificationsOn(int rounds) {
  EventCount<Atomic> event_count;
  Waiter<Atomic> waiters[] = {{event_count, 1}, {event_count, 2}};
  (void)waiters[0].MarkNotified();
  RunTogether(2, [&](unsigned index) {
    Waiter<Atomic>& other = waiters[1 - index];
    for (int round = 0; round < rounds; ++round) {
      ASSERT_TRUE(waiters[index].Wait(Late()));
      other.Notify();
    }
  });
}

TEST(EventCount, LosesNoNotification) { PassNotificationsOn<std::atomic>(10000); }
TEST(EventCount, LosesNoNotificationWhenOthersComeBetweenAnyTwoSteps) { PassNotificationsOn<YieldingAtomic>(5000); }

TEST(WakeEvent, IsNotifiedByManyAtOnce) {
  WakeEvent event;
  NotifyByMany(event, [&](const std::atomic<int>&, int) {
    event.Wait();
    return true;
  });
}

// More than have room on one event_count.
TEST(NotificationBatch, WakeAllWhoSleepInEachRound) {
  constexpr unsigned kWaiters = 40;
  constexpr int kRounds = 50;
  std::vector<std::unique_ptr<WakeEvent>> events;
  for (unsigned i = 0; i < kWaiters; ++i) events.push_back(std::make_unique<WakeEvent>());
  WakeEvent all_have_woken;
  std::atomic<unsigned> woken{0};
  RunTogether(kWaiters + 1, [&](unsigned index) {
    for (int round = 0; round < kRounds; ++round) {
      if (index < kWaiters) {
        events[index]->Wait();
        if (woken.fetch_add(1) + 1 == kWaiters) all_have_woken.Notify();
        continue;
      }
      {
        NotificationBatch notifications;
        for (const auto& event : events) notifications.Add(*event);
      }
      all_have_woken.Wait();
      EXPECT_EQ(woken.exchange(0), kWaiters);
    }
  });
}

// Those on one event count are woken together, at the end: until then nothing calls the system.
TEST(NotificationBatch, CallTheSystemOnceForThoseOnOneEventCount) {
  constexpr unsigned kWaiters = 4;
  WakeEvent events[kWaiters];
  std::atomic<unsigned> about_to_sleep{0};
  RunTogether(kWaiters + 1, [&](unsigned index) {
    if (index < kWaiters) {
      ++about_to_sleep;
      events[index].Wait();
      return;
    }
    WaitUntil("all are about to sleep", [&] { return about_to_sleep >= kWaiters; });
    std::this_thread::sleep_for(milliseconds(20));  // for the better: so that they are asleep
    NotificationBatch notifications;
    SystemCallProbe calls;
    for (WakeEvent& event : events) notifications.Add(event);
    EXPECT_EQ(calls.Stop(), -1);
  });
}

}  // namespace
}  // namespace runnel::test
