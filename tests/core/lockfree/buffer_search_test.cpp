#include "tests/core/lockfree/searched_atomic.h"
// The search must come first: it renames what the standard headers below use.

#include "core/lockfree/latest_buffer.h"

namespace runnel::test {
namespace {

constexpr unsigned kIterations = 100000;

// Few slots and records, so that each way of holding comes up in short schedules.
template <typename T, std::size_t kReaders>
struct Rig {
  using Domain = HazardDomain<SearchedAtomic, 1>;
  using Pool = BufferPool<T, SearchedAtomic, 1>;
  using Lease = BufferLease<T, SearchedAtomic, 1>;

  explicit Rig(const PoolOptions& options) : pool(Pool::Make(domain, options, {})), latest(*pool) {
    for (auto& each : readers) domain.Add(each);
  }
  // Publishes `value` if there is a buffer.
  void Publish(int value) {
    auto* const buffer = latest.Loan();
    if (buffer == nullptr) return;
    buffer->value().Set(value);
    buffer->publication.sequence = static_cast<std::uint64_t>(value);
    latest.Publish(*buffer);
  }

  Domain domain;
  typename Domain::Record readers[kReaders];
  typename Pool::Owner pool;
  LatestBuffer<T, SearchedAtomic, 1> latest;
};

// The value may be looked at, and does not change. A buffer that is written while it is held is a
// race on its plain value.
template <typename Lease>
int LookAt(const Lease& lease) {
  const int value = lease.get()->value().Get();
  RL_ASSERT(value > 0);
  RL_ASSERT(static_cast<std::uint64_t>(value) == lease.get()->publication.sequence);
  RL_ASSERT(lease.get()->value().Get() == value);
  return value;
}

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
    auto* const out =
        again != nullptr || is_dropped ? again : loaned.load(std::memory_order_relaxed);
    if (out != nullptr) out->DropLoan();
  }
};

TEST(BufferSearch, LoanGivenBackIsWrittenAgainOnlyThen) {
  EXPECT_TRUE(Search<LoanSuite>(kIterations));
}

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

TEST(BufferSearch, ReservedBuffersAreCompleteWhenTheyArrive) {
  EXPECT_TRUE(Search<ReservingSuite>(kIterations));
}

// Counts how many of it there are; its death is a race if anybody still looks.
struct Mortal : SearchedPlain {
  Mortal() { ++alive(); }
  ~Mortal() {
    Set(-1);
    --alive();
  }
  static int& alive() {
    static int count = 0;
    return count;
  }
};

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
  void after() { RL_ASSERT(Mortal::alive() == 0); }
};

TEST(BufferSearch, ClosedPoolGoesWithItsLastHolder) {
  EXPECT_TRUE(Search<ClosingSuite>(kIterations));
}

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
  void after() { RL_ASSERT(Mortal::alive() == 0); }
};

TEST(BufferSearch, ClosedPoolGoesWithTheLastSlot) {
  EXPECT_TRUE(Search<ClosingSlotSuite>(kIterations));
}

// The publisher reads what it has published, and spares itself the fence, while another reads too.
struct OwnReaderSuite : rl::test_suite<OwnReaderSuite, 2>, Rig<SearchedPlain, 2> {
  OwnReaderSuite() : Rig({.buffers = 3, .may_grow = false}) {}

  void thread(unsigned index) {
    if (index == 1) {
      for (int i = 1; i <= 4; ++i) {
        const Lease own = latest.Lease(readers[1]);
        if (auto* const buffer = latest.Loan(readers[1])) {
          buffer->value().Set(i);
          buffer->publication.sequence = static_cast<std::uint64_t>(i);
          latest.Publish(*buffer);
        }
        if (own.get() != nullptr) LookAt(own);
      }
      return;
    }
    for (int i = 0; i < 2; ++i) {
      const Lease lease = latest.Lease(readers[0]);
      if (lease.get() != nullptr) LookAt(lease);
    }
  }
};

TEST(BufferSearch, PublisherMayReadItself) { EXPECT_TRUE(Search<OwnReaderSuite>(kIterations)); }

// A record is added while the publisher looks for free buffers.
struct AddingSuite : rl::test_suite<AddingSuite, 2>, Rig<SearchedPlain, 1> {
  AddingSuite() : Rig({.buffers = 2, .may_grow = false}) {}
  Domain::Record late;

  void thread(unsigned index) {
    if (index == 1) {
      for (int i = 1; i <= 4; ++i) Publish(i);
      return;
    }
    domain.Add(late);
    const Lease lease = latest.Lease(late);
    if (lease.get() != nullptr) LookAt(lease);
  }
};

TEST(BufferSearch, ThreadThatIsNewIsSeen) { EXPECT_TRUE(Search<AddingSuite>(kIterations)); }

}  // namespace
}  // namespace runnel::test
