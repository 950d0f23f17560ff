#include "core/lockfree/buffer_pool.h"

#include <atomic>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/lockfree/buffer_lease.h"
#include "plugins/testing/guards.h"
#include "tests/core/lockfree/counted.h"
#include "tests/support/threads.h"

namespace runnel {
namespace {

using test::Counted;

/// A pool of which nothing is ever published: who holds a buffer is the loan, or is counted.
template <typename T>
struct Pool {
  explicit Pool(const PoolOptions& options, std::function<T()> factory = {})
      : owner(BufferPool<T>::Make(domain, options, std::move(factory))) {}
  Buffer<T>* Loan() {
    return owner->Loan(nullptr, [] { return HazardDomain<>::kAll; });
  }
  // Ends a loan with one counted holder, as publishing into a queue does.
  static Buffer<T>* Hold(Buffer<T>* loan) {
    loan->AddReferences(1);
    loan->EndLoan();
    return loan;
  }

  HazardDomain<> domain;
  typename BufferPool<T>::Owner owner;
};

TEST(BufferPoolTest, HasAsManyBuffersAsAskedForAndAtLeastOne) {
  EXPECT_EQ(Pool<int>({.buffers = 5}).owner->capacity(), 5u);
  EXPECT_EQ(Pool<int>({.buffers = 0}).owner->capacity(), 1u);
}

TEST(BufferPoolTest, FixedSizeIsExhaustedUntilNobodyHoldsABuffer) {
  Pool<int> pool({.buffers = 2, .may_grow = false});
  auto* first = pool.Loan();
  auto* second = pool.Loan();
  ASSERT_NE(first, nullptr);
  ASSERT_NE(second, nullptr);
  EXPECT_NE(first, second);
  EXPECT_EQ(pool.Loan(), nullptr);
  first->DropLoan();
  EXPECT_EQ(pool.Loan(), first);
  pool.Hold(first);
  EXPECT_EQ(pool.Loan(), nullptr);
  first->AddReferences(1);
  first->ReleaseReference();
  EXPECT_EQ(pool.Loan(), nullptr);
  first->ReleaseReference();
  EXPECT_EQ(pool.Loan(), first);
  EXPECT_EQ(pool.owner->growths(), 0u);
  first->DropLoan();
  second->DropLoan();
}

TEST(BufferPoolTest, GrowsWithoutMovingWhatIsOutAndCountsIt) {
  Pool<std::string> pool({.buffers = 2, .may_grow = true});
  std::vector<Buffer<std::string>*> loans;
  for (int i = 0; i < 50; ++i) {
    loans.push_back(pool.Loan());
    loans.back()->value() = std::to_string(i);
  }
  EXPECT_EQ(std::set(loans.begin(), loans.end()).size(), 50u);
  for (int i = 0; i < 50; ++i) {
    EXPECT_EQ(loans[static_cast<std::size_t>(i)]->value(), std::to_string(i));
  }
  EXPECT_EQ(pool.owner->capacity(), 64u);
  EXPECT_EQ(pool.owner->growths(), 5u);  // 2 -> 4 -> 8 -> 16 -> 32 -> 64
  for (auto* each : loans) each->DropLoan();
}

TEST(BufferPoolTest, ReserveMakesRoomThatDoesNotCountAsGrowthNorAllocateLater) {
  Pool<int> pool({.buffers = 2, .may_grow = false});
  auto* before = pool.Loan();
  pool.owner->Reserve(5);
  pool.owner->Reserve(3);
  pool.owner->Reserve(9);
  EXPECT_EQ(pool.owner->capacity(), 9u);
  const test::AllocationGuard guard;
  std::array<Buffer<int>*, 9> loans{before};
  for (std::size_t i = 1; i < 9; ++i) loans[i] = pool.Loan();
  EXPECT_EQ(pool.Loan(), nullptr);
  EXPECT_EQ(guard.allocations(), 0u);
  EXPECT_EQ(std::set(loans.begin(), loans.end()).size(), 9u);
  EXPECT_EQ(pool.owner->growths(), 0u);
  for (auto* each : loans) each->DropLoan();
}

TEST(BufferPoolTest, FactoryFillsTheBuffersFirst) {
  struct Named {
    explicit Named(std::string n) : name(std::move(n)) {}
    std::string name;
  };
  Pool<Named> pool({.buffers = 2}, [] { return Named("made"); });
  auto* buffer = pool.Loan();
  EXPECT_EQ(buffer->value().name, "made");
  buffer->DropLoan();
  EXPECT_THROW(Pool<Named>({.buffers = 2}), ProgrammingError);
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
  EXPECT_THROW(Pool<Fragile>({.buffers = 4}, factory), std::runtime_error);
  EXPECT_EQ(Counted::alive(), 0);
}

TEST(BufferPoolTest, FactoryThatThrowsWhenThePoolGrowsChangesNothing) {
  int made = 0;
  Pool<std::string> pool({.buffers = 1}, [&]() -> std::string {
    if (++made == 2) throw std::runtime_error("no more");
    return "made";
  });
  auto* first = pool.Loan();
  EXPECT_THROW((void)pool.Loan(), std::runtime_error);
  EXPECT_EQ(pool.owner->capacity(), 1u);
  EXPECT_EQ(pool.owner->growths(), 0u);
  auto* second = pool.Loan();
  ASSERT_NE(second, nullptr);
  EXPECT_EQ(second->value(), "made");
  first->DropLoan();
  second->DropLoan();
}

TEST(BufferPoolTest, BufferKeepsWhatItsLastUseReserved) {
  Pool<std::vector<int>> pool({.buffers = 1, .may_grow = false});
  auto* buffer = pool.Loan();
  buffer->value().assign(100, 1);
  pool.Hold(buffer)->ReleaseReference();
  const test::AllocationGuard guard;
  buffer = pool.Loan();
  EXPECT_GE(buffer->value().capacity(), 100u);
  buffer->value().assign(100, 2);
  buffer->DropLoan();
  EXPECT_EQ(guard.allocations(), 0u);
}

TEST(BufferPoolTest, WritesBigValuesWhereTheLastOnesHaveBeen) {
  Pool<std::vector<int>> pool({.buffers = 8});
  std::set<Buffer<std::vector<int>>*> used;
  for (int i = 0; i < 20; ++i) {
    used.insert(pool.Loan());
    pool.Hold(*used.begin())->ReleaseReference();
  }
  EXPECT_EQ(used.size(), 1u);
}

TEST(BufferPoolTest, LoansAndCountedHoldersKeepAClosedPool) {
  Counted::alive() = 0;
  Pool<Counted> pool({.buffers = 4});
  EXPECT_EQ(Counted::alive(), 4);
  auto* held = pool.Hold(pool.Loan());
  held->value().number = 7;
  auto* loaned = pool.Loan();
  pool.owner.reset();
  EXPECT_EQ(Counted::alive(), 4);
  EXPECT_EQ(held->value().number, 7u);
  loaned->DropLoan();
  EXPECT_EQ(pool.domain.Reclaim(), 1u);
  held->AddReferences(1);
  held->ReleaseReference();
  EXPECT_EQ(pool.domain.Reclaim(), 1u);
  EXPECT_EQ(Counted::alive(), 4);
  held->ReleaseReference();
  EXPECT_EQ(Counted::alive(), 4);
  EXPECT_EQ(pool.domain.Reclaim(), 0u);
  EXPECT_EQ(Counted::alive(), 0);
}

TEST(BufferPoolTest, ClosedPoolGoesWhenAnotherIsClosedAndNobodyHoldsItAnyMore) {
  Counted::alive() = 0;
  Pool<Counted> pool({.buffers = 4});
  auto* const loaned = pool.Loan();
  auto other = BufferPool<int>::Make(pool.domain, {}, {});
  auto another = BufferPool<int>::Make(pool.domain, {}, {});
  pool.owner.reset();
  other.reset();
  EXPECT_EQ(Counted::alive(), 4);
  loaned->DropLoan();
  another.reset();
  EXPECT_EQ(Counted::alive(), 0);
}

TEST(BufferPoolTest, ClosedPoolThatNobodyHoldsGoesAtOnce) {
  Counted::alive() = 0;
  Pool<Counted> pool({.buffers = 4});
  pool.Loan()->DropLoan();
  pool.owner->Reserve(16);
  pool.owner.reset();
  EXPECT_EQ(Counted::alive(), 0);
}

TEST(BufferPoolStressTest, ReservingWhileThePublisherLoansLosesNoBuffer) {
  for (int round = 0; round < 50; ++round) {
    Pool<int> pool({.buffers = 1, .may_grow = true});
    std::vector<Buffer<int>*> loans;
    test::RunTogether(3, [&](unsigned index) {
      if (index == 0) {
        for (int i = 0; i < 60; ++i) loans.push_back(pool.Loan());
      } else {
        for (unsigned i = 1; i < 10; ++i) pool.owner->Reserve(8 * i + index);
      }
    });
    while (loans.size() < pool.owner->capacity()) loans.push_back(pool.Loan());
    ASSERT_EQ(std::set(loans.begin(), loans.end()).size(), pool.owner->capacity());
    ASSERT_EQ(std::count(loans.begin(), loans.end(), nullptr), 0);
    for (auto* each : loans) each->DropLoan();
  }
}

}  // namespace
}  // namespace runnel
