#include "plugins/real_time_check/real_time_watch.h"

#include <memory>
#include <string>

#include <gmock/gmock.h>

#include "core/element/runtime.h"
#include "core/module/group.h"
#include "core/module/module.h"
#include "core/module/sense_control_module.h"
#include "plugins/scheduling/scheduler.h"

namespace runnel::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using testing::StartsWith;

/// Allocates in its first cycles, and does as it is told in all others.
class Allocator final : public Module {
 public:
  using Module::Module;
  int first_allocations = 0;

 private:
  void Update() override {
    if (first_allocations-- > 0) kept_ = std::make_unique<std::string>(100, 'x');
  }
  std::unique_ptr<std::string> kept_;
};

class ThrowingModule final : public Module {
 public:
  using Module::Module;

 private:
  void Update() override { throw 7; }
};

class OneSided final : public SenseControlModule {
 public:
  using SenseControlModule::SenseControlModule;

 private:
  void Sense() override {}
  void Control() override { kept_ = std::make_unique<int>(1); }
  std::unique_ptr<int> kept_;
};

class RealTimeWatchTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!RunnelRealTimeHooks()->works) GTEST_SKIP() << "a sanitizer has its own malloc";
  }
  void Run(std::uint64_t first_cycles, int cycles) {
    watch_.emplace(*RunnelRealTimeHooks(), first_cycles);
    runtime_.emplace();
    make(*runtime_);
    scheduler_.emplace(*runtime_,
                       SchedulerOptions{.clock = SchedulerOptions::ClockKind::kSimulated, .watch = &*watch_});
    ASSERT_TRUE(runtime_->MakeReady(runtime_->root()));
    for (int i = 0; i < cycles; ++i) ASSERT_TRUE(scheduler_->Step());
  }

  std::function<void(Runtime&)> make;
  std::optional<RealTimeWatch> watch_;
  std::optional<Runtime> runtime_;
  std::optional<Scheduler> scheduler_;
};

TEST_F(RealTimeWatchTest, NamesTheModuleAndHowOftenItDidIt) {
  make = [](Runtime& runtime) {
    runtime.Create<Allocator>(runtime.root(), "good");
    runtime.Create<Allocator>(runtime.root(), "bad").first_allocations = 5;
  };
  Run(2, 10);
  const auto all = watch_->Breaches();
  ASSERT_THAT(all, SizeIs(1));
  EXPECT_EQ(all[0].path, "/bad");
  ASSERT_FALSE(all[0].breaches.empty());
  EXPECT_EQ(all[0].breaches[0].offence, RealTimeOffence::kAllocation);
  EXPECT_EQ(all[0].breaches[0].what, "malloc");
  EXPECT_EQ(all[0].breaches[0].times, 3u) << "the first two cycles are let through";
  const std::string text = all[0].breaches[0].ToString();
  EXPECT_THAT(text, StartsWith("allocates in its cycle (malloc, 3 times):\n    operator new"));
  EXPECT_THAT(text, HasSubstr("Allocator::Update() at "));
  EXPECT_THAT(text, HasSubstr("real_time_watch_test.cpp:"));
  EXPECT_THAT(text, testing::Not(testing::AnyOf(HasSubstr("Cycle"), HasSubstr("BoundCall"))))
      << "the calls end with the module's own";
}

TEST_F(RealTimeWatchTest, FirstCyclesAreLetThrough) {
  make = [](Runtime& runtime) { runtime.Create<Allocator>(runtime.root(), "slow_starter").first_allocations = 5; };
  Run(6, 10);
  EXPECT_THAT(watch_->Breaches(), IsEmpty());
}

TEST_F(RealTimeWatchTest, ModulesThatThrowAreStoppedAsEver) {
  make = [](Runtime& runtime) {
    runtime.Create<ThrowingModule>(runtime.root(), "throwing");
    runtime.Create<Allocator>(runtime.root(), "good");
  };
  Run(0, 3);
  EXPECT_THAT(scheduler_->TakeFaults(), SizeIs(1));
  for (const RealTimeBreaches& each : watch_->Breaches()) EXPECT_EQ(each.path, "/throwing");
}

TEST_F(RealTimeWatchTest, EachTaskOfAModuleIsWatched) {
  make = [](Runtime& runtime) { runtime.Create<OneSided>(runtime.root(), "one_sided"); };
  Run(0, 2);
  ASSERT_THAT(watch_->Breaches(), SizeIs(1));
  EXPECT_THAT(watch_->Breaches()[0].breaches[0].ToString(), HasSubstr("OneSided::Control()"));
}

TEST(CallStackTest, KeepsWhatIsBetweenTwoCalls) {
  CallStack stack = CallStack::Take();
  const std::vector<void*> all(stack.frames().begin(), stack.frames().end());
  ASSERT_GT(all.size(), 5u);
  stack.KeepBetween(nullptr, nullptr);
  EXPECT_THAT(stack.frames(), testing::ElementsAreArray(all)) << "neither is in it";
  stack.KeepBetween(all[1], all[5]);
  EXPECT_THAT(stack.frames(), testing::ElementsAre(all[1], all[2], all[3]));
}

}  // namespace
}  // namespace runnel::test
