#include "plugins/testing/guards.h"

#include <cstdlib>
#include <memory>
#include <mutex>
#include <shared_mutex>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace runnel::test {
namespace {

// Written through, so that the compiler cannot leave an allocation out.
void* volatile kept = nullptr;

TEST(AllocationGuardTest, SeesNewMallocAndTheirEnd) {
  if (!AllocationGuard::works()) GTEST_SKIP() << "a sanitizer has its own malloc";
  const AllocationGuard guard;
  EXPECT_EQ(guard.allocations(), 0u);
  auto* const number = new int(1);
  kept = number;
  EXPECT_EQ(guard.allocations(), 1u);
  delete number;
  EXPECT_EQ(guard.releases(), 1u);
  void* const block = std::malloc(10);
  kept = block;
  EXPECT_EQ(guard.allocations(), 2u);
  std::free(block);
  EXPECT_EQ(guard.releases(), 2u);
}

TEST(AllocationGuardTest, SeesAllocationsOfOtherAlignment) {
  if (!AllocationGuard::works()) GTEST_SKIP() << "a sanitizer has its own malloc";
  struct alignas(128) Wide {
    char bytes[128];
  };
  const AllocationGuard guard;
  auto* const wide = new Wide;
  kept = wide;
  EXPECT_EQ(guard.allocations(), 1u);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(wide) % 128, 0u);
  delete wide;
  EXPECT_EQ(guard.releases(), 1u);
}

TEST(AllocationGuardTest, DoesNotSeeOtherThreads) {
  std::unique_ptr<int> number;
  std::thread other;
  std::mutex start;
  start.lock();
  other = std::thread([&] {
    const std::lock_guard wait(start);
    number = std::make_unique<int>(1);
  });
  const AllocationGuard guard;
  start.unlock();
  other.join();
  EXPECT_EQ(guard.allocations(), 0u);
}

TEST(LockProbeTest, SeesMutexesAndReaderWriterLocks) {
  if (!LockProbe::works()) GTEST_SKIP() << "a sanitizer replaces the locks itself";
  std::mutex mutex;
  std::recursive_mutex recursive;
  std::shared_mutex shared;
  const LockProbe probe;
  EXPECT_EQ(probe.locks(), 0u);
  { const std::lock_guard lock(mutex); }
  EXPECT_EQ(probe.locks(), 1u);
  { const std::lock_guard lock(recursive); }
  EXPECT_EQ(probe.locks(), 2u);
  { const std::shared_lock lock(shared); }
  { const std::unique_lock lock(shared); }
  EXPECT_EQ(probe.locks(), 4u);
}

TEST(SystemCallProbeTest, NamesTheFirstCallAndMakesItNevertheless) {
  if (!SystemCallProbe::works()) GTEST_SKIP() << "this kernel cannot tell";
  SystemCallProbe probe;
  const long parent = syscall(SYS_getppid);
  const long again = syscall(SYS_getpid);
  EXPECT_EQ(probe.Stop(), SYS_getppid);
  EXPECT_EQ(parent, getppid());
  EXPECT_EQ(again, getpid());
}

TEST(SystemCallProbeTest, SeesNothingWhereNothingIs) {
  volatile int sum = 0;
  SystemCallProbe probe;
  for (int i = 0; i < 1000; ++i) sum = sum + i;
  EXPECT_EQ(probe.Stop(), -1);
}

}  // namespace
}  // namespace runnel::test
