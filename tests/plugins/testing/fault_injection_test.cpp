#include "plugins/testing/fault_injection.h"

#include <atomic>
#include <cstdint>
#include <new>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <gmock/gmock.h>

namespace runnel::test {
namespace {

using ::testing::ElementsAre;

// Assertions allocate, too.
template <typename Operation>
bool Fails(Operation operation) {
  try {
    operation();
  } catch (const std::bad_alloc&) {
    return true;
  }
  return false;
}

// Called as what it is, since the optimizer may leave out what `new` allocates and nobody sees.
void Allocate() { ::operator delete(::operator new(4)); }

TEST(FaultInjection, TheNthAllocationFailsAndNoOther) {
  FaultInjection injection(InjectedFault::kAllocation, 3);
  const bool first = Fails(Allocate);
  const bool second = Fails(Allocate);
  const bool struck_early = injection.has_struck();
  const bool third = Fails(Allocate);
  const bool fourth = Fails(Allocate);
  injection.End();
  EXPECT_FALSE(first || second || struck_early || fourth);
  EXPECT_TRUE(third);
  EXPECT_TRUE(injection.has_struck());
}

TEST(FaultInjection, AsManyFurtherOnesFailAsWereAskedFor) {
  FaultInjection injection(InjectedFault::kAllocation, 2, 1);
  const bool first = Fails(Allocate);
  const bool second = Fails(Allocate);
  const bool third = Fails(Allocate);
  const bool fourth = Fails(Allocate);
  injection.End();
  EXPECT_FALSE(first || fourth);
  EXPECT_TRUE(second && third);
}

TEST(FaultInjection, AllocationsOfTheStandardLibraryCount) {
  FaultInjection injection(InjectedFault::kAllocation, 1);
  const bool fails = Fails([] { std::string(1000, 'x'); });
  injection.End();
  EXPECT_TRUE(fails);
}

TEST(FaultInjection, TypesOfLargeAlignmentCount) {
  constexpr std::align_val_t kAlignment{64};
  void* const block = ::operator new(10, kAlignment);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(block) % 64, 0u);
  ::operator delete(block, kAlignment);
  FaultInjection injection(InjectedFault::kAllocation, 1);
  const bool fails = Fails([] { ::operator delete(::operator new(10, kAlignment), kAlignment); });
  injection.End();
  EXPECT_TRUE(fails);
}

TEST(FaultInjection, OtherThreadsAllocateAsEver) {
  bool is_made = false;
  std::thread other;
  {
    std::atomic<bool> begins{false};
    other = std::thread([&] {
      while (!begins) std::this_thread::yield();
      Allocate();
      is_made = true;
    });
    const FaultInjection injection(InjectedFault::kAllocation, 1);
    begins = true;
    other.join();
    EXPECT_FALSE(injection.has_struck());
  }
  EXPECT_TRUE(is_made);
}

TEST(FaultInjection, ThePointThrowsWhatWasAskedFor) {
  {
    const FaultInjection injection(InjectedFault::kException, 2);
    InjectionPoint();
    EXPECT_THROW(InjectionPoint(), std::runtime_error);
    InjectionPoint();
  }
  {
    const FaultInjection injection(InjectedFault::kNumber, 1);
    EXPECT_THROW(InjectionPoint(), int);
  }
  InjectionPoint();
}

TEST(FaultInjection, EachPointHasItsTurn) {
  std::vector<int> reached;
  int steps = 0;
  const std::size_t points = AtEachPoint(
      InjectedFault::kNumber,
      [&] {
        steps = 0;
        try {
          for (; steps < 3; ++steps) InjectionPoint();
        } catch (int) {
        }
      },
      [&](bool) { reached.push_back(steps); });
  EXPECT_EQ(points, 3u);
  EXPECT_THAT(reached, ElementsAre(0, 1, 2, 3));
}

}  // namespace
}  // namespace runnel::test
