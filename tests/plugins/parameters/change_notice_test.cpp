#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "core/module/module.h"
#include "core/module/sense_control_module.h"
#include "plugins/parameters/parameter.h"
#include "plugins/testing/matchers.h"
#include "plugins/testing/module_rig.h"

namespace runnel {
namespace {

using ::testing::ElementsAre;

/// Writes down what it is told, and what runs when.
class Listener final : public Module {
 public:
  explicit Listener(const Placement& placement) : Module(placement) { told.reserve(100); }

  Parameter<double> low{this, "low", {.default_value = 1, .bounds = {0, 10}}};
  Parameter<double> high{this, "high", {.default_value = 2, .bounds = {0, 10}}};
  Parameter<std::string> label{this, "label", {.default_value = "none"}};

  std::vector<const char*> told;

 private:
  void OnParametersChanged() override {
    if (low.HasChanged()) told.push_back("low");
    if (high.HasChanged()) told.push_back("high");
    if (label.HasChanged()) told.push_back("label");
    told.push_back("told");
  }
  void Update() override { told.push_back("ran"); }
};

class Indifferent final : public Module {
 public:
  using Module::Module;
  Parameter<double> low{this, "low"};
  bool listens() { return ListensToParameters(); }

 private:
  void Update() override {}
};

class SensingListener final : public SenseControlModule {
 public:
  using SenseControlModule::SenseControlModule;
  Parameter<double> low{this, "low"};
  std::string order;

 private:
  void OnParametersChanged() override { order += "told "; }
  void Sense() override { order += "sense "; }
  void Control() override { order += "control "; }
};

class ChangeNoticeTest : public ::testing::Test {
 protected:
  std::vector<const char*> Cycle() {
    rig_.module.told.clear();
    rig_.RunCycle();
    return rig_.module.told;
  }
  test::ModuleRig<Listener> rig_;
  Listener& module_ = rig_.module;
};

TEST_F(ChangeNoticeTest, ComesBeforeTheFirstCycleWithAllParameters) {
  rig_.Set("low", "3");
  EXPECT_THAT(Cycle(), ElementsAre("low", "high", "label", "told", "ran"));
  EXPECT_THAT(Cycle(), ElementsAre("ran"));
}

TEST_F(ChangeNoticeTest, ComesOnceForAllThatHaveChangedSince) {
  (void)Cycle();
  rig_.Set("low", "3");
  rig_.Set("label", "front");
  rig_.Set("low", "4");
  EXPECT_THAT(Cycle(), ElementsAre("low", "label", "told", "ran"));
  EXPECT_THAT(Cycle(), ElementsAre("ran"));
}

TEST_F(ChangeNoticeTest, WhatIsRefusedOrTheSameIsNoChange) {
  (void)Cycle();
  EXPECT_FALSE(module_.low.Set(11));
  ASSERT_TRUE(module_.low.Set(1));
  ASSERT_TRUE(module_.label.Set("none"));
  EXPECT_THAT(Cycle(), ElementsAre("ran"));
}

TEST_F(ChangeNoticeTest, HasChangedCanBeAskedWithoutIt) {
  EXPECT_TRUE(module_.low.HasChanged());
  EXPECT_FALSE(module_.low.HasChanged());
  ASSERT_TRUE(module_.low.Set(5));
  EXPECT_FALSE(module_.high.HasChanged() && module_.high.HasChanged());
  EXPECT_TRUE(module_.low.HasChanged());
  EXPECT_EQ(module_.low.Get(), 5);
}

TEST_F(ChangeNoticeTest, NeitherAllocatesNorLocks) {
  (void)Cycle();
  ASSERT_TRUE(module_.low.Set(5));
  ASSERT_TRUE(module_.label.Set("a text that is too long to lie in the string itself"));
  module_.told.clear();
  EXPECT_THAT(rig_, test::KeepsRealTime(1));
  EXPECT_EQ(*module_.label.Get(), "a text that is too long to lie in the string itself");
  EXPECT_THAT(module_.told, ElementsAre("low", "label", "told", "ran"));
}

TEST(SenseControlNoticeTest, ComesBeforeSensing) {
  test::ModuleRig<SensingListener> rig;
  rig.RunCycles(2);
  rig.Set("low", "3");
  rig.RunCycle();
  EXPECT_EQ(rig.module.order, "told sense control sense control told sense control ");
}

#if defined(__GNUC__) && !defined(__clang__)
TEST(IndifferentModuleTest, PaysNothing) {
  test::ModuleRig<Indifferent> rig;
  EXPECT_FALSE(rig.module.listens());
}
#endif

}  // namespace
}  // namespace runnel
