#include "plugins/genom_execution/ticket_board.h"
#include "tests/core/lockfree/search.h"
#include "tests/core/lockfree/searched_atomic.h"

namespace runnel::test {
namespace {

using genom_execution::TicketBoard;

constexpr auto kAll = [](std::size_t, std::size_t) { return true; };

// Each wants a unit that conflicts with all others, and counts: two at once would race.
template <int kThreads, int kTurns>
struct ApartSuite : rl::test_suite<ApartSuite<kThreads, kTurns>, kThreads> {
  TicketBoard<SearchedAtomic> board{kThreads};
  SearchedPlain count;

  void before() { count.Set(0); }
  void thread(unsigned place) {
    for (int turn = 0; turn < kTurns; ++turn) {
      board.Want(place, place);
      while (!board.May(place, kAll)) rl::yield(1, $);
      count.Set(count.Get() + 1);
      board.Leave(place);
    }
  }
  void after() { RL_ASSERT(count.Get() == kThreads * kTurns); }
};

using TwoApart = ApartSuite<2, 2>;
using ThreeApart = ApartSuite<3, 1>;

TEST(TicketBoardSearch, OneAtATimeRunsAndEachAtLast) {
  EXPECT_TRUE(Search<TwoApart>(20000, 3));
  EXPECT_TRUE(Search<ThreeApart>(20000, 2));
}

}  // namespace
}  // namespace runnel::test
