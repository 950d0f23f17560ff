#include "tests/core/lockfree/searched_atomic.h"
// The search must come first: it renames what the standard headers below use.

#include <optional>

#include "tests/core/lockfree/buffer_rig.h"

namespace runnel::test {
namespace {

constexpr unsigned kIterations = 100000;

// A publisher goes through its two buffers while readers lease and look.
struct LeasingSuite : rl::test_suite<LeasingSuite, 3>, Rig<SearchedPlain, 2> {
  LeasingSuite() : Rig({.buffers = 3, .may_grow = false}) {}

  void thread(unsigned index) {
    if (index == 2) {
      for (int i = 1; i <= 4; ++i) Publish(i);
      return;
    }
    int last = 0;
    for (int i = 0; i < 2; ++i) {
      const Lease lease = latest.Lease(readers[index]);
      if (lease.get() == nullptr) continue;
      const int value = LookAt(lease);
      RL_ASSERT(value >= last);
      last = value;
    }
  }
};

TEST(BufferSearch, LeasedValueDoesNotChange) { EXPECT_TRUE(Search<LeasingSuite>(kIterations)); }

// One slot and two leases: the second is counted.
struct CountedSuite : rl::test_suite<CountedSuite, 2>, Rig<SearchedPlain, 1> {
  CountedSuite() : Rig({.buffers = 2, .may_grow = false}) {}

  void thread(unsigned index) {
    if (index == 1) {
      for (int i = 1; i <= 4; ++i) Publish(i);
      return;
    }
    const Lease first = latest.Lease(readers[0]);
    const Lease second = latest.Lease(readers[0]);
    if (first.get() != nullptr) LookAt(first);
    if (second.get() != nullptr) LookAt(second);
  }
};

TEST(BufferSearch, LeasedValueDoesNotChangeWithoutASlot) {
  EXPECT_TRUE(Search<CountedSuite>(kIterations));
}

// A lease is copied, and the copy outlasts it: there is no moment at which neither is seen.
struct CopyingSuite : rl::test_suite<CopyingSuite, 2>, Rig<SearchedPlain, 1> {
  CopyingSuite() : Rig({.buffers = 2, .may_grow = false}) {}

  void thread(unsigned index) {
    if (index == 1) {
      for (int i = 1; i <= 4; ++i) Publish(i);
      return;
    }
    Lease lease = latest.Lease(readers[0]);
    if (lease.get() == nullptr) return;
    const Lease copy = lease;
    lease = {};
    LookAt(copy);
  }
};

TEST(BufferSearch, CopyOfALeaseHoldsWithoutAGap) { EXPECT_TRUE(Search<CopyingSuite>(kIterations)); }

// A lease is handed to another thread, which drops it, while the first uses the slot again.
struct HandingOnSuite : rl::test_suite<HandingOnSuite, 3>, Rig<SearchedPlain, 1> {
  HandingOnSuite() : Rig({.buffers = 3, .may_grow = false}) {}
  Lease handed;
  SearchedAtomic<int> is_handed{0};

  void thread(unsigned index) {
    if (index == 2) {
      for (int i = 1; i <= 4; ++i) Publish(i);
    } else if (index == 0) {
      handed = latest.Lease(readers[0]);
      is_handed.store(1, std::memory_order_release);
      const Lease next = latest.Lease(readers[0]);
      if (next.get() != nullptr) LookAt(next);
    } else if (is_handed.load(std::memory_order_acquire) == 1) {
      const Lease taken = std::move(handed);
      if (taken.get() != nullptr) LookAt(taken);
    }
  }
  void after() { handed = {}; }
};

TEST(BufferSearch, LeaseMayBeDroppedByAnotherThread) {
  EXPECT_TRUE(Search<HandingOnSuite>(kIterations));
}

// A record is added while the publisher looks for free buffers.
struct AddingSuite : rl::test_suite<AddingSuite, 2>, Rig<SearchedPlain, 1> {
  AddingSuite() : Rig({.buffers = 2, .may_grow = false}) {}
  std::optional<Domain::Record> late;  // made here, so that it may be met incomplete

  void thread(unsigned index) {
    if (index == 1) {
      for (int i = 1; i <= 4; ++i) Publish(i);
      return;
    }
    domain.Add(late.emplace());
    const Lease lease = latest.Lease(*late);
    if (lease.get() != nullptr) LookAt(lease);
  }
};

TEST(BufferSearch, ThreadThatIsNewIsSeen) { EXPECT_TRUE(Search<AddingSuite>(kIterations)); }

}  // namespace
}  // namespace runnel::test
