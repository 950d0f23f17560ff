// Searches the schedules and memory orders of each lock-free structure; see searched_atomic.h.

#include "tests/core/lockfree/searched_atomic.h"
// The search must come first: it renames what the standard headers below use.

#include "core/lockfree/bounded_queue.h"
#include "core/lockfree/epoch.h"
#include "core/lockfree/latest_buffer.h"
#include "core/lockfree/latest_value.h"

namespace runnel::test {
namespace {

constexpr unsigned kIterations = 100000;

struct Pair {
  std::uint64_t a;
  std::uint64_t b;
};

// A reader sees both halves of one publication, with its number and stamp, and never an older one
// than it has seen already. With few cells the writer laps the reader in a short schedule.
template <std::size_t kCells>
struct LatestValueSuite : rl::test_suite<LatestValueSuite<kCells>, 2> {
  LatestValue<Pair, SearchedAtomic, kCells> latest;

  void thread(unsigned index) {
    if (index == 0) {
      for (std::uint64_t i = 1; i <= 4; ++i) {
        latest.Publish({i, 10 * i}, static_cast<std::int64_t>(100 * i), 1000 * i);
      }
      return;
    }
    std::uint64_t last = 0;
    for (int i = 0; i < 2; ++i) {
      Pair pair;
      Publication publication;
      if (!latest.Read(pair, publication)) continue;
      RL_ASSERT(pair.b == 10 * pair.a);
      RL_ASSERT(publication.sequence == pair.a);
      RL_ASSERT(publication.stamp == static_cast<std::int64_t>(100 * pair.a));
      RL_ASSERT(publication.order == 1000 * pair.a);
      RL_ASSERT(publication.sequence >= last);
      last = publication.sequence;
    }
  }
};

TEST(LatestValueSearch, ReaderSeesWholeValuesInOrder) {
  EXPECT_TRUE(Search<LatestValueSuite<1>>(kIterations));
  EXPECT_TRUE(Search<LatestValueSuite<2>>(kIterations));
  EXPECT_TRUE(Search<LatestValueSuite<4>>(kIterations));
}

// A publisher publishes and then looks for subscribers; whoever subscribes says so and then reads
// the newest value, as Channel and Input do. Whatever the order, the value does not fall between
// them.
template <typename Latest>
struct SubscribingSuite : rl::test_suite<SubscribingSuite<Latest>, 2> {
  Latest latest;
  SearchedAtomic<int> subscribers{0};
  // Plain, since the search runs its threads in turn within one.
  bool publisher_saw_subscriber = false;
  bool subscriber_saw_value = false;
  int finished = 0;

  void thread(unsigned index) {
    if (index == 0) {
      latest.PublishSomething();
      publisher_saw_subscriber = subscribers.load(std::memory_order_seq_cst) != 0;
    } else {
      subscribers.exchange(1, std::memory_order_seq_cst);
      subscriber_saw_value = latest.HasSomething();
    }
    if (++finished == 2) RL_ASSERT(publisher_saw_subscriber || subscriber_saw_value);
  }
  void after() { latest.CleanUp(); }
};

struct SomeValue : LatestValue<Pair, SearchedAtomic> {
  void PublishSomething() { Publish({1, 10}, 0); }
  bool HasSomething() const {
    Pair pair;
    Publication publication;
    return Read(pair, publication);
  }
  void CleanUp() {}
};
struct SomeBuffer {
  using Pool = BufferPool<SearchedPlain, SearchedAtomic>;
  typename Pool::Owner pool = Pool::Make({.buffers = 1, .may_grow = false}, {});
  LatestBuffer<SearchedPlain, SearchedAtomic> latest;

