#include "tests/core/lockfree/search.h"
#include "tests/core/lockfree/searched_atomic.h"
// The search must come first: it renames what the standard headers below use.
#undef Sleep

#include "core/lockfree/bell.h"
#include "tests/core/lockfree/searched_futex.h"

namespace runnel::test {
namespace {

constexpr unsigned kIterations = 100000;

using SearchedBell = Bell<SearchedAtomic, SearchedFutex>;
using SearchedSleeper = Sleeper<SearchedAtomic, SearchedFutex>;

// Each notifier puts something somewhere, in the weakest way, gives notice, and rings if it has to; the
// last thread waits until it has seen all of it. Notices may add up to one.
template <int kNotifiers>
struct NoticingSuite : rl::test_suite<NoticingSuite<kNotifiers>, kNotifiers + 1> {
  SearchedBell bell;
  SearchedSleeper sleeper{bell, 1};
  SearchedAtomic<int> there[kNotifiers];

  void before() { SearchedFutex::Reset(); }
  void thread(unsigned index) {
    if (index < kNotifiers) {
      there[index].store(1, std::memory_order_relaxed);
      sleeper.Notify();
      return;
    }
    for (auto& each : there) {
      while (each.load(std::memory_order_relaxed) == 0) {
        RL_ASSERT(sleeper.Wait(SearchedFutex::kNever));
      }
    }
  }
};

TEST(BellSearch, NoNoticeIsLost) {
  EXPECT_TRUE(Search<NoticingSuite<1>>(kIterations, 4));
  EXPECT_TRUE(Search<NoticingSuite<2>>(kIterations, 4));
}

// What was done before a notice is done for who has taken it.
struct HandingOverSuite : rl::test_suite<HandingOverSuite, 2> {
  SearchedBell bell;
  SearchedSleeper sleeper{bell, 1};
  SearchedPlain value;

  void before() { SearchedFutex::Reset(); }
  void thread(unsigned index) {
    if (index == 0) {
      value.Set(1);
      sleeper.Notify();
    } else {
      RL_ASSERT(sleeper.Wait(SearchedFutex::kNever));
      RL_ASSERT(value.Get() == 1);
    }
  }
};

TEST(BellSearch, NoticeHandsOverWhatWasDoneBefore) {
  EXPECT_TRUE(Search<HandingOverSuite>(kIterations, 4));
}

// Two sleep on one bell, and a single ring wakes those of them who sleep.
struct SharingSuite : rl::test_suite<SharingSuite, 3> {
  SearchedBell bell;
  SearchedSleeper sleepers[2] = {{bell, 1}, {bell, 2}};

  void before() { SearchedFutex::Reset(); }
  void thread(unsigned index) {
    if (index < 2) {
      RL_ASSERT(sleepers[index].Wait(SearchedFutex::kNever));
      return;
    }
    SearchedBell::Seats seats = 0;
    for (auto& sleeper : sleepers) {
      if (sleeper.Notice()) seats |= sleeper.seat();
    }
    if (seats != 0) bell.Ring(seats);
    RL_ASSERT(SearchedFutex::wakes <= 1);
  }
};

TEST(BellSearch, OneRingWakesAllWhoSleep) { EXPECT_TRUE(Search<SharingSuite>(kIterations, 4)); }

// After a wait that has run out of time, a notice wakes the next one all the same; and one that came
// in the last moment is taken.
struct TimeOutSuite : rl::test_suite<TimeOutSuite, 2> {
  SearchedBell bell;
  SearchedSleeper sleeper{bell, 1};

  void before() { SearchedFutex::Reset(); }
  void thread(unsigned index) {
    if (index == 0) {
      sleeper.Notify();
    } else if (!sleeper.Wait(SearchedFutex::kAtOnce)) {
      RL_ASSERT(sleeper.Wait(SearchedFutex::kNever));
    }
  }
};

TEST(BellSearch, AWaitThatRanOutOfTimeTakesNothingFromTheNext) {
  EXPECT_TRUE(Search<TimeOutSuite>(kIterations, 4));
}

}  // namespace
}  // namespace runnel::test
