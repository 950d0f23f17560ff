#include "tests/core/lockfree/searched_atomic.h"
// The search must come first: it renames what the standard headers below use.
#undef Sleep

#include "core/lockfree/event.h"

namespace runnel::test {
namespace {

constexpr unsigned kIterations = 100000;

// A kernel with one thread asleep at most. Comparing the word and going to sleep are one step, as
// they are under the lock of a real one: the search lets others come only before an operation on
// an atomic. A wake that is lost leaves the thread asleep for ever, which ends as "too deep".
struct SearchedFutex {
  using Deadline = int;
  enum : int { kNever, kAtOnce };  // a deadline that has passed already
  inline static bool asleep = false;

  static bool Sleep(SearchedAtomic<std::uint32_t>& word, std::uint32_t expected,
                    Deadline deadline) {
    if (word.fetch_add(0, std::memory_order_seq_cst) != expected) return true;
    if (deadline == kAtOnce) return false;
    asleep = true;
    while (asleep) rl::yield(1, $);
    return true;
  }
  static void Wake(SearchedAtomic<std::uint32_t>&) { asleep = false; }
};
using SearchedEvent = Event<SearchedAtomic, SearchedFutex>;

// Two threads put something somewhere, in the weakest way, and notify; the last one waits for both.
template <int kNotifiers>
struct WaitingSuite : rl::test_suite<WaitingSuite<kNotifiers>, kNotifiers + 1> {
  SearchedEvent event;
  SearchedAtomic<int> there[kNotifiers];

  void before() { SearchedFutex::asleep = false; }
  void thread(unsigned index) {
    if (index < kNotifiers) {
      there[index].store(1, std::memory_order_relaxed);
      event.Notify();
      return;
    }
    for (auto& each : there) {
      RL_ASSERT(event.Wait(SearchedFutex::kNever,
                           [&] { return each.load(std::memory_order_relaxed) == 1; }));
    }
  }
};

TEST(EventSearch, NoWakeIsLost) {
  EXPECT_TRUE(Search<WaitingSuite<1>>(kIterations));
  EXPECT_TRUE(Search<WaitingSuite<2>>(kIterations));
}

// After a wait that has run out of time, a notification wakes the next one all the same.
struct TimeOutSuite : rl::test_suite<TimeOutSuite, 2> {
  SearchedEvent event;
  SearchedAtomic<int> there{0};

  void before() { SearchedFutex::asleep = false; }
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

TEST(EventSearch, AWaitThatRanOutOfTimeTakesNothingFromTheNext) {
  EXPECT_TRUE(Search<TimeOutSuite>(kIterations));
}

}  // namespace
}  // namespace runnel::test