  void PublishSomething() { latest.Replace(*pool, pool->Share(*pool->Loan())); }
  bool HasSomething() {
    auto* buffer = latest.Read(*pool);
    if (buffer != nullptr) buffer->DropLease();
    return buffer != nullptr;
  }
  void CleanUp() { latest.Clear(*pool); }
};

TEST(SubscribingSearch, NoValueFallsBetweenPublisherAndSubscriber) {
  EXPECT_TRUE(Search<SubscribingSuite<SomeValue>>(kIterations));
  EXPECT_TRUE(Search<SubscribingSuite<SomeBuffer>>(kIterations));
}

// Two writers, two readers: each value is taken once, and what one put in before pushing the other
// may touch after popping. Room for one forces every lap.
struct BoundedQueueSuite : rl::test_suite<BoundedQueueSuite, 4> {
  BoundedQueue<SearchedPlain, SearchedAtomic> queue{2};
  rl::var<int> seen[5];

  void before() {
    for (auto& each : seen) each($) = 0;
  }
  void thread(unsigned index) {
    if (index < 2) {
      for (int i = 1; i <= 2; ++i) {
        (void)queue.TryPush(SearchedPlain(static_cast<int>(2 * index) + i));
      }
      return;
    }
    for (int i = 0; i < 2; ++i) {
      SearchedPlain value;
      if (!queue.TryPop(value)) continue;
      RL_ASSERT(value.Get() >= 1 && value.Get() <= 4);
      auto& count = seen[value.Get()];
      RL_ASSERT(count($) == 0);
      count($) = 1;
    }
  }
};

TEST(BoundedQueueSearch, EachValueIsTakenOnceAndWhole) {
  EXPECT_TRUE(Search<BoundedQueueSuite>(kIterations));
}

// A writer publishes three values from two buffers while two readers lease and look. A buffer that
// is written while leased, or leased while being recycled, is a race on its plain value.
struct BufferSuite : rl::test_suite<BufferSuite, 3> {
  using Pool = BufferPool<SearchedPlain, SearchedAtomic>;
  typename Pool::Owner pool = Pool::Make({.buffers = 2, .may_grow = false}, {});
  LatestBuffer<SearchedPlain, SearchedAtomic> latest;

  void thread(unsigned index) {
    if (index == 0) {
      for (int i = 1; i <= 3; ++i) {
        auto* buffer = pool->Loan();
        if (buffer == nullptr) continue;
        buffer->value().Set(i);
        latest.Replace(*pool, pool->Share(*buffer));
      }
      return;
    }
    int last = 0;
    for (int i = 0; i < 2; ++i) {
      auto* buffer = latest.Read(*pool);
      if (buffer == nullptr) continue;
      const int value = buffer->value().Get();
      RL_ASSERT(value >= last);
      RL_ASSERT(buffer->value().Get() == value);
      last = value;
      buffer->DropLease();
    }
  }
  void after() { latest.Clear(*pool); }
};

TEST(LatestBufferSearch, LeasedValueIsNeitherChangedNorRecycled) {
  EXPECT_TRUE(Search<BufferSuite>(kIterations));
}

// Any number of threads may publish into one slot: whoever replaces a buffer sees its first lease,
// and what its writer did is finished before the buffer is written again.
struct TwoPublishersSuite : rl::test_suite<TwoPublishersSuite, 3> {
  using Pool = BufferPool<SearchedPlain, SearchedAtomic>;
  typename Pool::Owner pool = Pool::Make({.buffers = 2, .may_grow = false}, {});
  LatestBuffer<SearchedPlain, SearchedAtomic> latest;

  void thread(unsigned index) {
    if (index == 2) {
      auto* buffer = latest.Read(*pool);
      if (buffer == nullptr) return;
      const int value = buffer->value().Get();
      RL_ASSERT(value > 0);
      RL_ASSERT(buffer->value().Get() == value);
      buffer->DropLease();
      return;
    }
    for (int i = 1; i <= 2; ++i) {
      auto* buffer = pool->Loan();
      if (buffer == nullptr) continue;
      buffer->value().Set(static_cast<int>(10 * index) + i);
      latest.Replace(*pool, pool->Share(*buffer));
    }
  }
  void after() {
    latest.Clear(*pool);
    // All are at home again: no lease was lost, none counted twice.
    auto* first = pool->Loan();
    auto* second = pool->Loan();
    RL_ASSERT(first != nullptr && second != nullptr && first != second);
    first->DropLoan();
    second->DropLoan();
  }
};

TEST(LatestBufferSearch, TwoPublishersLoseNoLease) {
  EXPECT_TRUE(Search<TwoPublishersSuite>(kIterations));
}

// A pool that grows in two threads at once, while a third reaches buffers of the new chunk.
struct GrowingSuite : rl::test_suite<GrowingSuite, 3> {
  using Pool = BufferPool<SearchedPlain, SearchedAtomic>;
  typename Pool::Owner pool = Pool::Make({.buffers = 1, .may_grow = true}, {});
  LatestBuffer<SearchedPlain, SearchedAtomic> latest;

