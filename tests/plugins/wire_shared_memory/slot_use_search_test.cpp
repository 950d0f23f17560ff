#include "plugins/wire_shared_memory/slot_use.h"
#include "tests/core/lockfree/search.h"
#include "tests/core/lockfree/searched_atomic.h"

namespace runnel::test {
namespace {

// One slot, into which three values are written in turn, of two words each; the engine tells of each. Whoever reads
// finds both words of one value, or that it has gone.
struct SlotSuite : rl::test_suite<SlotSuite, 2> {
  SlotUse<SearchedAtomic> slot;
  SearchedAtomic<std::uint64_t> first;
  SearchedAtomic<std::uint64_t> second;
  SearchedAtomic<std::uint64_t> told;

  void thread(unsigned index) {
    if (index == 0) {
      for (std::uint64_t n = 1; n <= 3; ++n) {
        slot.BeginWriting(2 * n);
        first.store(n, std::memory_order_relaxed);
        second.store(10 * n, std::memory_order_relaxed);
        slot.EndWriting(2 * n);
        told.store(2 * n, std::memory_order_relaxed);  // an engine may promise no order
      }
      return;
    }
    for (int i = 0; i < 2; ++i) {
      const std::uint64_t use = told.load(std::memory_order_relaxed);
      if (use == 0 || !slot.Is(use)) continue;
      const std::uint64_t a = first.load(std::memory_order_relaxed);
      const std::uint64_t b = second.load(std::memory_order_relaxed);
      if (!slot.IsStill(use)) continue;
      RL_ASSERT(a == use / 2);
      RL_ASSERT(b == 10 * a);
    }
  }
};

TEST(SlotUseSearch, WhatIsReadIsOfTheValueThatWasToldOf) { EXPECT_TRUE(Search<SlotSuite>(100000, 4)); }

}  // namespace
}  // namespace runnel::test
