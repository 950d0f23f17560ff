#include "core/base/ordered_mutex.h"

#include <mutex>
#include <thread>

#include <gtest/gtest.h>

#include "core/base/check.h"

namespace runnel {
namespace {

TEST(OrderedMutexTest, MayBeTakenAgainByItsHolder) {
  OrderedMutex mutex(LockLevel::kStructure);
  const std::lock_guard outer(mutex);
  const std::lock_guard inner(mutex);
  EXPECT_TRUE(mutex.HeldByThisThread());
}

TEST(OrderedMutexTest, LaterLevelMayFollowEarlier) {
  OrderedMutex structure(LockLevel::kStructure), leaf(LockLevel::kLeaf);
  const std::lock_guard outer(structure);
  EXPECT_NO_THROW(std::lock_guard{leaf});
}

TEST(OrderedMutexTest, EarlierOrEqualLevelAfterLaterIsRefusedBeforeItLocks) {
  OrderedMutex structure(LockLevel::kStructure), leaf(LockLevel::kLeaf), other(LockLevel::kLeaf);
  const std::lock_guard outer(leaf);
  EXPECT_THROW(structure.lock(), ProgrammingError);
  EXPECT_THROW(other.lock(), ProgrammingError);
  std::thread([&] { EXPECT_NO_THROW(std::lock_guard{structure}); }).join();
}

TEST(OrderedMutexTest, IsForgottenWhenReleased) {
  OrderedMutex structure(LockLevel::kStructure), leaf(LockLevel::kLeaf);
  { const std::lock_guard first(leaf); }
  EXPECT_FALSE(leaf.HeldByThisThread());
  EXPECT_NO_THROW(std::lock_guard{structure});
}

}  // namespace
}  // namespace runnel
