#include "tests/core/lockfree/search.h"
#include "tests/core/lockfree/searched_atomic.h"
// The search must come first: it renames what the standard headers below use.

#include "tests/core/lockfree/buffer_rig.h"

namespace runnel::test {
namespace {

constexpr unsigned kIterations = 100000;

// A loan may be given back by any thread, and is written again by the publisher.
struct LoanSuite : rl::test_suite<LoanSuite, 2>, Rig<SearchedPlain, 1> {
  LoanSuite() : Rig({.buffers = 1, .may_grow = false}) {}
  SearchedAtomic<Pool::Buffer*> loaned{nullptr};
  Pool::Buffer* again = nullptr;
  bool is_dropped = false;

  void thread(unsigned index) {
    if (index == 0) {
      auto* buffer = latest.Loan();
      buffer->value().Set(1);
      loaned.store(buffer, std::memory_order_release);
      for (int i = 0; i < 3; ++i) {
        if ((buffer = latest.Loan()) == nullptr) continue;
        buffer->value().Set(2);
        again = buffer;
        return;
      }
    } else if (auto* const buffer = loaned.load(std::memory_order_acquire)) {
      RL_ASSERT(buffer->value().Get() == 1);
      buffer->DropLoan();
      is_dropped = true;
    }
  }
  void after() {
    auto* const out = again != nullptr || is_dropped ? again : loaned.load(std::memory_order_relaxed);
    if (out != nullptr) out->DropLoan();
  }
};

TEST(PoolSearch, LoanGivenBackIsWrittenAgainOnlyThen) { EXPECT_TRUE(Search<LoanSuite>(kIterations, 4)); }

// Buffers are reserved while the publisher loans: they are complete when it comes upon them.
struct ReservingSuite : rl::test_suite<ReservingSuite, 2>, Rig<SearchedPlain, 1> {
  ReservingSuite() : Rig({.buffers = 1, .may_grow = false}) {}
  Pool::Buffer* loans[3] = {};

  void thread(unsigned index) {
    if (index == 1) {
      pool->Reserve(2);
      pool->Reserve(3);
      return;
    }
    for (auto*& each : loans) {
      if ((each = latest.Loan()) != nullptr) each->value().Set(1);
    }
    RL_ASSERT(loans[0] != nullptr && loans[0] != loans[1] && loans[0] != loans[2]);
    RL_ASSERT(loans[1] == nullptr || loans[1] != loans[2]);
  }
  void after() {
    for (auto* each : loans) {
      if (each != nullptr) each->DropLoan();
    }
  }
};

TEST(PoolSearch, ReservedBuffersAreCompleteWhenTheyArrive) { EXPECT_TRUE(Search<ReservingSuite>(kIterations, 2)); }

// The owner closes the pool while there are a lease in a slot, its copy, and a loan, each given up
// by another thread: the buffers go with whoever comes last, once.
struct ClosingSuite : rl::test_suite<ClosingSuite, 3>, Rig<Mortal, 1> {
  ClosingSuite() : Rig({.buffers = 3, .may_grow = false}) {}
  Lease in_slot;
  Pool::Buffer* loan = nullptr;

  void before() {
    Publish(7);
    in_slot = latest.Lease(readers[0]);
    loan = latest.Loan();
    loan->value().Set(8);
  }
  void thread(unsigned index) {
    if (index == 0) {
      pool.reset();
    } else if (index == 1) {
      Lease lease = std::move(in_slot);
      const Lease copy = lease;
      lease = {};
      RL_ASSERT(copy.get()->value().Get() == 7);
    } else {
      RL_ASSERT(loan->value().Get() == 8);
      loan->DropLoan();
    }
  }
  void after() {
    (void)domain.Reclaim();
    RL_ASSERT(Mortal::alive() == 0);
  }
};

TEST(PoolSearch, ClosedPoolGoesWithItsLastHolder) { EXPECT_TRUE(Search<ClosingSuite>(kIterations, 3)); }

// The same with nothing but a lease in a slot, so that the closer and the reader meet there alone.
struct ClosingSlotSuite : rl::test_suite<ClosingSlotSuite, 2>, Rig<Mortal, 1> {
  ClosingSlotSuite() : Rig({.buffers = 1, .may_grow = false}) {}
  Lease in_slot;

  void before() {
    Publish(7);
    in_slot = latest.Lease(readers[0]);
  }
  void thread(unsigned index) {
    if (index == 0) {
      pool.reset();
    } else {
      RL_ASSERT(in_slot.get()->value().Get() == 7);
      in_slot = {};
    }
  }
  void after() {
    (void)domain.Reclaim();
    RL_ASSERT(Mortal::alive() == 0);
  }
};

TEST(PoolSearch, ClosedPoolGoesWithTheLastSlot) { EXPECT_TRUE(Search<ClosingSlotSuite>(kIterations, 4)); }

// The pool is closed already, and its holders make further ones before they go.
struct ClosedSuite : rl::test_suite<ClosedSuite, 3>, Rig<Mortal, 1> {
  ClosedSuite() : Rig({.buffers = 3, .may_grow = false}) {}
  Lease in_slot;
  Lease counted[2];
  Pool::Buffer* loan = nullptr;

