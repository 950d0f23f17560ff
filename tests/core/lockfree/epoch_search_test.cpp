#include "tests/core/lockfree/search.h"
#include "tests/core/lockfree/searched_atomic.h"
// The search must come first: it renames what the standard headers below use.

#include <optional>

#include "core/lockfree/epoch.h"

namespace runnel::test {
namespace {

constexpr unsigned kIterations = 100000;

// Parts that a writer swaps out one after the other, and destroys if their epoch has passed in time.
struct Parts {
  using Domain = EpochDomain<SearchedAtomic>;
  struct Part {
    SearchedPlain alive{1};
  };
  // The caller has entered.
  Part& Current() { return *current.load(std::memory_order_acquire); }
  static void ExpectAlive(const Part& part) { RL_ASSERT(part.alive.Get() == 1); }
  void ReplaceAndDestroy(int times) {
    for (int i = 1; i <= times; ++i) {
      Part* const old = current.exchange(&parts[i], std::memory_order_acq_rel);
      const std::uint64_t epoch = domain.Advance();
      for (int patience = 0; patience < 4; ++patience) {
        if (!domain.HasPassed(epoch)) continue;
        old->alive.Set(0);
        break;
      }
    }
  }

  Domain domain;
  Part parts[3];
  SearchedAtomic<Part*> current{&parts[0]};
};

// Readers never see a part die.
struct EpochSuite : rl::test_suite<EpochSuite, 3>, Parts {
  std::optional<Domain::Participant> participants[2];

  void thread(unsigned index) {
    if (index == 2) return ReplaceAndDestroy(2);
    // Here, so that a writer may just miss it, or find it incomplete.
    Domain::Participant& participant = participants[index].emplace();
    domain.Add(participant);
    for (int i = 0; i < 2; ++i) {
      domain.Enter(participant);
      ExpectAlive(Current());
      domain.Leave(participant);
    }
  }
};

TEST(EpochSearch, PartIsDestroyedOnlyWhenNobodyLooks) { EXPECT_TRUE(Search<EpochSuite>(kIterations, 1)); }

// A thread that ends hands its participant to the next one: who sees that one inside, in a new
// epoch, sees as done what the first one did.
struct HandedOverSuite : rl::test_suite<HandedOverSuite, 3>, Parts {
  Domain::Participant participant;
  SearchedAtomic<int> is_free{0};

  HandedOverSuite() { domain.Add(participant); }
  void thread(unsigned index) {
    if (index == 2) return ReplaceAndDestroy(2);
    if (index == 1 && is_free.load(std::memory_order_acquire) == 0) return;
    domain.Enter(participant);
    ExpectAlive(Current());
    domain.Leave(participant);
    if (index == 0) is_free.store(1, std::memory_order_release);
  }
};

TEST(EpochSearch, ParticipantMayBeHandedToAnotherThread) { EXPECT_TRUE(Search<HandedOverSuite>(kIterations, 3)); }

}  // namespace
}  // namespace runnel::test
