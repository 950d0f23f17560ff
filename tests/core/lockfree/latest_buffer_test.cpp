#include "core/lockfree/latest_buffer.h"

#include <array>
#include <atomic>
#include <optional>
#include <set>

#include <gtest/gtest.h>

#include "core/base/check.h"
#include "plugins/testing/guards.h"
#include "tests/core/lockfree/counted.h"
#include "tests/support/threads.h"
#include "tests/support/wait_until.h"
#include "tests/support/yielding_atomic.h"

namespace runnel {
namespace {

using test::Counted;

/// A pool with its newest buffer, and the records of `kReaders` threads with `kSlots` slots each.
template <typename T, std::size_t kReaders = 1, template <typename> class Atomic = std::atomic, std::size_t kSlots = 7>
struct Rig {
  using Pool = BufferPool<T, Atomic, kSlots>;
  using Lease = BufferLease<T, Atomic, kSlots>;

  explicit Rig(const PoolOptions& options) : pool(Pool::Make(domain, options, {})) {
    for (auto& each : readers) domain.Add(each);
    latest.emplace(*pool);
  }
  // A loan that must succeed.
  auto& Loaned() {
    auto* const buffer = latest->Loan();
    RUNNEL_CHECK(buffer != nullptr, "the test's pool is too small");
    return *buffer;
  }
  auto& Publish() {
    auto& buffer = Loaned();
    latest->Publish(buffer);
    return buffer;
  }

