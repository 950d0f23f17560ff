#include "plugins/wire_shared_memory/slot_hold.h"
#include "tests/core/lockfree/search.h"
#include "tests/core/lockfree/searched_atomic.h"

namespace runnel::test {
namespace {

// One slot, into which values are written in turn, as long as nobody holds it; the engine tells of each. Whoever holds it
// finds the value that it was told of, which nobody writes meanwhile.
template <unsigned readers>
struct SlotSuite : rl::test_suite<SlotSuite<readers>, readers + 1> {
  SlotUse<SearchedAtomic> slot;
  std::array<SlotHold<SearchedAtomic>, readers> holds;
  rl::var<std::uint64_t> value;
  SearchedAtomic<std::uint64_t> told;

  void thread(unsigned index) {
    if (index < readers) return Read(holds[index]);
    std::uint64_t newest = 0;
    for (std::uint64_t n = 1; n <= 3; ++n) {
      const bool is_free = slot.BeginWriting(2 * n, [&] { return IsHeld(); });
      if (!is_free) RL_ASSERT(slot.Is(newest));
      if (!is_free) continue;
      newest = 2 * n;
      value($) = n;
      slot.EndWriting(2 * n);
      told.store(2 * n, std::memory_order_relaxed);  // an engine may promise no order
    }
  }

 private:
  void Read(SlotHold<SearchedAtomic>& hold) {
    for (int i = 0; i < 2; ++i) {
      const std::uint64_t use = told.load(std::memory_order_relaxed);
      if (use == 0 || !hold.Take(slot, use)) continue;
      RL_ASSERT(value($) == use / 2);
      RL_ASSERT(!hold.Take(slot, use));
      hold.GiveBack();
    }
  }
  bool IsHeld() const {
    for (const auto& each : holds) {
      if (each.is_held()) return true;
    }
    return false;
  }
};

TEST(SlotHoldSearch, WhatIsHeldIsTheValueThatWasToldOfAndNobodyWritesIt) {
  EXPECT_TRUE(Search<SlotSuite<1>>(100000, 4));
}
TEST(SlotHoldSearch, EachOfTwoReadersKeepsIt) { EXPECT_TRUE(Search<SlotSuite<2>>(100000, 2)); }

}  // namespace
}  // namespace runnel::test
