#include "tests/core/lockfree/search.h"
#include "tests/core/lockfree/searched_atomic.h"
// The search must come first: it renames what the standard headers below use.

#include "tests/core/lockfree/buffer_rig.h"

namespace runnel::test {
namespace {

constexpr unsigned kIterations = 100000;

// An origin, and one more that publishes on what it has leased there.
template <typename T, std::size_t kReaders>
struct ForwardingRig : Rig<T, kReaders> {
  using Base = Rig<T, kReaders>;
  using typename Base::Lease;
  using typename Base::Pool;
  using Latest = LatestBuffer<T, SearchedAtomic, 1>;

  explicit ForwardingRig(std::uint32_t buffers, std::uint32_t own_buffers = 2)
      : Base({.buffers = buffers, .may_grow = false}),
        pool_of_next(Pool::Make(this->domain, {.buffers = own_buffers, .may_grow = false}, {})),
        next(*pool_of_next) {}

  static bool Forward(Latest& to, const Lease& lease) {
    if (lease.get() == nullptr) return false;
    auto* const buffer = to.LoanAnew(nullptr);
    if (buffer == nullptr) return false;
    buffer->ReferTo(*lease.get());
    buffer->publication.sequence = 100 + lease.get()->publication.sequence;
    to.Publish(*buffer);
    return true;
  }
  // What is seen by who has forwarded is the same as at the origin, but for the number.
  static void LookAtForwarded(const Lease& lease) {
    if (lease.get() == nullptr) return;
    const int value = lease.get()->published_value().Get();
    RL_ASSERT(value > 0);
    RL_ASSERT(static_cast<std::uint64_t>(value) + 100 == lease.get()->publication.sequence);
    RL_ASSERT(lease.get()->published_value().Get() == value);
  }

  typename Pool::Owner pool_of_next;
  Latest next;
};

// The origin goes through its buffers while another forwards and a third reads what is forwarded.
struct ForwardingSuite : rl::test_suite<ForwardingSuite, 3>, ForwardingRig<SearchedPlain, 2> {
  ForwardingSuite() : ForwardingRig(3) {}

  void before() { Publish(1); }
  void thread(unsigned index) {
    if (index == 0) {
      for (int i = 2; i <= 4; ++i) Publish(i);
    } else if (index == 1) {
      for (int i = 0; i < 2; ++i) (void)Forward(next, latest.Lease(readers[0]));
    } else {
      LookAtForwarded(next.Lease(readers[1]));
    }
  }
};

TEST(ForwardingSearch, ForwardedValueDoesNotChange) { EXPECT_TRUE(Search<ForwardingSuite>(kIterations, 1)); }

// The same with nothing but the forwarding that holds the value, which ends just now; begins there,
// since hardly any schedule gets there if each step is drawn.
struct EndingSuite : rl::test_suite<EndingSuite, 3>, ForwardingRig<SearchedPlain, 2> {
  EndingSuite() : ForwardingRig(2) {}

  void before() {
    Publish(1);
    RL_ASSERT(Forward(next, latest.Lease(readers[0])));
    Publish(2);
    RL_ASSERT(latest.Loan() == nullptr);
  }
  void thread(unsigned index) {
    if (index == 0) {
      Publish(3);
    } else if (index == 1) {
      // The first takes the place as the newest, the second finds that nobody holds what was there.
      for (int i = 0; i < 2; ++i) (void)Forward(next, latest.Lease(readers[0]));
    } else {
      LookAtForwarded(next.Lease(readers[1]));
    }
  }
  void after() {
    Publish(4);
    Publish(5);
    for (int i = 0; i < 2; ++i) (void)Forward(next, latest.Lease(readers[0]));
    next.ReleaseUnused(nullptr);
    auto* const loan = latest.Loan();
    RL_ASSERT(loan != nullptr);  // what is not forwarded any more is free
    loan->DropLoan();
  }
};

TEST(ForwardingSearch, ValueIsFreeWhenItIsForwardedNoMoreAndNotBefore) {
  EXPECT_TRUE(Search<EndingSuite>(kIterations, 1));
}

// What is forwarded is forwarded again, while the one between lets go of it.
struct ChainSuite : rl::test_suite<ChainSuite, 3>, ForwardingRig<SearchedPlain, 2> {
  ChainSuite() : ForwardingRig(2) {}
  Pool::Owner pool_of_last = Pool::Make(domain, {.buffers = 1, .may_grow = false}, {});
  Latest last{*pool_of_last};
  Lease forwarded;