  HazardDomain<Atomic, kSlots> domain;
  std::array<HazardRecord<Atomic, kSlots>, kReaders> readers;
  typename Pool::Owner pool;
  std::optional<LatestBuffer<T, Atomic, kSlots>> latest;
};

TEST(LatestBufferTest, HasNothingBeforeTheFirstValue) {
  Rig<int> rig({.buffers = 2});
  EXPECT_EQ(rig.latest->Lease(rig.readers[0]).get(), nullptr);
}

TEST(LatestBufferTest, GivesTheVeryBufferThatWasPublished) {
  Rig<int> rig({.buffers = 2});
  auto& written = rig.Loaned();
  written.value() = 7;
  rig.latest->Publish(written);
  EXPECT_EQ(rig.latest->Lease(rig.readers[0]).get(), &written);
}

TEST(LatestBufferTest, NeitherTheNewestNorALeasedBufferIsFree) {
  Rig<int> rig({.buffers = 2, .may_grow = false});
  auto& first = rig.Publish();
  auto lease = rig.latest->Lease(rig.readers[0]);
  rig.Publish();
  EXPECT_EQ(rig.latest->Loan(), nullptr);
  lease = {};
  EXPECT_EQ(rig.latest->Loan(), &first);
  EXPECT_EQ(rig.latest->Loan(), nullptr);  // the newest one, and the loan
  first.DropLoan();
}

// Publishes as the thread of `record`, if there is a buffer.
template <typename Rig, typename Record>
auto* PublishAs(Rig& rig, Record& record) {
  auto* const buffer = rig.latest->Loan(record);
  if (buffer != nullptr) rig.latest->Publish(*buffer);
  return buffer;
}

TEST(LatestBufferTest, LeaseOfThePublishersOwnThreadHoldsAsAnyOther) {
  Rig<int> rig({.buffers = 2, .may_grow = false});
  auto& own = rig.readers[0];
  for (int i = 0; i < 3; ++i) {
    ASSERT_NE(PublishAs(rig, own), nullptr);
    EXPECT_NE(rig.latest->Lease(own).get(), nullptr);
  }
  auto lease = rig.latest->Lease(own);
  ASSERT_NE(PublishAs(rig, own), nullptr);
  EXPECT_EQ(rig.latest->Loan(own), nullptr);
  auto* const held = lease.get();
  lease = {};
  EXPECT_EQ(rig.latest->Loan(own), held);
  held->DropLoan();
}

TEST(LatestBufferTest, LeasesHoldHoweverOftenThePublisherChanges) {
  Rig<int, 2> rig({.buffers = 2, .may_grow = false});
  for (std::size_t i = 0; i < 40; ++i) {
    auto& publisher = rig.readers[i / 2 % 2];  // each of them twice, and so it reads as the only one
    ASSERT_NE(PublishAs(rig, publisher), nullptr);
    auto lease = rig.latest->Lease(publisher);
    ASSERT_NE(PublishAs(rig, publisher), nullptr);
    for (auto& each : rig.readers) EXPECT_EQ(rig.latest->Loan(each), nullptr);
  }
}

TEST(LatestBufferTest, CopyOfALeaseHoldsByItself) {
  Rig<int> rig({.buffers = 2, .may_grow = false});
  auto& first = rig.Publish();
  auto lease = rig.latest->Lease(rig.readers[0]);
  auto copy = lease;
  EXPECT_EQ(copy.get(), &first);
  lease = {};
  rig.Publish();
  EXPECT_EQ(rig.latest->Loan(), nullptr);
  auto moved = std::move(copy);
  EXPECT_EQ(rig.latest->Loan(), nullptr);
  moved = {};
  ASSERT_EQ(rig.latest->Loan(), &first);
  first.DropLoan();
}

TEST(LatestBufferTest, MoreLeasesThanSlotsHoldAsWell) {
  Rig<int, 1, std::atomic, 2> rig({.buffers = 6, .may_grow = false});
  std::vector<decltype(rig)::Lease> leases;
  std::set<const void*> held;
  for (int i = 0; i < 5; ++i) {
    rig.Publish();
    leases.push_back(rig.latest->Lease(rig.readers[0]));
    held.insert(leases.back().get());
  }
  EXPECT_EQ(held.size(), 5u);
  auto& sixth = rig.Publish();
  EXPECT_EQ(rig.latest->Loan(), nullptr);
  leases.clear();
  std::set<const void*> free;
  std::vector<decltype(rig)::Pool::Buffer*> loans;
  while (auto* buffer = rig.latest->Loan()) {
    free.insert(buffer);
    loans.push_back(buffer);
  }
  EXPECT_EQ(free, held);
  EXPECT_FALSE(free.contains(&sixth));
  for (auto* loan : loans) loan->DropLoan();
}

TEST(LatestBufferTest, MoreThreadsThanBitsAreLookedAtAsWell) {
  Rig<int, 70> rig({.buffers = 72, .may_grow = false});
  std::vector<decltype(rig)::Lease> leases;
  for (auto& reader : rig.readers) {
    rig.Publish();
    leases.push_back(rig.latest->Lease(reader));
  }
  rig.Publish();
  auto* rest = rig.latest->Loan();
  ASSERT_NE(rest, nullptr);
  EXPECT_EQ(rig.latest->Loan(), nullptr);
  auto* const last = leases.back().get();
  leases.pop_back();
  EXPECT_EQ(rig.latest->Loan(), last);
  rest->DropLoan();
  last->DropLoan();
}

TEST(LatestBufferTest, LeasingAllocatesNothing) {
  Rig<int> rig({.buffers = 2});
  rig.Publish();
  const test::AllocationGuard guard;
  {
    const auto lease = rig.latest->Lease(rig.readers[0]);
    const auto copy = lease;
  }
  EXPECT_EQ(guard.allocations(), 0u);
}

TEST(LatestBufferTest, LeasesOfAnyKindKeepAClosedPoolUntilTheLastOneHasGone) {
  Counted::alive() = 0;
  Rig<Counted, 1, std::atomic, 1> rig({.buffers = 3});
  rig.Publish().value().number = 7;
  auto in_slot = rig.latest->Lease(rig.readers[0]);
  auto counted = rig.latest->Lease(rig.readers[0]);
  rig.Publish();
  rig.pool.reset();
  EXPECT_EQ(Counted::alive(), 3);
  EXPECT_EQ(in_slot.get()->value().number, 7u);
  auto copy = in_slot;
  in_slot = {};
  counted = {};
  EXPECT_EQ(rig.domain.Reclaim(), 1u);
  EXPECT_EQ(Counted::alive(), 3);
  EXPECT_EQ(copy.get()->value().number, 7u);
  auto late = std::move(copy);
  {
    const test::AllocationGuard guard;
    late = {};
    EXPECT_EQ(guard.releases(), 0u) << "who reads in a cycle frees no memory";
  }
  EXPECT_EQ(rig.domain.Reclaim(), 0u);
  EXPECT_EQ(Counted::alive(), 0);
}

// A value of many words that says itself whether it is whole.
struct Wide {
  std::array<std::uint64_t, 32> words{};
};

template <template <typename> class Atomic, std::size_t kSlots>
void LeasedValueDoesNotChange(std::uint64_t publications) {
  Rig<Wide, 2, Atomic, kSlots> rig({.buffers = 4, .may_grow = true});
  std::atomic<std::uint64_t> torn{0}, backward{0};
  test::RunTogether(3, [&](unsigned index) {
    if (index == 2) {
      for (std::uint64_t i = 1; i <= publications; ++i) {
        auto& buffer = rig.Loaned();
        buffer.value().words.fill(i);
        rig.latest->Publish(buffer);
      }
      return;
    }
    for (std::uint64_t last = 0; last < publications;) {
      const auto other = rig.latest->Lease(rig.readers[index]);
      const auto lease = rig.latest->Lease(rig.readers[index]);
      if (lease.get() == nullptr) continue;
      const auto& words = lease.get()->value().words;
      const std::uint64_t first = words[0];
      if (first < last) ++backward;
      last = first;
      std::this_thread::yield();
      for (const std::uint64_t each : words) {
        if (each != first) ++torn;
      }
    }
  });
  EXPECT_EQ(torn, 0u);
  EXPECT_EQ(backward, 0u);
  EXPECT_LE(rig.pool->capacity(), 8u);  // four leases, a loan and the newest, grown by doubling
}

TEST(LatestBufferStressTest, LeasedValueDoesNotChange) {
  LeasedValueDoesNotChange<std::atomic, 7>(30000);
  LeasedValueDoesNotChange<std::atomic, 1>(30000);
}
TEST(LatestBufferStressTest, LeasedValueDoesNotChangeAtAnyInterleaving) {
  LeasedValueDoesNotChange<test::YieldingAtomic, 7>(2000);
  LeasedValueDoesNotChange<test::YieldingAtomic, 1>(2000);
}

TEST(LatestBufferStressTest, ClosedPoolIsDestroyedOnceWhenAllHaveGone) {
  for (int round = 0; round < 300; ++round) {
    Counted::alive() = 0;
    Rig<Counted, 3, test::YieldingAtomic, 1> rig({.buffers = 4, .may_grow = false});
    std::array<decltype(rig)::Lease, 3> leases;
    for (std::size_t i = 0; i < 3; ++i) {
      rig.Publish();
      leases[i] = rig.latest->Lease(rig.readers[i]);
    }
    test::RunTogether(4, [&](unsigned index) {
      if (index == 3) {
        rig.pool.reset();
      } else if (index == 0) {
        leases[0] = {};
      } else {
        const auto copy = leases[index];
        leases[index] = {};
      }
      (void)rig.domain.Reclaim();
    });
    ASSERT_EQ(rig.domain.Reclaim(), 0u);
    ASSERT_EQ(Counted::alive(), 0);
  }
}

// Two pools are closed while one slot goes from a buffer of the first to one of the second.
TEST(LatestBufferStressTest, PoolsThatAreClosedAtOnceLookAtOneSlot) {
  for (int round = 0; round < 300; ++round) {
    Counted::alive() = 0;
    Rig<Counted, 1, test::YieldingAtomic, 1> first({.buffers = 1});
    auto second_pool = decltype(first)::Pool::Make(first.domain, {.buffers = 1}, {});
    LatestBuffer<Counted, test::YieldingAtomic, 1> second(*second_pool);
    second.Publish(*second.Loan());
    first.Publish();
    auto lease = first.latest->Lease(first.readers[0]);
    std::atomic<bool> has_second{false};
    test::RunTogether(3, [&](unsigned index) {
      if (index == 0) {
        lease = {};
        lease = second.Lease(first.readers[0]);
        has_second = true;
        lease = {};
      } else if (index == 1) {
        first.pool.reset();
      } else {
        // Nobody reads a closed pool's newest.
        test::YieldUntil("the second is leased", [&] { return has_second.load(); });
        second_pool.reset();
      }
    });
    ASSERT_EQ(first.domain.Reclaim(), 0u);
    ASSERT_EQ(Counted::alive(), 0);
  }
}

}  // namespace
}  // namespace runnel
