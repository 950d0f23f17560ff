#include "tests/core/lockfree/searched_atomic.h"
// The search must come first: it renames what the standard headers below use.

#include "core/lockfree/epoch.h"

namespace runnel::test {
namespace {

constexpr unsigned kIterations = 100000;

// A writer swaps a part out and destroys it after the epoch has passed; readers never see it die.
struct EpochSuite : rl::test_suite<EpochSuite, 3> {
  struct Part {
    SearchedPlain alive{1};
  };
  EpochDomain<SearchedAtomic> domain;
  EpochDomain<SearchedAtomic>::Participant participants[2];
  Part parts[3];
  SearchedAtomic<Part*> current{&parts[0]};

  void thread(unsigned index) {
    if (index < 2) {
      domain.Add(participants[index]);  // here, so that a writer may just miss it
      for (int i = 0; i < 2; ++i) {
        domain.Enter(participants[index]);
        Part* const part = current.load(std::memory_order_acquire);
        RL_ASSERT(part->alive.Get() == 1);
        domain.Leave(participants[index]);
      }
      return;
    }
    for (int i = 1; i <= 2; ++i) {
      Part* const old = current.exchange(&parts[i], std::memory_order_acq_rel);
      const std::uint64_t epoch = domain.Advance();
      for (int patience = 0; patience < 4; ++patience) {
        if (!domain.HasPassed(epoch)) continue;
        old->alive.Set(0);
        break;
      }
    }
  }
};

TEST(EpochSearch, PartIsDestroyedOnlyWhenNobodyLooks) {
  EXPECT_TRUE(Search<EpochSuite>(kIterations));
}

}  // namespace
}  // namespace runnel::test
