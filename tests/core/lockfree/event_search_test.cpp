#include "tests/core/lockfree/search.h"
#include "tests/core/lockfree/searched_atomic.h"
// The search must come first: it renames what the standard headers below use.
#undef Sleep

#include "core/lockfree/event.h"
#include "tests/core/lockfree/searched_futex.h"

namespace runnel::test {
namespace {

constexpr unsigned kIterations = 100000;

using SearchedEvent = Event<SearchedAtomic, SearchedFutex>;

// Two threads put something somewhere, in the weakest way, and notify; the last one waits for both.
template <int kNotifiers>
struct WaitingSuite : rl::test_suite<WaitingSuite<kNotifiers>, kNotifiers + 1> {
  SearchedEvent event;
  SearchedAtomic<int> there[kNotifiers];

  void before() { SearchedFutex::Reset(); }
  void thread(unsigned index) {
    if (index < kNotifiers) {
      there[index].store(1, std::memory_order_relaxed);
      event.Notify();
      return;
    }
    for (auto& each : there) {
      RL_ASSERT(event.Wait(SearchedFutex::kNever, [&] { return each.load(std::memory_order_relaxed) == 1; }));
    }
  }
};

TEST(EventSearch, NoWakeIsLost) {
  EXPECT_TRUE(Search<WaitingSuite<1>>(kIterations, 4));
  EXPECT_TRUE(Search<WaitingSuite<2>>(kIterations, 4));
}

// After a wait that has run out of time, a notification wakes the next one all the same.
struct TimeOutSuite : rl::test_suite<TimeOutSuite, 2> {
  SearchedEvent event;
  SearchedAtomic<int> there{0};

  void before() { SearchedFutex::Reset(); }
  void thread(unsigned index) {
    if (index == 0) {
      there.store(1, std::memory_order_relaxed);
      event.Notify();
      return;
    }
    const auto is_there = [&] { return there.load(std::memory_order_relaxed) == 1; };
    (void)event.Wait(SearchedFutex::kAtOnce, is_there);
    RL_ASSERT(event.Wait(SearchedFutex::kNever, is_there));
  }
};

TEST(EventSearch, AWaitThatRanOutOfTimeTakesNothingFromTheNext) { EXPECT_TRUE(Search<TimeOutSuite>(kIterations, 4)); }

}  // namespace
}  // namespace runnel::test
