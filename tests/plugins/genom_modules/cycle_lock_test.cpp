#include "plugins/genom_modules/cycle_lock.h"

#include <mutex>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "core/lockfree/wake_event.h"
#include "plugins/genom_modules/attribute_parameter.h"

namespace runnel::test {
namespace {

using genom_modules::CycleLock;

TEST(CycleLockTest, TheCycleIsWokenByWhoHasKeptItOutAndNotBefore) {
  int wakes = 0;
  CycleLock lock([&] { ++wakes; });
  lock.lock();
  EXPECT_FALSE(lock.try_lock());
  EXPECT_FALSE(lock.try_lock());
  EXPECT_EQ(wakes, 0) << "a cycle that tried again at once would keep the holder from leaving";
  lock.unlock();
  EXPECT_EQ(wakes, 1);
  EXPECT_TRUE(lock.try_lock());
  lock.unlock();
  EXPECT_EQ(wakes, 1) << "nobody was kept out";
}

TEST(CycleLockTest, ACycleThatWaitsToBeWokenAlwaysIs) {
  constexpr int kRounds = 20'000;
  WakeEvent woken;
  CycleLock lock([&] { woken.Notify(); });
  std::atomic<bool> ends{false};
  int guarded = 0;
  int others = 0;
  std::vector<std::jthread> holders;
  for (int i = 0; i < 2; ++i) {
    holders.emplace_back([&] {
      while (!ends) {
        const std::lock_guard guard(lock);
        ++guarded;
        ++others;
      }
    });
  }
  for (int round = 0; round < kRounds;) {
    const std::unique_lock guard(lock, std::try_to_lock);
    if (!guard) {
      woken.Wait();
      continue;
    }
    ++guarded;
    ++round;
  }
  ends = true;
  holders.clear();
  EXPECT_EQ(guarded, kRounds + others);
}

struct Step {
  double x = 0;
  double y = 0;
};
void Describe(TypeBuilder<Step>& type) { type.Name("Step").Field("x", &Step::x).Field("y", &Step::y); }

// Else what is left out would be 0.
TEST(CheckAllAreSaidTest, LooksIntoListsToo) {
  const auto said = [](const std::string& text) -> std::string {
    const auto tokens = TokensOf(text);
    const auto all = genom_modules::CheckAllAreSaid(TypeOf<std::vector<std::vector<Step>>>(), tokens->root());
    return all ? "all" : all.error().message;
  };
  EXPECT_EQ(said("[[{x: 1, y: 2}], [], [{y: 3, x: 4}, {x: 5, y: 6}]]"), "all");
  EXPECT_EQ(said("[[{x: 1, y: 2}], [], [{y: 3, x: 4}, {x: 5}]]"), "'y' is not given");
  EXPECT_EQ(said("[]"), "all");
}

}  // namespace
}  // namespace runnel::test
