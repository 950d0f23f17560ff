#include "core/lockfree/taking_turns.h"
#include "tests/core/lockfree/search.h"
#include "tests/core/lockfree/searched_atomic.h"

namespace runnel::test {
namespace {

constexpr unsigned kIterations = 100000;

// Each puts something down, in the weakest way, and asks for the work, which takes up what is there. All of it
// is taken up when all have asked, and one at a time has done so.
template <int kThreads>
struct TurnsSuite : rl::test_suite<TurnsSuite<kThreads>, kThreads> {
  TakingTurns<SearchedAtomic> turns;
  SearchedAtomic<int> put[kThreads];
  SearchedPlain taken;  // by whose turn it is: two at once would race

  void before() {
    taken.Set(0);
    for (auto& each : put) each.store(0, std::memory_order_relaxed);
  }
  void thread(unsigned index) {
    put[index].store(1, std::memory_order_relaxed);
    turns.Do([this]() noexcept {
      int there = 0;
      for (auto& each : put) there += each.load(std::memory_order_relaxed);
      RL_ASSERT(there >= taken.Get());
      taken.Set(there);
    });
  }
  void after() { RL_ASSERT(taken.Get() == kThreads); }
};

TEST(TakingTurnsSearch, NothingIsLeftAndOneAtATimeWorks) {
  EXPECT_TRUE(Search<TurnsSuite<2>>(kIterations, 4));
  EXPECT_TRUE(Search<TurnsSuite<3>>(kIterations, 3));
}

}  // namespace
}  // namespace runnel::test
