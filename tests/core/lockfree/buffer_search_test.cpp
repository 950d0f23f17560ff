#include "tests/core/lockfree/search.h"
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

TEST(BufferSearch, LeasedValueDoesNotChange) { EXPECT_TRUE(Search<LeasingSuite>(kIterations, 1)); }

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

TEST(BufferSearch, LeasedValueDoesNotChangeWithoutASlot) { EXPECT_TRUE(Search<CountedSuite>(kIterations, 2)); }

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

TEST(BufferSearch, CopyOfALeaseHoldsWithoutAGap) { EXPECT_TRUE(Search<CopyingSuite>(kIterations, 3)); }

// The same while the publisher looks for a free buffer, and the leased one is no longer the newest: a
// schedule that begins there, since hardly any gets there if each step is drawn.
struct CopyingLateSuite : rl::test_suite<CopyingLateSuite, 2>, Rig<SearchedPlain, 1> {
  CopyingLateSuite() : Rig({.buffers = 2, .may_grow = false}) {}

  void before() {
    Publish(1);
    lease = latest.Lease(readers[0]);
    Publish(2);
  }
  void thread(unsigned index) {
    if (index == 1) return Publish(3);
    const Lease copy = lease;
    lease = {};
    LookAt(copy);
  }

  Lease lease;
};

TEST(BufferSearch, CopyOfAnOldLeaseHoldsWithoutAGap) { EXPECT_TRUE(Search<CopyingLateSuite>(kIterations, 4)); }

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

TEST(BufferSearch, LeaseMayBeDroppedByAnotherThread) { EXPECT_TRUE(Search<HandingOnSuite>(kIterations, 1)); }

// Another thread empties a slot, which is then filled anew: a publisher that sees only the latter
// has the other's look behind it.
struct RefillingSuite : rl::test_suite<RefillingSuite, 3>, Rig<SearchedPlain, 1> {
  RefillingSuite() : Rig({.buffers = 2, .may_grow = false}) {}
  Lease handed;

  void before() {
    Publish(1);
    handed = latest.Lease(readers[0]);
    Publish(2);
  }
  void thread(unsigned index) {
    if (index == 0) {
      LookAt(handed);
      handed = {};
    } else if (index == 1) {
      LookAt(latest.Lease(readers[0]));
    } else {
      Publish(3);
    }
  }
};

TEST(BufferSearch, SlotThatIsFilledAnewSaysThatTheOldBufferIsFree) {
  EXPECT_TRUE(Search<RefillingSuite>(5 * kIterations, 3));
}

// The buffers that a counted lease meets are made while it looks.
struct GrowingSuite : rl::test_suite<GrowingSuite, 2>, Rig<SearchedPlain, 1> {
  GrowingSuite() : Rig({.buffers = 1, .may_grow = true}) {}
  Lease in_slot;

  void before() {
    Publish(1);
    in_slot = latest.Lease(readers[0]);
  }
  void thread(unsigned index) {
    if (index == 1) return Publish(2);
    LookAt(latest.Lease(readers[0]));
  }
  void after() { in_slot = {}; }
};

TEST(BufferSearch, BuffersThatAreNewAreCompleteForWhoCounts) { EXPECT_TRUE(Search<GrowingSuite>(kIterations, 3)); }

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

TEST(BufferSearch, PublisherMayReadItself) { EXPECT_TRUE(Search<OwnReaderSuite>(kIterations, 2)); }

// The publisher's thread reads, too, and spares itself its fences as a reader, until another thread
// takes over and publishes.
template <typename T>
struct TakingOverRig : Rig<T, 2> {
  using Rig<T, 2>::Rig;
  using Rig<T, 2>::latest;
  using Rig<T, 2>::readers;

