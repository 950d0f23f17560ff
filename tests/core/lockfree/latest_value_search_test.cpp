#include "tests/core/lockfree/search.h"
#include "tests/core/lockfree/searched_atomic.h"
// The search must come first: it renames what the standard headers below use.

#include "core/lockfree/latest_value.h"

namespace runnel::test {
namespace {

constexpr unsigned kIterations = 100000;

struct Pair {
  std::uint64_t a;
  std::uint64_t b;
};

// A reader sees both halves of one publication, with its number and timestamp, and never an older one
// than it has seen already. With few cells the writer laps the reader in a short schedule.
template <std::size_t kCells>
struct LatestValueSuite : rl::test_suite<LatestValueSuite<kCells>, 2> {
  LatestValue<Pair, SearchedAtomic, kCells> latest;

  void thread(unsigned index) {
    if (index == 0) {
      for (std::uint64_t i = 1; i <= 4; ++i) {
        latest.Publish({i, 10 * i}, static_cast<std::int64_t>(100 * i), static_cast<std::int64_t>(200 * i), 1000 * i);
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
      RL_ASSERT(publication.timestamp == static_cast<std::int64_t>(100 * pair.a));
      RL_ASSERT(publication.publication_time == static_cast<std::int64_t>(200 * pair.a));
      RL_ASSERT(publication.order == 1000 * pair.a);
      RL_ASSERT(publication.sequence >= last);
      last = publication.sequence;
    }
  }
};

TEST(LatestValueSearch, ReaderSeesWholeValuesInOrder) {
  // With so few cells a reader repeats as long as a writer stands still, so not all schedules end.
  EXPECT_TRUE(SearchAtRandom<LatestValueSuite<1>>(kIterations));
  EXPECT_TRUE(SearchAtRandom<LatestValueSuite<2>>(kIterations));
  EXPECT_TRUE(Search<LatestValueSuite<4>>(kIterations, 3));
}

}  // namespace
}  // namespace runnel::test
