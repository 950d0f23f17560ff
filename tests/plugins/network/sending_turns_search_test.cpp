#include "plugins/network/sending_turns.h"
#include "tests/core/lockfree/search.h"
#include "tests/core/lockfree/searched_atomic.h"

namespace runnel::test {
namespace {

// Two publishers, one that sends by itself after its cycles and one that rings, and the network's thread, which answers. Values
// are put down in the weakest way. All are sent in the end, none after a newer one, and one thread at a time sends. It has
// been red with ringing by a store, with either order of ringing and answering relaxed, and with nobody rung for who came in vain.
struct SendingSuite : rl::test_suite<SendingSuite, 3> {
  static constexpr int kValues = 2;

  SendingTurns<SearchedAtomic> turns;
  SearchedAtomic<int> of_cycles;
  SearchedAtomic<int> of_others;
  SearchedPlain sent_of_cycles;  // by whose turn it is: two at once would race
  SearchedPlain sent_of_others;

  void before() {
    of_cycles.store(0, std::memory_order_relaxed);
    of_others.store(0, std::memory_order_relaxed);
    sent_of_cycles.Set(0);
    sent_of_others.Set(0);
  }
  void Send() {
    turns.Send(
        [this] {
          const int cycles = of_cycles.load(std::memory_order_relaxed);
          const int others = of_others.load(std::memory_order_relaxed);
          RL_ASSERT(cycles >= sent_of_cycles.Get());
          RL_ASSERT(others >= sent_of_others.Get());
          sent_of_cycles.Set(cycles);
          sent_of_others.Set(others);
        },
        [this] { turns.Ring(); });
  }
  void thread(unsigned index) {
    for (int value = 1; value <= kValues; ++value) {
      switch (index) {
        case 0:
          of_cycles.store(value, std::memory_order_relaxed);
          Send();
          break;
        case 1:
          of_others.store(value, std::memory_order_relaxed);
          turns.Ring();
          break;
        default:
          if (turns.Answer()) Send();
      }
    }
  }
  // The network's thread goes on as long as somebody has rung.
  void after() {
    while (turns.Answer()) Send();
    RL_ASSERT(sent_of_cycles.Get() == kValues);
    RL_ASSERT(sent_of_others.Get() == kValues);
  }
};

TEST(SendingTurnsSearch, AllIsSentInItsOrder) { EXPECT_TRUE(Search<SendingSuite>(100000, 3)); }

}  // namespace
}  // namespace runnel::test