  bool PublishAs(std::size_t index, int value) {
    auto* const buffer = latest.Loan(readers[index]);
    if (buffer == nullptr) return false;
    buffer->value().Set(value);
    buffer->publication.sequence = static_cast<std::uint64_t>(value);
    latest.Publish(*buffer);
    return true;
  }
  // By the first thread: the values from 1 to `last`.
  void PublishAndLook(int last) {
    PublishAs(0, 1);
    for (int i = 2; i <= last; ++i) {
      LookAt(latest.Lease(readers[0]));  // the first sets the bit, and the next search sees it
      RL_ASSERT(PublishAs(0, i));
    }
  }
};
struct TakingOverSuite : rl::test_suite<TakingOverSuite, 2>, TakingOverRig<SearchedPlain> {
  TakingOverSuite() : TakingOverRig({.buffers = 2, .may_grow = false}) {}

  void before() { PublishAndLook(5); }
  void thread(unsigned index) {
    if (index == 0) {
      for (int i = 0; i < 2; ++i) LookAt(latest.Lease(readers[0]));
    } else {
      for (int i = 6; i <= 8; ++i) PublishAs(1, i);
    }
  }
};

TEST(BufferSearch, WhoTakesOverPublishingIsSeenByWhoDidSoBefore) {
  EXPECT_TRUE(Search<TakingOverSuite>(kIterations, 2));
}

// The other thread finds a buffer that is free already, and so publishes before it has looked for one:
// who published before still leases without a second look.
struct ThreeValues {
  SearchedPlain values[3];
  std::size_t made = 0;
};
struct TakingOverAtOnceSuite : rl::test_suite<TakingOverAtOnceSuite, 2>, ThreeValues, TakingOverRig<Elsewhere> {
  TakingOverAtOnceSuite()
      : TakingOverRig({.buffers = 3, .may_grow = false}, [this] { return Elsewhere{&values[made++]}; }) {}

  void before() { PublishAndLook(4); }
  void thread(unsigned index) {
    if (index == 0) {
      LookAt(latest.Lease(readers[0]));
    } else {
      RL_ASSERT(PublishAs(1, 5));
    }
  }
};

TEST(BufferSearch, ValueOfWhoTakesOverIsCompleteForWhoPublishedBefore) {
  EXPECT_TRUE(Search<TakingOverAtOnceSuite>(kIterations, 4));
}

// A record is added while the publisher looks for free buffers.
// With nine before it, it has no bit of its own.
template <std::size_t kBefore>
struct LateRecord {  // a base, since a record is there for as long as its domain
  std::optional<typename Rig<SearchedPlain, kBefore>::Domain::Record> late;
};
template <std::size_t kBefore>
struct AddingSuite : rl::test_suite<AddingSuite<kBefore>, 2>, LateRecord<kBefore>, Rig<SearchedPlain, kBefore> {
  using Base = Rig<SearchedPlain, kBefore>;
  AddingSuite() : Base({.buffers = 2, .may_grow = false}) {}

  void thread(unsigned index) {
    if (index == 1) {
      for (int i = 1; i <= 4; ++i) this->Publish(i);
      return;
    }
    // Made here, so that it may be met incomplete.
    this->domain.Add(this->late.emplace());
    const auto lease = this->latest.Lease(*this->late);
    if (lease.get() != nullptr) LookAt(lease);
  }
};

TEST(BufferSearch, ThreadThatIsNewIsSeen) {
  EXPECT_TRUE(Search<AddingSuite<1>>(kIterations, 3));
  EXPECT_TRUE(Search<AddingSuite<9>>(kIterations, 2));
}

// Two readers share a bit, and one of them finds it set by the other just now.
struct SharedBitSuite : rl::test_suite<SharedBitSuite, 3>, Rig<SearchedPlain, 11> {
  SharedBitSuite() : Rig({.buffers = 2, .may_grow = false}) {}

  void before() { Publish(1); }
  void thread(unsigned index) {
    if (index == 2) {
      for (int i = 2; i <= 3; ++i) Publish(i);
    } else {
      LookAt(latest.Lease(readers[9 + index]));
    }
  }
};

TEST(BufferSearch, ReadersThatShareABitAreSeenEach) { EXPECT_TRUE(Search<SharedBitSuite>(5 * kIterations, 1)); }

}  // namespace
}  // namespace runnel::test
