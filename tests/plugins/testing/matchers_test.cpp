#include "plugins/testing/matchers.h"

#include <gmock/gmock.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "plugins/real_time_check/system_call_trap.h"
#include "tests/plugins/testing/adding_module.h"

namespace runnel::test {

void HastyModule::Update() {
  if (allocates) kept_ = std::make_unique<std::string>(100, 'x');
  if (locks) const std::lock_guard lock(mutex_);
  if (calls) syscall(SYS_getppid);
}

namespace {

using testing::DoubleEq;
using testing::Gt;
using testing::HasSubstr;
using testing::Not;
using testing::Optional;

// What a failing EXPECT_THAT would print; "" if it matches.
template <typename Value, typename Matcher>
std::string Complaint(Value& value, const Matcher& matcher) {
  const testing::Matcher<Value&> asked(matcher);
  if (asked.Matches(value)) return "";
  testing::StringMatchResultListener listener;
  EXPECT_FALSE(asked.MatchAndExplain(value, &listener));
  return listener.str();
}

TEST(MatchersTest, OutputsHavePublishedValues) {
  ModuleRig<AddingModule> rig;
  EXPECT_EQ(Complaint(rig.module.sum, HasPublished(3.0)), "that has published nothing");
  rig.Feed("values", 3.0);
  rig.RunCycles(2);
  EXPECT_THAT(rig.module.sum, HasPublished(3.0));
  EXPECT_THAT(rig.output<double>("sum"), HasPublished(Gt(2)));
  EXPECT_THAT(rig.module.sum, Not(HasPublished(DoubleEq(4))));
  EXPECT_EQ(Complaint(rig.module.sum, HasPublished(4.0)), "whose last is 3");
}

TEST(MatchersTest, WithinSoManyCyclesSomethingIsPublished) {
  ModuleRig<AddingModule> rig;
  rig.Feed("values", 3.0);
  EXPECT_EQ(Complaint(rig, PublishesWithin(1, rig.module.sum, Gt(2))), "with an output that has published nothing");
  EXPECT_THAT(rig, PublishesWithin(1, rig.module.sum, Gt(2)));
  EXPECT_EQ(Complaint(rig, PublishesWithin(4, rig.module.sum, Gt(5))), "with an output whose last is 3");
  EXPECT_EQ(rig.now(), Time(6 * std::chrono::milliseconds(50)))
      << "cycles are run once, although GoogleTest asks twice";
}

TEST(MatchersTest, WhatWasPublishedBeforeDoesNotCount) {
  ModuleRig<AddingModule> rig;
  rig.Feed("values", 3.0);
  rig.RunCycles(2);
  EXPECT_THAT(rig, Not(PublishesWithin(1, rig.module.sum, 3.0)));
}

TEST(MatchersTest, FaultsSayWhatWentWrong) {
  ModuleRig<AddingModule> rig;
  rig.Feed("values", 1e6);
  EXPECT_THAT(rig.RunUntilFault(2), Optional(FaultSays(HasSubstr("too large"))));
}

TEST(MatchersTest, CyclesKeepRealTime) {
  ModuleRig<HastyModule> rig;
  rig.RunCycle();
  EXPECT_THAT(rig, KeepsRealTime(10));
}

TEST(MatchersTest, WhoeverAllocatesLocksOrCallsTheSystemIsNamedWithTheCallsThatLedThere) {
  if (!RunnelRealTimeHooks()->works) GTEST_SKIP() << "a sanitizer has its own malloc";
  ModuleRig<HastyModule> rig;
  rig.module.allocates = true;
  const std::string allocating = Complaint(rig, KeepsRealTime(10));
  EXPECT_THAT(allocating, HasSubstr("allocates in its cycle (malloc, 10 times):\n"));
  EXPECT_THAT(allocating, HasSubstr("HastyModule::Update()"));
  EXPECT_THAT(allocating, HasSubstr("gives memory back in its cycle (free, "));
  EXPECT_THAT(allocating, Not(HasSubstr("TestBody")));
  rig.module.allocates = false;
  rig.RunCycle();
  rig.module.locks = true;
  EXPECT_THAT(Complaint(rig, KeepsRealTime(1)), HasSubstr("locks in its cycle (pthread_mutex_lock, once):\n"));
}

TEST(MatchersTest, SystemCallsAreNamedWhereTheKernelTells) {
  if (!SystemCallTrap::works()) GTEST_SKIP() << "this kernel cannot tell";
  ModuleRig<HastyModule> rig;
  rig.module.calls = true;
  const std::string text = Complaint(rig, KeepsRealTime(2));
  EXPECT_THAT(text,
              HasSubstr("calls the system in its cycle (system call " + std::to_string(SYS_getppid) + ", 2 times):\n"));
  EXPECT_THAT(text, HasSubstr("HastyModule::Update()"));
}

}  // namespace
}  // namespace runnel::test