  void thread(unsigned index) {
    if (index == 2) {
      for (int i = 0; i < 2; ++i) {
        auto* buffer = latest.Read(*pool);
        if (buffer == nullptr) continue;
        RL_ASSERT(buffer->value().Get() > 0);
        buffer->DropLease();
      }
      return;
    }
    auto* kept = pool->Loan();
    kept->value().Set(100);
    auto* buffer = pool->Loan();
    RL_ASSERT(buffer != nullptr && buffer != kept);
    buffer->value().Set(static_cast<int>(index) + 1);
    latest.Replace(*pool, pool->Share(*buffer));
    RL_ASSERT(kept->value().Get() == 100);
    kept->DropLoan();
  }
  void after() { latest.Clear(*pool); }
};

TEST(BufferPoolSearch, NewBuffersAreCompleteForWhoeverReachesThem) {
  EXPECT_TRUE(Search<GrowingSuite>(kIterations));
}

// Any thread may loan from a pool: two that pop and push at once never hold the same buffer.
struct FreeListSuite : rl::test_suite<FreeListSuite, 3> {
  using Pool = BufferPool<SearchedPlain, SearchedAtomic>;
  typename Pool::Owner pool = Pool::Make({.buffers = 2, .may_grow = false}, {});

  void thread(unsigned index) {
    for (int i = 0; i < 3; ++i) {
      auto* buffer = pool->Loan();
      if (buffer == nullptr) continue;
      const int mine = static_cast<int>(10 * index) + i;
      buffer->value().Set(mine);
      RL_ASSERT(buffer->value().Get() == mine);
      buffer->DropLoan();
    }
  }
};

TEST(BufferPoolSearch, NoBufferIsLoanedTwiceAtOnce) {
  EXPECT_TRUE(Search<FreeListSuite>(kIterations));
}

// The owner closes the pool while a lease is out: the buffers go with whoever comes last, once.
struct ClosingSuite : rl::test_suite<ClosingSuite, 2> {
  struct Counted : SearchedPlain {
    Counted() { ++alive(); }
    ~Counted() {
      Set(-1);  // a race if anybody still looks
      --alive();
    }
    static int& alive() {
      static int count = 0;
      return count;
    }
  };
  using Pool = BufferPool<Counted, SearchedAtomic>;
  typename Pool::Owner pool = Pool::Make({.buffers = 2, .may_grow = false}, {});
  typename Pool::Buffer* leased = nullptr;

  void before() {
    leased = pool->Loan();
    leased->value().Set(7);
    (void)pool->Share(*leased);
  }
  void thread(unsigned index) {
    if (index == 0) {
      pool.reset();
    } else {
      RL_ASSERT(leased->value().Get() == 7);
      leased->DropLease();
    }
  }
  void after() { RL_ASSERT(Counted::alive() == 0); }
};

TEST(BufferPoolSearch, ClosedPoolGoesWithItsLastLease) {
  EXPECT_TRUE(Search<ClosingSuite>(kIterations));
}

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
        Part* const part = current.load(std::memory_order_seq_cst);
        RL_ASSERT(part->alive.Get() == 1);
        domain.Leave(participants[index]);
      }
      return;
    }
    for (int i = 1; i <= 2; ++i) {
      Part* const old = current.exchange(&parts[i], std::memory_order_seq_cst);
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
