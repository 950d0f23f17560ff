#include "plugins/web_server/internal/token_bucket.h"

#include <gtest/gtest.h>

namespace runnel::internal {

namespace {

using namespace std::chrono_literals;

constexpr TokenBucket::SteadyTime kStart{};

TEST(TokenBucket, LetsAsManyMessagesGoOnAsAreAllowedInASecond) {
  TokenBucket bucket(10, kStart);
  for (int i = 0; i < 10; ++i) bucket.Consume(1, kStart);
  EXPECT_EQ(bucket.Wait(), 0ns);
  bucket.Consume(1, kStart);
  EXPECT_NEAR(static_cast<double>(bucket.Wait().count()), 0.1e9, 2);
}

TEST(TokenBucket, GetsBackWhatTimeBrings) {
  TokenBucket bucket(10, kStart);
  for (int i = 0; i < 20; ++i) bucket.Consume(1, kStart);
  bucket.Consume(1, kStart + 1s);
  EXPECT_NEAR(static_cast<double>(bucket.Wait().count()), 0.1e9, 2);
}

TEST(TokenBucket, SavesUpForASecondOnly) {
  TokenBucket bucket(10, kStart);
  for (int i = 0; i < 11; ++i) bucket.Consume(1, kStart + 1h);
  EXPECT_GT(bucket.Wait(), 0ns);
}

TEST(TokenBucket, LongMessagesCostMore) {
  TokenBucket bucket(10, kStart);
  bucket.Consume(10 * TokenBucket::kBytesOfOne, kStart);
  EXPECT_GT(bucket.Wait(), 0ns);
}

TEST(TokenBucket, TellsAFloodFromHaste) {
  TokenBucket bucket(10, kStart);
  for (int i = 0; i < 110; ++i) bucket.Consume(1, kStart);
  EXPECT_FALSE(bucket.IsFlood());
  bucket.Consume(1, kStart);
  EXPECT_TRUE(bucket.IsFlood());
}

}  // namespace

}  // namespace runnel::internal
