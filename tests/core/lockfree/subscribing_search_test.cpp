#include "tests/core/lockfree/search.h"
#include "tests/core/lockfree/searched_atomic.h"
// The search must come first: it renames what the standard headers below use.

#include "core/lockfree/latest_buffer.h"
#include "core/lockfree/latest_value.h"

namespace runnel::test {
namespace {

constexpr unsigned kIterations = 100000;

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
      Fences<SearchedAtomic>::Light();
      publisher_saw_subscriber = subscribers.load(std::memory_order_acquire) != 0;
    } else {
      subscribers.exchange(1, std::memory_order_acq_rel);
      Fences<SearchedAtomic>::Heavy();
      subscriber_saw_value = latest.HasSomething();
    }
    if (++finished == 2) RL_ASSERT(publisher_saw_subscriber || subscriber_saw_value);
  }
};

struct SomeValue : LatestValue<int, SearchedAtomic> {
  void PublishSomething() { Publish(1, 0); }
  bool HasSomething() const {
    int value = 0;
    return Read(value);
  }
};
struct SomeBuffer {
  using Pool = BufferPool<SearchedPlain, SearchedAtomic, 1>;
  HazardDomain<SearchedAtomic, 1> domain;
  HazardRecord<SearchedAtomic, 1> reader;
  typename Pool::Owner pool = Pool::Make(domain, {.buffers = 1, .may_grow = false}, {});
  LatestBuffer<SearchedPlain, SearchedAtomic, 1> latest{*pool};

  void PublishSomething() { latest.Publish(*latest.Loan()); }
  bool HasSomething() { return latest.Lease(reader).get() != nullptr; }
};

TEST(SubscribingSearch, NoValueFallsBetweenPublisherAndSubscriber) {
  EXPECT_TRUE(Search<SubscribingSuite<SomeValue>>(kIterations, 4));
  EXPECT_TRUE(Search<SubscribingSuite<SomeBuffer>>(kIterations, 4));
}

}  // namespace
}  // namespace runnel::test
