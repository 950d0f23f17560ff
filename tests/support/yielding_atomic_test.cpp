#include "tests/support/yielding_atomic.h"

#include <gtest/gtest.h>

namespace runnel::test {
namespace {

constexpr auto kOrder = std::memory_order_seq_cst;

TEST(YieldingAtomicTest, DoesWhatAnAtomicDoes) {
  YieldingAtomic<int> number(1);
  EXPECT_EQ(number.exchange(2, kOrder), 1);
  EXPECT_EQ(number.fetch_add(3, kOrder), 2);
  EXPECT_EQ(number.fetch_sub(1, kOrder), 5);
  int expected = 7;
  EXPECT_FALSE(number.compare_exchange_strong(expected, 8, kOrder, kOrder));
  EXPECT_EQ(expected, 4);
  EXPECT_TRUE(number.compare_exchange_strong(expected, 8, kOrder, kOrder));
  number.store(9, kOrder);
  EXPECT_EQ(number.load(kOrder), 9);
}

TEST(YieldingAtomicTest, SeedDecidesWhereItYields) {
  const auto draw = [](std::uint64_t seed) {
    SeedYields(seed);
    for (int i = 0; i < 10; ++i) MaybeYield();
    return YieldState();
  };
  EXPECT_EQ(draw(5), draw(5));
  EXPECT_NE(draw(5), draw(6));
}

}  // namespace
}  // namespace runnel::test
