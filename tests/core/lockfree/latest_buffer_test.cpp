#include "core/lockfree/latest_buffer.h"

#include <array>
#include <atomic>

#include <gtest/gtest.h>

#include "core/base/check.h"
#include "tests/support/threads.h"
#include "tests/support/yielding_atomic.h"

namespace runnel {
namespace {

// A loan that must succeed.
template <typename Pool>
auto& Loaned(Pool& pool) {
  auto* const buffer = pool.Loan();
  RUNNEL_CHECK(buffer != nullptr, "the test's pool is too small");
  return *buffer;
}

TEST(LatestBufferTest, HasNothingBeforeTheFirstValueAndAfterClear) {
  auto pool = BufferPool<int>::Make({.buffers = 2}, {});
  LatestBuffer<int> latest;
  EXPECT_EQ(latest.Read(*pool), nullptr);
  latest.Replace(*pool, pool->Share(Loaned(*pool)));
  latest.Clear(*pool);
  EXPECT_EQ(latest.Read(*pool), nullptr);
}

TEST(LatestBufferTest, GivesTheVeryBufferThatWasPublished) {
  auto pool = BufferPool<int>::Make({.buffers = 2}, {});
  LatestBuffer<int> latest;
  auto& written = Loaned(*pool);
  written.value() = 7;
  latest.Replace(*pool, pool->Share(written));
  auto* read = latest.Read(*pool);
  ASSERT_EQ(read, &written);
  read->DropLease();
  latest.Clear(*pool);
}

TEST(LatestBufferTest, SendsTheReplacedBufferHomeUnlessItIsLeased) {
  auto pool = BufferPool<int>::Make({.buffers = 2, .may_grow = false}, {});
  LatestBuffer<int> latest;
  latest.Replace(*pool, pool->Share(Loaned(*pool)));
  auto* lease = latest.Read(*pool);
  ASSERT_NE(lease, nullptr);
  latest.Replace(*pool, pool->Share(Loaned(*pool)));
  EXPECT_EQ(pool->Loan(), nullptr);
  lease->DropLease();
  auto* loan = pool->Loan();
  ASSERT_EQ(loan, lease);
  loan->DropLoan();
  latest.Clear(*pool);
}

// A value of many words that says itself whether it is whole.
struct Wide {
  std::array<std::uint64_t, 32> words{};
};

template <template <typename> class Atomic>
void LeasedValueDoesNotChange(std::uint64_t publications) {
  using Pool = BufferPool<Wide, Atomic>;
  auto pool = Pool::Make({.buffers = 4, .may_grow = true}, {});
  LatestBuffer<Wide, Atomic> latest;
  std::atomic<std::uint64_t> torn{0}, backward{0};
  test::RunTogether(3, [&](unsigned index) {
    if (index == 0) {
      for (std::uint64_t i = 1; i <= publications; ++i) {
        auto& buffer = Loaned(*pool);
        buffer.value().words.fill(i);
        latest.Replace(*pool, pool->Share(buffer));
      }
      return;
    }
    for (std::uint64_t last = 0; last < publications;) {
      auto* buffer = latest.Read(*pool);
      if (buffer == nullptr) continue;
      const std::uint64_t first = buffer->value().words[0];
      if (first < last) ++backward;
      last = first;
      std::this_thread::yield();
      for (const std::uint64_t each : buffer->value().words) {
        if (each != first) ++torn;
      }
      buffer->DropLease();
    }
  });
  EXPECT_EQ(torn, 0u);
  EXPECT_EQ(backward, 0u);
  EXPECT_LE(pool->capacity(),
            8u);  // two readers, a writer and the slot hold at most four and a bit
  latest.Clear(*pool);
}

TEST(LatestBufferStressTest, LeasedValueDoesNotChange) {
  LeasedValueDoesNotChange<std::atomic>(50000);
}
TEST(LatestBufferStressTest, LeasedValueDoesNotChangeAtAnyInterleaving) {
  LeasedValueDoesNotChange<test::YieldingAtomic>(3000);
}

}  // namespace
}  // namespace runnel
