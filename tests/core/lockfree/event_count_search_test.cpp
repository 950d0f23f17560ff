#include "tests/core/lockfree/search.h"
#include "tests/core/lockfree/searched_atomic.h"
// The search must come first: it renames what the standard headers below use.
#undef Sleep

#include "core/lockfree/event_count.h"
#include "tests/core/lockfree/searched_futex.h"

namespace runnel::test {
namespace {

constexpr unsigned kIterations = 100000;

using SearchedEventCount = EventCount<SearchedAtomic, SearchedFutex>;
using SearchedWaiter = Waiter<SearchedAtomic, SearchedFutex>;

// Each notifier puts something somewhere, in the weakest way, and notifies the waiter; the
// last thread waits until it has seen all of it. Notifications may add up to one.
template <int kNotifiers>
struct NoticingSuite : rl::test_suite<NoticingSuite<kNotifiers>, kNotifiers + 1> {
  SearchedEventCount event_count;
  SearchedWaiter waiter{event_count, 1};
  SearchedAtomic<int> there[kNotifiers];

  void before() { SearchedFutex::Reset(); }
  void thread(unsigned index) {
    if (index < kNotifiers) {
      there[index].store(1, std::memory_order_relaxed);
      waiter.Notify();
      return;
    }
    for (auto& each : there) {
      while (each.load(std::memory_order_relaxed) == 0) {
        RL_ASSERT(waiter.Wait(SearchedFutex::kNever));
      }
    }
  }
};

TEST(EventCountSearch, NoNotificationIsLost) {
  EXPECT_TRUE(Search<NoticingSuite<1>>(kIterations, 4));
  EXPECT_TRUE(Search<NoticingSuite<2>>(kIterations, 4));
}

// What was done before a notification is done for who has taken it.
struct HandingOverSuite : rl::test_suite<HandingOverSuite, 2> {
  SearchedEventCount event_count;
  SearchedWaiter waiter{event_count, 1};
  SearchedPlain value;

  void before() { SearchedFutex::Reset(); }
  void thread(unsigned index) {
    if (index == 0) {
      value.Set(1);
      waiter.Notify();
    } else {
      RL_ASSERT(waiter.Wait(SearchedFutex::kNever));
      RL_ASSERT(value.Get() == 1);
    }
  }
};

TEST(EventCountSearch, NotificationHandsOverWhatWasDoneBefore) {
  EXPECT_TRUE(Search<HandingOverSuite>(kIterations, 4));
}

// Two sleep on one event count, and a single call wakes those of them who sleep.
struct SharingSuite : rl::test_suite<SharingSuite, 3> {
  SearchedEventCount event_count;
  SearchedWaiter waiters[2] = {{event_count, 1}, {event_count, 2}};

  void before() { SearchedFutex::Reset(); }
  void thread(unsigned index) {
    if (index < 2) {
      RL_ASSERT(waiters[index].Wait(SearchedFutex::kNever));
      return;
    }
    SearchedEventCount::Waiters notified = 0;
    for (auto& waiter : waiters) {
      if (waiter.MarkNotified()) notified |= waiter.waiter_bit();
    }
    if (notified != 0) event_count.Notify(notified);
    RL_ASSERT(SearchedFutex::wakes <= 1);
  }
};

TEST(EventCountSearch, OneNotificationWakesAllWhoSleep) { EXPECT_TRUE(Search<SharingSuite>(kIterations, 4)); }

// After a wait that has run out of time, a notification wakes the next one all the same; and one that came
// in the last moment is taken.
struct TimeOutSuite : rl::test_suite<TimeOutSuite, 2> {
  SearchedEventCount event_count;
  SearchedWaiter waiter{event_count, 1};

  void before() { SearchedFutex::Reset(); }
  void thread(unsigned index) {
    if (index == 0) {
      waiter.Notify();
    } else if (!waiter.Wait(SearchedFutex::kAtOnce)) {
      RL_ASSERT(waiter.Wait(SearchedFutex::kNever));
    }
  }
};

TEST(EventCountSearch, AWaitThatRanOutOfTimeTakesNothingFromTheNext) {
  EXPECT_TRUE(Search<TimeOutSuite>(kIterations, 4));
}

}  // namespace
}  // namespace runnel::test