  void before() {
    Publish(1);
    RL_ASSERT(Forward(next, latest.Lease(readers[0])));
    Publish(2);
    forwarded = next.Lease(readers[1]);
    RL_ASSERT(Forward(next, latest.Lease(readers[0])));
  }
  void thread(unsigned index) {
    if (index == 0) {
      Publish(3);
    } else if (index == 1) {
      next.ReleaseUnused(nullptr);
    } else {
      auto* const buffer = last.LoanAnew(nullptr);
      buffer->ReferTo(*forwarded.get());
      buffer->publication.sequence = forwarded.get()->publication.sequence;
      last.Publish(*buffer);
      forwarded = {};
      LookAtForwarded(last.Lease(readers[1]));
    }
  }
  void after() { LookAtForwarded(last.Lease(readers[1])); }
};

TEST(ForwardingSearch, ChainHoldsTheValueWithoutAGap) { EXPECT_TRUE(Search<ChainSuite>(kIterations, 1)); }

// Both pools are closed while a reader still has what was forwarded: it all goes, once, and not before.
struct ClosingSuite : rl::test_suite<ClosingSuite, 3>, ForwardingRig<Mortal, 2> {
  ClosingSuite() : ForwardingRig(1, 1) {}
  Lease forwarded;

  void before() {
    Publish(7);
    RL_ASSERT(Forward(next, latest.Lease(readers[0])));
    forwarded = next.Lease(readers[1]);
  }
  void thread(unsigned index) {
    if (index == 0) {
      pool.reset();
    } else if (index == 1) {
      pool_of_next.reset();
    } else {
      RL_ASSERT(forwarded.get()->published_value().Get() == 7);
      forwarded = {};
    }
  }
  void after() {
    RL_ASSERT(domain.Reclaim() == 0);
    RL_ASSERT(Mortal::alive() == 0);
  }
};

TEST(ForwardingSearch, ClosedPoolsGoWithTheLastHolderOfWhatWasForwarded) {
  EXPECT_TRUE(Search<ClosingSuite>(kIterations, 1));
}

// A publisher writes into memory of its own again as soon as it gets it back.
struct InPlaceSuite : rl::test_suite<InPlaceSuite, 2>, Rig<SearchedPlain, 1>, ValueOwner<SearchedPlain> {
  InPlaceSuite() : Rig({.buffers = 2, .may_grow = false}) {}
  SearchedPlain values[2];
  bool is_out[2] = {};
  int taken_back = 0;

  void TakeBack(const SearchedPlain& value) noexcept override {
    is_out[&value - values] = false;
    ++taken_back;
  }
  void PublishInPlace(int number) {
    latest.ReleaseUnused(nullptr);
    const int free = is_out[0] ? 1 : 0;
    if (is_out[free]) return;
    values[free].Set(number);
    auto* const buffer = latest.LoanAnew(nullptr);
    RL_ASSERT(buffer != nullptr);
    is_out[free] = true;
    buffer->ReferTo(values[free], {std::shared_ptr<void>(), this});
    latest.Publish(*buffer);
  }
  void thread(unsigned index) {
    if (index == 0) {
      for (int i = 1; i <= 3; ++i) PublishInPlace(i);
      return;
    }
    for (int i = 0; i < 2; ++i) {
      const Lease lease = latest.Lease(readers[0]);
      if (lease.get() == nullptr) continue;
      const int value = lease.get()->published_value().Get();
      RL_ASSERT(value > 0 && lease.get()->published_value().Get() == value);
    }
  }
  void after() {
    pool.reset();
    RL_ASSERT(!is_out[0] && !is_out[1] && taken_back >= 2);
  }
};

TEST(ForwardingSearch, OwnerGetsAValueBackWhenNobodyLooksAtItAnyMore) {
  EXPECT_TRUE(Search<InPlaceSuite>(kIterations, 3));
}

}  // namespace
}  // namespace runnel::test
