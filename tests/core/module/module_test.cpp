#include "core/module/module.h"

#include "core/module/group.h"
#include "plugins/testing/guards.h"
#include "tests/core/module/module_fixture.h"

namespace runnel::test {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::IsEmpty;

class ModuleTest : public testing::Test {
 protected:
  Runtime runtime;
};

TEST_F(ModuleTest, PortsHangInGroupsOfTheirDirection) {
  auto& doubler = runtime.Create<Doubler>(runtime.root(), "doubler");
  EXPECT_EQ(doubler.kind(), ElementKind::kModule);
  EXPECT_EQ(doubler.value.path(), "/doubler/input/value");
  EXPECT_EQ(doubler.doubled.path(), "/doubler/output/doubled");
  EXPECT_EQ(doubler.value.parent()->kind(), ElementKind::kPortGroup);
}

TEST_F(ModuleTest, GroupsThatNoPortAsksForDoNotExist) {
  class Lonely final : public Module {
   public:
    using Module::Module;

   private:
    void Update() override {}
  };
  auto& lonely = runtime.Create<Lonely>(runtime.root(), "lonely");
  EXPECT_THAT(lonely.children(), IsEmpty());
  const auto tasks = TasksOf(lonely);
  ASSERT_EQ(tasks.size(), 1u);
  for (const auto* group : tasks[0].reads) EXPECT_NE(group, nullptr);
  for (const auto* group : tasks[0].writes) EXPECT_NE(group, nullptr);
  EXPECT_THAT(tasks[0].reads, IsEmpty());
  EXPECT_THAT(tasks[0].writes, IsEmpty());
}

TEST_F(ModuleTest, HasOneTaskWithItsGroups) {
  auto& doubler = runtime.Create<Doubler>(runtime.root(), "doubler");
  const auto tasks = TasksOf(doubler);
  ASSERT_EQ(tasks.size(), 1u);
  EXPECT_EQ(tasks[0].element, &doubler);
  EXPECT_EQ(tasks[0].phase, Phase::kUpdate);
  EXPECT_THAT(tasks[0].reads, ElementsAre(doubler.FindChild("input")));
  EXPECT_THAT(tasks[0].writes, ElementsAre(doubler.FindChild("output")));
}

TEST_F(ModuleTest, TaskRunsUpdateWithTheTimeOfTheCycle) {
  auto& source = runtime.Create<Doubler>(runtime.root(), "source");
  auto& sink = runtime.Create<Doubler>(runtime.root(), "sink");
  ASSERT_TRUE(Port::Connect(source.doubled, sink.value));
  source.doubled.Publish(3.0);
  RunOnce(sink, {.now = Time(5s), .period = 20ms});
  EXPECT_EQ(sink.seen_now, Time(5s));
  EXPECT_EQ(sink.seen_period, 20ms);
  EXPECT_EQ(sink.doubled.publications(), 1u);
  RunOnce(sink);
  EXPECT_EQ(sink.doubled.publications(), 1u);  // nothing new had come
}

TEST_F(ModuleTest, OutsideOfACycleTheRuntimesClockIsTheTime) {
  class Asker final : public Module {
   public:
    using Module::Module;
    using Module::now;
    using Module::period;

   private:
    void Update() override {}
  };
  ManualClock clock;
  runtime.set_clock(clock);
  clock.Set(Time(9s));
  auto& asker = runtime.Create<Asker>(runtime.root(), "asker");
  EXPECT_EQ(asker.now(), Time(9s));
  EXPECT_EQ(Asker::period(), Duration::zero());
}

TEST_F(ModuleTest, UpdateNeitherAllocatesNorLocks) {
  auto& source = runtime.Create<Doubler>(runtime.root(), "source");
  auto& sink = runtime.Create<Doubler>(runtime.root(), "sink");
  ASSERT_TRUE(Port::Connect(source.doubled, sink.value));
  const auto tasks = TasksOf(sink);
  const CycleScope scope({.now = Time(1s)});
  tasks[0].run();
  const AllocationGuard allocations;
  const LockProbe locks;
  for (int i = 0; i < 10; ++i) {
    source.doubled.Publish(1.0 * i);
    tasks[0].run();
  }
  EXPECT_EQ(allocations.allocations(), 0u);
  EXPECT_EQ(locks.locks(), 0u);
  EXPECT_EQ(sink.doubled.publications(), 10u);
}

TEST_F(ModuleTest, PortsAreMembersThatCannotBeDeletedAlone) {
  auto& doubler = runtime.Create<Doubler>(runtime.root(), "doubler");
  EXPECT_FALSE(runtime.Delete(doubler.value));
  EXPECT_TRUE(runtime.Delete(doubler));
}

TEST_F(ModuleTest, PortOfTheNameOfAnotherKeepsTheModuleFromBeingMade) {
  class Twice final : public Module {
   public:
    using Module::Module;
    Input<int> first{this, "same"};
    Input<int> second{this, "same"};

   private:
    void Update() override {}
  };
  EXPECT_THROW(runtime.Create<Twice>(runtime.root(), "twice"), ElementError);
  EXPECT_THAT(runtime.root().children(), IsEmpty());
}

TEST_F(ModuleTest, PrepareComesBeforeItIsReady) {
  class Preparing final : public Module {
   public:
    using Module::Module;
    LifeCycle during = LifeCycle::kDeleted;

   private:
    Result<void> Prepare() override {
      during = life_cycle();
      return {};
    }
    void Update() override {}
  };
  auto& module = runtime.Create<Preparing>(runtime.root(), "module");
  ASSERT_TRUE(runtime.MakeReady(module));
  EXPECT_EQ(module.during, LifeCycle::kConstructed);
  EXPECT_EQ(module.life_cycle(), LifeCycle::kReady);
}

}  // namespace
}  // namespace runnel::test
