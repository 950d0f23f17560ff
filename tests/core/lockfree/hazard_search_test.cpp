#include "tests/core/lockfree/search.h"
#include "tests/core/lockfree/searched_atomic.h"
// The search must come first: it renames what the standard headers below use.

#include <array>
#include <new>

#include "core/lockfree/hazard.h"

namespace runnel::test {
namespace {

constexpr unsigned kIterations = 20000;

// Two threads that are added at once when all bits of their own are gone: each is looked at, once,
// by whoever comes later, and by itself from the start.
struct SharedBitSuite : rl::test_suite<SharedBitSuite, 2> {
  using Domain = HazardDomain<SearchedAtomic, 1>;
  using Record = Domain::Record;
  static constexpr int kOwnBits = 9;

  SharedBitSuite() {
    for (Record& record : with_own_bits) domain.Add(record);
  }
  void thread(unsigned index) {
    domain.Add(added[index]);
    RL_ASSERT(TimesSeen(&added[index]) == 1);
  }
  void after() {
    for (const Record& record : with_own_bits) RL_ASSERT(TimesSeen(&record) == 1);
    for (const Record& record : added) RL_ASSERT(TimesSeen(&record) == 1);
  }
  [[nodiscard]] int TimesSeen(const Record* wanted) const {
    int times = 0;
    domain.ForEach(Domain::kAll, [&](const Record& record) { times += &record == wanted; });
    return times;
  }

  Domain domain;
  std::array<Record, kOwnBits> with_own_bits;
  std::array<Record, 2> added;
};

TEST(HazardSearch, RecordsThatAreAddedAtOnceAreAllLookedAt) { EXPECT_TRUE(Search<SharedBitSuite>(kIterations, 4)); }

// Two threads retire a part each, and look at what waits. Each part is held when it is first looked at:
// one thread at a time looks at it, and it is deleted once.
struct ReclaimingSuite : rl::test_suite<ReclaimingSuite, 2> {
  using Domain = HazardDomain<SearchedAtomic, 1>;
  class Part final : public Retirable<SearchedAtomic> {
   public:
    // It stays where it is.
    static void operator delete(Part* part, std::destroying_delete_t) noexcept { part->Look(); }
    [[nodiscard]] bool is_deleted() const { return looks_.Get() == 3; }

   private:
    bool IsHeld() noexcept override { return Look() < 2; }
    // How often somebody has been here, this time included.
    int Look() noexcept {
      RL_ASSERT(!is_deleted());
      looks_.Set(looks_.Get() + 1);
      return looks_.Get();
    }
    SearchedPlain looks_;
  };

  void thread(unsigned index) {
    domain.Retire(parts[index]);
    (void)domain.Reclaim();
  }
  void after() {
    while (domain.Reclaim() > 0) {
    }
    for (const Part& part : parts) RL_ASSERT(part.is_deleted());
  }

  std::array<Part, 2> parts;
  Domain domain;
};

TEST(HazardSearch, PartThatIsRetiredIsLookedAtByOneThreadAtATime) {
  EXPECT_TRUE(Search<ReclaimingSuite>(kIterations, 3));
}

}  // namespace
}  // namespace runnel::test