  void before() {
    Publish(7);
    in_slot = latest.Lease(readers[0]);
    counted[0] = latest.Lease(readers[0]);
    counted[1] = counted[0];
    loan = latest.Loan();
    loan->value().Set(8);
    pool.reset();
  }
  void thread(unsigned index) {
    if (index == 0) {
      Lease lease = std::move(in_slot);
      const Lease copy = lease;
      lease = {};
      RL_ASSERT(copy.get()->value().Get() == 7);
    } else {
      const Lease lease = std::move(counted[index - 1]);
      RL_ASSERT(lease.get()->value().Get() == 7);
      if (index == 2) return;
      RL_ASSERT(loan->value().Get() == 8);
      loan->DropLoan();
    }
  }
  void after() {
    (void)domain.Reclaim();
    RL_ASSERT(Mortal::alive() == 0);
  }
};

TEST(PoolSearch, HoldersOfAClosedPoolMayMakeFurtherOnes) { EXPECT_TRUE(Search<ClosedSuite>(kIterations, 4)); }

// Two counted holders, of which either may be the last, and its closer.
struct ClosingCountedSuite : rl::test_suite<ClosingCountedSuite, 3>, Rig<Mortal, 1> {
  ClosingCountedSuite() : Rig({.buffers = 1, .may_grow = false}) {}
  Lease counted[2];

  void before() {
    Publish(7);
    const Lease in_slot = latest.Lease(readers[0]);
    counted[0] = counted[1] = in_slot;
  }
  void thread(unsigned index) {
    if (index == 2) return pool.reset();
    RL_ASSERT(counted[index].get()->value().Get() == 7);
    counted[index] = {};
  }
  void after() {
    (void)domain.Reclaim();
    RL_ASSERT(Mortal::alive() == 0);
  }
};

TEST(PoolSearch, ClosedPoolGoesWithTheLastOfTwoCounted) { EXPECT_TRUE(Search<ClosingCountedSuite>(kIterations, 4)); }

// A lease in a slot is dropped by another thread, while the slot's own thread leases the same newest
// buffer anew, and then the pool is closed: it is the second lease that counts.
struct ForeignDropSuite : rl::test_suite<ForeignDropSuite, 3>, Rig<Mortal, 1> {
  ForeignDropSuite() : Rig({.buffers = 1, .may_grow = false}) {}
  Lease first;
  Lease second;
  SearchedAtomic<int> is_leased_anew{0};

  void before() {
    Publish(7);
    first = latest.Lease(readers[0]);
  }
  void thread(unsigned index) {
    if (index == 0) {
      second = latest.Lease(readers[0]);
      is_leased_anew.store(1, std::memory_order_release);
    } else if (index == 1) {
      RL_ASSERT(first.get()->value().Get() == 7);
      first = {};
    } else if (is_leased_anew.load(std::memory_order_acquire) == 1) {
      pool.reset();
    }
  }
  void after() {
    RL_ASSERT(second.get()->value().Get() == 7);
    second = {};
    pool.reset();
    (void)domain.Reclaim();
    RL_ASSERT(Mortal::alive() == 0);
  }
};

TEST(PoolSearch, LeaseThatAnotherThreadDropsLeavesTheNextOneInItsSlotAlone) {
  EXPECT_TRUE(Search<ForeignDropSuite>(kIterations, 4));
}

// Two pools are closed while the one slot of a reader passes from a buffer of the first to one of
// the second: each gets the answer to its own request.
struct ClosingTwoSuite : rl::test_suite<ClosingTwoSuite, 3>, Rig<Mortal, 1> {
  ClosingTwoSuite() : Rig({.buffers = 1, .may_grow = false}) {}
  Pool::Owner other = Pool::Make(domain, {.buffers = 1, .may_grow = false}, {});
  LatestBuffer<Mortal, SearchedAtomic, 1> latest_of_other{*other};
  SearchedAtomic<int> is_leased{0};
  Lease first;

  void before() {
    Publish(7);
    first = latest.Lease(readers[0]);
    auto* const buffer = latest_of_other.Loan();
    buffer->value().Set(9);
    latest_of_other.Publish(*buffer);
  }
  void thread(unsigned index) {
    if (index == 0) {
      RL_ASSERT(first.get()->value().Get() == 7);
      first = {};
      const Lease second = latest_of_other.Lease(readers[0]);
      is_leased.store(1, std::memory_order_release);
      RL_ASSERT(second.get()->value().Get() == 9);
    } else if (index == 1) {
      pool.reset();
    } else if (is_leased.load(std::memory_order_acquire) == 1) {
      other.reset();
    }
  }
  void after() {
    other.reset();
    (void)domain.Reclaim();
    RL_ASSERT(Mortal::alive() == 0);
  }
};

TEST(PoolSearch, EachOfTwoClosedPoolsGetsItsAnswer) { EXPECT_TRUE(Search<ClosingTwoSuite>(kIterations, 1)); }

}  // namespace
}  // namespace runnel::test
