#include "core/module/sense_control_module.h"

#include <string>

#include "tests/core/module/module_fixture.h"

namespace runnel::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class Base final : public SenseControlModule {
 public:
  using SenseControlModule::SenseControlModule;
  Input<double> raw{sensor_inputs(), "raw"};
  Output<double> distance{sensor_outputs(), "distance"};
  Input<double> wanted{controller_inputs(), "wanted"};
  Output<double> wheels{controller_outputs(), "wheels"};
  std::string calls;

 private:
  void Sense() override { calls += "sense "; }
  void Control() override { calls += "control "; }
};

TEST(SenseControlModuleTest, HasAGroupForEachDirectionOfDataAndEnd) {
  Runtime runtime;
  auto& base = runtime.Create<Base>(runtime.root(), "base");
  EXPECT_EQ(base.raw.path(), "/base/sensor_input/raw");
  EXPECT_EQ(base.distance.path(), "/base/sensor_output/distance");
  EXPECT_EQ(base.wanted.path(), "/base/controller_input/wanted");
  EXPECT_EQ(base.wheels.path(), "/base/controller_output/wheels");
  EXPECT_EQ(base.FindChild("input"), nullptr);
}

TEST(SenseControlModuleTest, HasTwoTasksOfWhichSensingComesFirst) {
  Runtime runtime;
  auto& base = runtime.Create<Base>(runtime.root(), "base");
  const auto tasks = TasksOf(base);
  ASSERT_EQ(tasks.size(), 2u);
  EXPECT_EQ(tasks[0].phase, Phase::kSense);
  EXPECT_THAT(tasks[0].reads, ElementsAre(base.FindChild("sensor_input")));
  EXPECT_THAT(tasks[0].writes, ElementsAre(base.FindChild("sensor_output")));
  EXPECT_EQ(tasks[1].phase, Phase::kControl);
  EXPECT_THAT(tasks[1].reads, ElementsAre(base.FindChild("controller_input")));
  EXPECT_THAT(tasks[1].writes, ElementsAre(base.FindChild("controller_output")));
  RunOnce(base);
  EXPECT_EQ(base.calls, "sense control ");
}

// What it has sensed may stand in a member, which bears no time.
TEST(SenseControlModuleTest, WhatControlPublishesIsAsOldAsWhatSenseHasRead) {
  class Follower final : public SenseControlModule {
   public:
    using SenseControlModule::SenseControlModule;
    Input<double> raw{sensor_inputs(), "raw", {.ageing = Ageing::kTimesOut}};
    Output<double> wheels{controller_outputs(), "wheels"};

   private:
    void Sense() override { distance_ = raw.Get(); }
    void Control() override { wheels.Publish(distance_); }
    double distance_ = 0;
  };
  class Other final : public Module {
   public:
    using Module::Module;
    Output<double> out{this, "out"};
    Input<double> in{this, "in"};

   private:
    void Update() override {}
  };
  Runtime runtime;
  auto& other = runtime.Create<Other>(runtime.root(), "other");
  auto& follower = runtime.Create<Follower>(runtime.root(), "follower");
  ASSERT_TRUE(Port::Connect(other.out, follower.raw));
  ASSERT_TRUE(Port::Connect(follower.wheels, other.in));
  ASSERT_TRUE(runtime.MakeReady(runtime.root()));
  const auto tasks = TasksOf(follower);
  ASSERT_EQ(tasks.size(), 2u);
  const Time measured{std::chrono::seconds(5)};
  const Time now{std::chrono::seconds(20)};
  other.out.Publish(1.5, measured);
  const CycleScope cycle({.now = now});
  tasks[0].run();
  internal::BeginModule();  // others have their turn in between
  tasks[1].run();
  EXPECT_EQ(*other.in.Read(), 1.5);
  EXPECT_EQ(other.in.Read().timestamp(), measured);
}

TEST(SenseControlModuleTest, RefusesPortsThatDoNotSayOnWhichSideTheyAre) {
  class Sideless final : public SenseControlModule {
   public:
    using SenseControlModule::SenseControlModule;
    Input<double> raw{this, "raw"};

   private:
    void Sense() override {}
    void Control() override {}
  };
  Runtime runtime;
  EXPECT_THROW(runtime.Create<Sideless>(runtime.root(), "sideless"), ProgrammingError);
  EXPECT_EQ(runtime.root().FindChild("sideless"), nullptr);
}

TEST(SenseControlModuleTest, TasksNameOnlyGroupsThatExist) {
  class OnlySensing final : public SenseControlModule {
   public:
    using SenseControlModule::SenseControlModule;
    Output<double> distance{sensor_outputs(), "distance"};

   private:
    void Sense() override {}
    void Control() override {}
  };
  Runtime runtime;
  const auto& module = runtime.Create<OnlySensing>(runtime.root(), "module");
  const auto tasks = TasksOf(module);
  ASSERT_EQ(tasks.size(), 2u);
  EXPECT_THAT(tasks[0].reads, IsEmpty());
  EXPECT_THAT(tasks[0].writes, ElementsAre(module.FindChild("sensor_output")));
  EXPECT_THAT(tasks[1].reads, IsEmpty());
  EXPECT_THAT(tasks[1].writes, IsEmpty());
}

}  // namespace
}  // namespace runnel::test
