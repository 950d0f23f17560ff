#include "plugins/parameters/cycle_lock.h"

#include <atomic>
#include <mutex>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "core/lockfree/wake_event.h"

namespace runnel::test {
namespace {

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

}  // namespace
}  // namespace runnel::test
