#include "core/lockfree/buffer_pool.h"

#include <atomic>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/allocation_guard.h"
#include "tests/support/threads.h"
#include "tests/support/yielding_atomic.h"

namespace runnel {
namespace {

// Counts how many of it there are.
struct Counted {
  Counted() { ++alive(); }
  Counted(const Counted&) = delete;
  Counted& operator=(const Counted&) = delete;
  ~Counted() { --alive(); }
  static std::atomic<int>& alive() {
    static std::atomic<int> count{0};
    return count;
  }
  std::uint64_t number = 0;
};

TEST(BufferPoolTest, HasAPowerOfTwoOfBuffersAtTheStart) {
  EXPECT_EQ(BufferPool<int>::Make({.buffers = 5}, {})->capacity(), 8u);
  EXPECT_EQ(BufferPool<int>::Make({.buffers = 1}, {})->capacity(), 1u);
  EXPECT_EQ(BufferPool<int>::Make({.buffers = 0}, {})->capacity(), 1u);
}

TEST(BufferPoolTest, FixedSizeIsExhaustedUntilABufferComesBack) {
  auto pool = BufferPool<int>::Make({.buffers = 2, .may_grow = false}, {});
  auto* first = pool->Loan();
  auto* second = pool->Loan();
  ASSERT_NE(first, nullptr);
  ASSERT_NE(second, nullptr);
  EXPECT_NE(first, second);
  EXPECT_EQ(pool->Loan(), nullptr);
  first->DropLoan();
  EXPECT_EQ(pool->Loan(), first);
  EXPECT_EQ(pool->growths(), 0u);
  first->DropLoan();
  second->DropLoan();
}

TEST(BufferPoolTest, GrowsWithoutMovingWhatIsOutAndCountsIt) {
  auto pool = BufferPool<std::string>::Make({.buffers = 2, .may_grow = true}, {});
  std::vector<BufferPool<std::string>::Buffer*> loans;
  for (int i = 0; i < 50; ++i) {
    loans.push_back(pool->Loan());
    loans.back()->value() = std::to_string(i);
  }
  EXPECT_EQ(std::set(loans.begin(), loans.end()).size(), 50u);
  for (int i = 0; i < 50; ++i) {
    EXPECT_EQ(loans[static_cast<std::size_t>(i)]->value(), std::to_string(i));
  }
  EXPECT_EQ(pool->capacity(), 64u);
  EXPECT_EQ(pool->growths(), 5u);  // 2 -> 4 -> 8 -> 16 -> 32 -> 64
  for (auto* each : loans) each->DropLoan();
}

TEST(BufferPoolTest, ReserveMakesRoomThatDoesNotCountAsGrowth) {
  auto pool = BufferPool<int>::Make({.buffers = 2, .may_grow = false}, {});
  pool->Reserve(5);
  EXPECT_EQ(pool->capacity(), 8u);
  std::vector<BufferPool<int>::Buffer*> loans;
  while (auto* buffer = pool->Loan()) loans.push_back(buffer);
  EXPECT_EQ(loans.size(), 8u);
  EXPECT_EQ(pool->growths(), 0u);
  for (auto* each : loans) each->DropLoan();
}

TEST(BufferPoolTest, FactoryFillsTheBuffersFirst) {
  struct Named {
    explicit Named(std::string n) : name(std::move(n)) {}
    std::string name;
  };
  auto pool = BufferPool<Named>::Make({.buffers = 2}, [] { return Named("made"); });
  auto* buffer = pool->Loan();
  EXPECT_EQ(buffer->value().name, "made");
  buffer->DropLoan();
  EXPECT_THROW(BufferPool<Named>::Make({.buffers = 2}, {}), ProgrammingError);
}

TEST(BufferPoolTest, FactoryThatThrowsHalfwayLeavesNothingBehind) {
  Counted::alive() = 0;
  struct Fragile : Counted {
    explicit Fragile(int) {}
    Fragile(Fragile&&) noexcept {}
  };
  int made = 0;
  const auto factory = [&]() -> Fragile {
    if (++made == 3) throw std::runtime_error("no more");
    return Fragile(made);
  };
  EXPECT_THROW(BufferPool<Fragile>::Make({.buffers = 4}, factory), std::runtime_error);
  EXPECT_EQ(Counted::alive(), 0);
}

TEST(BufferPoolTest, TagBecomesStaleWithTheLastLease) {
  auto pool = BufferPool<int>::Make({.buffers = 1, .may_grow = false}, {});
  auto* buffer = pool->Loan();
  buffer->value() = 7;
  const auto tag = pool->Share(*buffer);
  EXPECT_EQ(&pool->Named(tag), buffer);
  auto* second = pool->TryLease(tag);
  ASSERT_EQ(second, buffer);
  buffer->DropLease();
  EXPECT_EQ(pool->Loan(), nullptr);  // one lease is still out
  EXPECT_EQ(second->value(), 7);
  second->DropLease();
  EXPECT_EQ(pool->TryLease(tag), nullptr);
  ASSERT_EQ(pool->Loan(), buffer);
  const auto next_tag = pool->Share(*buffer);
  EXPECT_NE(next_tag, tag);
  EXPECT_EQ(pool->TryLease(tag), nullptr);  // another use of the same buffer
  buffer->DropLease();
}

TEST(BufferPoolTest, BufferKeepsWhatItsLastUseReserved) {
  auto pool = BufferPool<std::vector<int>>::Make({.buffers = 1, .may_grow = false}, {});
  auto* buffer = pool->Loan();
  buffer->value().assign(100, 1);
  (void)pool->Share(*buffer);
  buffer->DropLease();
  const test::AllocationGuard guard;
  buffer = pool->Loan();
  EXPECT_GE(buffer->value().capacity(), 100u);
  buffer->value().assign(100, 2);
  buffer->DropLoan();
  EXPECT_EQ(guard.allocations(), 0u);
}

TEST(BufferPoolTest, LeasesAndLoansOutliveThePoolThatTheyKeep) {
  Counted::alive() = 0;
  auto pool = BufferPool<Counted>::Make({.buffers = 4}, {});
  EXPECT_EQ(Counted::alive(), 4);
  auto* leased = pool->Loan();
  leased->value().number = 7;
  (void)pool->Share(*leased);
  auto* loaned = pool->Loan();
  pool.reset();
  EXPECT_EQ(Counted::alive(), 4);
  EXPECT_EQ(leased->value().number, 7u);
  loaned->DropLoan();
  EXPECT_EQ(Counted::alive(), 4);
  leased->DropLease();
  EXPECT_EQ(Counted::alive(), 0);
}

TEST(BufferPoolTest, ClosedPoolWithAllAtHomeGoesAtOnce) {
  Counted::alive() = 0;
  auto pool = BufferPool<Counted>::Make({.buffers = 4}, {});
  pool->Loan()->DropLoan();
  pool->Reserve(16);
  pool.reset();
  EXPECT_EQ(Counted::alive(), 0);
}

// Threads loan, write, check that nobody else writes, and give back.
template <template <typename> class Atomic>
void NoBufferIsInTwoHands(bool may_grow, int rounds) {
  using Pool = BufferPool<std::atomic<unsigned>, Atomic>;
  auto pool = Pool::Make({.buffers = 2, .may_grow = may_grow}, {});
  std::atomic<int> clashes{0}, loans{0};
  test::RunTogether(4, [&](unsigned index) {
    for (int i = 0; i < rounds; ++i) {
      auto* buffer = pool->Loan();
      if (buffer == nullptr) {
        std::this_thread::yield();
        continue;
      }
      ++loans;
      buffer->value() = index + 1;
      std::this_thread::yield();
      if (buffer->value() != index + 1) ++clashes;
      if (i % 2 == 0) {
        buffer->DropLoan();
      } else {
        (void)pool->Share(*buffer);
        buffer->DropLease();
      }
    }
  });
  EXPECT_EQ(clashes, 0);
  EXPECT_GT(loans, 0);
  if (may_grow) {
    EXPECT_EQ(loans, 4 * rounds);
  }
}

TEST(BufferPoolStressTest, NoBufferIsInTwoHands) {
  NoBufferIsInTwoHands<std::atomic>(false, 5000);
  NoBufferIsInTwoHands<std::atomic>(true, 5000);
}

TEST(BufferPoolStressTest, NoBufferIsInTwoHandsAtAnyInterleaving) {
  NoBufferIsInTwoHands<test::YieldingAtomic>(false, 1000);
  NoBufferIsInTwoHands<test::YieldingAtomic>(true, 1000);
}

TEST(BufferPoolStressTest, GrowingInManyThreadsAtOnceLosesNoBuffer) {
  for (int round = 0; round < 50; ++round) {
    using Pool = BufferPool<int, test::YieldingAtomic>;
    auto pool = Pool::Make({.buffers = 1, .may_grow = true}, {});
    std::vector<typename Pool::Buffer*> loans[3];
    test::RunTogether(3, [&](unsigned index) {
      for (int i = 0; i < 20; ++i) loans[index].push_back(pool->Loan());
    });
    std::set<typename Pool::Buffer*> all;
    for (auto& each : loans) all.insert(each.begin(), each.end());
    ASSERT_EQ(all.size(), 60u);
    ASSERT_FALSE(all.contains(nullptr));
    std::uint32_t rest = 0;
    while (60u + rest < pool->capacity()) {
      auto* buffer = pool->Loan();
      all.insert(buffer);
      ++rest;
    }
    ASSERT_EQ(all.size(), pool->capacity());
    for (auto* each : all) each->DropLoan();
  }
}

TEST(BufferPoolStressTest, ClosedPoolIsDestroyedOnceByWhoeverComesLast) {
  for (int round = 0; round < 200; ++round) {
    Counted::alive() = 0;
    using Pool = BufferPool<Counted, test::YieldingAtomic>;
    auto pool = Pool::Make({.buffers = 4, .may_grow = false}, {});
    typename Pool::Buffer* leases[3];
    for (auto*& each : leases) {
      each = pool->Loan();
      (void)pool->Share(*each);
    }
    test::RunTogether(4, [&](unsigned index) {
      if (index == 3) {
        pool.reset();
      } else {
        leases[index]->DropLease();
      }
    });
    ASSERT_EQ(Counted::alive(), 0);
  }
}

}  // namespace
}  // namespace runnel
