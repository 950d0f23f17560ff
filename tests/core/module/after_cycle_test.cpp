#include "core/module/after_cycle.h"

#include <deque>
#include <functional>
#include <string>
#include <thread>

#include <gmock/gmock.h>

#include "plugins/testing/guards.h"

namespace runnel {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class Work final : public AfterCycleWork {
 public:
  explicit Work(std::function<void(Work&)> work) : work_(std::move(work)) {}
  void RunAfterCycle() noexcept override { work_(*this); }

 private:
  const std::function<void(Work&)> work_;
};

class AfterCycleTest : public testing::Test {
 protected:
  std::vector<std::string> done_;
  Work first_{[this](Work&) { done_.emplace_back("first"); }};
  Work second_{[this](Work&) { done_.emplace_back("second"); }};
};

TEST_F(AfterCycleTest, WorkIsDoneOnceAtTheEndInItsOrder) {
  {
    const AfterCycleScope scope;
    EXPECT_TRUE(first_.DoAfterCycle());
    EXPECT_TRUE(second_.DoAfterCycle());
    EXPECT_TRUE(first_.DoAfterCycle());
    EXPECT_THAT(done_, IsEmpty());
  }
  EXPECT_THAT(done_, ElementsAre("first", "second"));
  { const AfterCycleScope scope; }
  EXPECT_EQ(done_.size(), 2u);
}

TEST_F(AfterCycleTest, OutsideOfACycleItIsRefused) {
  EXPECT_FALSE(first_.DoAfterCycle());
  {
    const AfterCycleScope scope;
    std::thread([&] { EXPECT_FALSE(first_.DoAfterCycle()); }).join();
  }
  EXPECT_FALSE(first_.DoAfterCycle());
  EXPECT_THAT(done_, IsEmpty());
}

TEST_F(AfterCycleTest, WorkFindsNoCycle) {
  bool is_refused = false;
  Work work([&](Work& self) { is_refused = !self.DoAfterCycle(); });
  {
    const AfterCycleScope scope;
    EXPECT_TRUE(work.DoAfterCycle());
  }
  EXPECT_TRUE(is_refused);
}

TEST_F(AfterCycleTest, WhatIsTooMuchIsRefused) {
  std::deque<Work> many;
  int count = 0;
  for (std::size_t i = 0; i <= AfterCycleScope::kMost; ++i) many.emplace_back([&](Work&) { ++count; });
  {
    const AfterCycleScope scope;
    const test::AllocationGuard guard;
    for (std::size_t i = 0; i < AfterCycleScope::kMost; ++i) EXPECT_TRUE(many[i].DoAfterCycle());
    EXPECT_FALSE(many.back().DoAfterCycle());
    EXPECT_TRUE(many.front().DoAfterCycle());  // is among them
    EXPECT_EQ(guard.allocations(), 0u);
  }
  EXPECT_EQ(count, static_cast<int>(AfterCycleScope::kMost));
}

}  // namespace
}  // namespace runnel
