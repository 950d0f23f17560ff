#include "plugins/web_server/internal/message_budget.h"

#include <gtest/gtest.h>

namespace runnel::internal {

namespace {

using namespace std::chrono_literals;

constexpr MessageBudget::MachineTime kStart{};

TEST(MessageBudget, LetsAsManyMessagesGoOnAsAreAllowedInASecond) {
  MessageBudget budget(10, kStart);
  for (int i = 0; i < 10; ++i) budget.Pay(1, kStart);
  EXPECT_EQ(budget.Wait(), 0ns);
  budget.Pay(1, kStart);
  EXPECT_NEAR(static_cast<double>(budget.Wait().count()), 0.1e9, 2);
}

TEST(MessageBudget, GetsBackWhatTimeBrings) {
  MessageBudget budget(10, kStart);
  for (int i = 0; i < 20; ++i) budget.Pay(1, kStart);
  budget.Pay(1, kStart + 1s);
  EXPECT_NEAR(static_cast<double>(budget.Wait().count()), 0.1e9, 2);
}

TEST(MessageBudget, SavesUpForASecondOnly) {
  MessageBudget budget(10, kStart);
  for (int i = 0; i < 11; ++i) budget.Pay(1, kStart + 1h);
  EXPECT_GT(budget.Wait(), 0ns);
}

TEST(MessageBudget, LongMessagesCostMore) {
  MessageBudget budget(10, kStart);
  budget.Pay(10 * MessageBudget::kBytesOfOne, kStart);
  EXPECT_GT(budget.Wait(), 0ns);
}

TEST(MessageBudget, TellsAFloodFromHaste) {
  MessageBudget budget(10, kStart);
  for (int i = 0; i < 110; ++i) budget.Pay(1, kStart);
  EXPECT_FALSE(budget.IsFlood());
  budget.Pay(1, kStart);
  EXPECT_TRUE(budget.IsFlood());
}

}  // namespace

}  // namespace runnel::internal
