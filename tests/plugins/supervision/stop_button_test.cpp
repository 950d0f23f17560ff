// The STOP of the robot, pressed by values at a port.

#include <limits>

#include <gmock/gmock.h>

#include "core/module/group.h"
#include "core/port/stand_in.h"
#include "plugins/application_tags/run_description.h"
#include "plugins/structure/structure_editor.h"
#include "plugins/structure/value_by_hand.h"
#include "plugins/supervision/supervisor.h"
#include "tests/plugins/application_files/reading/test_application.h"
#include "tests/plugins/supervision/notices.h"
#include "tests/plugins/supervision/stop_button_fixture.h"

namespace runnel::testing {
namespace {

TEST_F(StopButtonTest, TruePressesWhoeverHasTheStructureLock) {
  MustSucceed(supervisor.Add(StopButtonRule{panel.out.path()}));
  const std::lock_guard lock(runtime.structure_mutex());
  Press(1);
  WaitForStop("the button /app/panel/output/out");
  WaitUntil("it is told", [&] { return !test::NoticesOf(supervisor).empty(); });
}

TEST_F(StopButtonTest, FalseDoesNothingUnlessTheFileSaysSo) {
  MustSucceed(supervisor.Add(StopButtonRule{panel.out.path()}));
  Press(0);
  WaitUntilTaken();
  for (int i = 0; i < 3; ++i) Press(0);
  ASSERT_TRUE(runtime.robot_stop().Release("the test"));
  WaitUntilTaken();
  EXPECT_EQ(runtime.robot_stop().state().changes, 3u) << "pressed, released by the test, pressed";
}

TEST_F(StopButtonTest, WhatIsNotMeasuredPresses) {
  MustSucceed(supervisor.Add(StopButtonRule{panel.out.path()}));
  Press(std::numeric_limits<double>::quiet_NaN());
  WaitForStop("the button /app/panel/output/out");
}

TEST_F(StopButtonTest, WhereItReleasesOnlyLettingGoDoes) {
  MustSucceed(supervisor.Add(StopButtonRule{panel.out.path(), true}));
  runtime.robot_stop().Press("a terminal");
  for (int i = 0; i < 3; ++i) Press(0);  // as a button that is up says again and again
  Press(1);
  Press(0);
  WaitUntil("it is released", [&] { return !runtime.robot_stop().in_force(); });
  EXPECT_EQ(runtime.robot_stop().state().changes, 2u) << "by the 0 after the 1, and not by those before";
}

// As one that was held up on its way over a network: others who have pressed since know more.
TEST_F(StopButtonTest, WhatWasLetGoBeforeAnothersPressReleasesNothing) {
  MustSucceed(supervisor.Add(StopButtonRule{panel.out.path(), true}));
  Press(1);
  WaitForStop("the button /app/panel/output/out");
  runtime.robot_stop().Press("a person");
  panel.out.Publish(0, runtime.clock().Now() - 1s);
  std::this_thread::sleep_for(300ms);  // it is not told that it does nothing
  ASSERT_TRUE(runtime.robot_stop().in_force());
  const auto presses = runtime.robot_stop().state().requests;
  Press(1);
  WaitUntil("it is pressed once more", [&] { return runtime.robot_stop().state().requests > presses; });
  Press(0);
  WaitUntil("it is released", [&] { return !runtime.robot_stop().in_force(); });
  EXPECT_EQ(runtime.robot_stop().state().changes, 2u) << "by what was let go last";
}

TEST_F(StopButtonTest, AsLongAsItIsDownNobodyElseReleases) {
  MustSucceed(supervisor.Add(StopButtonRule{panel.out.path()}));
  Press(1);
  WaitForStop("the button /app/panel/output/out");
  ASSERT_TRUE(runtime.robot_stop().Release("the test"));
  WaitUntil("it is pressed again", [&] { return runtime.robot_stop().state().changes >= 3; });
  EXPECT_TRUE(runtime.robot_stop().in_force());
}

// More at once than wait for whoever takes them one by one.
TEST_F(StopButtonTest, IsHeardAfterABurst) {
  MustSucceed(supervisor.Add(StopButtonRule{panel.out.path()}));
  for (int i = 0; i < 500; ++i) panel.out.Publish(0);
  panel.out.Publish(1);
  WaitForStop("the button /app/panel/output/out");
}

// Readers find what is set by hand, so the button itself is not heard.
TEST_F(StopButtonTest, AValueByHandPressesAndDoesNotRelease) {
  MustSucceed(supervisor.Add(StopButtonRule{panel.out.path(), true}));
  Press(1);
  WaitForStop("the button /app/panel/output/out");
  const auto presses = runtime.robot_stop().state().requests;
  const double up = 0;
  MustSucceed(PublishByHand(panel.out, &up));
  WaitUntil("it is pressed once more", [&] { return runtime.robot_stop().state().requests > presses; });
  for (int i = 0; i < 3; ++i) MustSucceed(PublishByHand(panel.out, &up));
  EXPECT_TRUE(runtime.robot_stop().in_force());
}

TEST_F(StopButtonTest, GoesWithItsPortAndPressesWhenThatIsGone) {
  Workshop workshop;
  RobotStop& stop = workshop.runtime.robot_stop();
  workshop.Build("<application name=\"demo\"><module name=\"panel\" type=\"test/source\"/></application>");
  Scheduler idle(workshop.runtime, {.clock = SchedulerOptions::ClockKind::kSimulated});
  StructureEditor changes(workshop.runtime, workshop.plugins.modules(), &idle);
  Supervisor watching(workshop.runtime, idle, [](const ChangeSet&) { return Result<ChangeSet>(ChangeSet()); });
  MustSucceed(watching.Add(StopButtonRule{"/demo/panel/value"}));
  const auto change = [&](const ChangeSet& set) {
    const ChangeOutcome outcome = changes.Apply(set);
    EXPECT_TRUE(outcome) << outcome.diagnostics.ToString();
  };
  change({RenameElement{"/demo/panel", "desk"}});
  WaitUntil("it is known by its new name", [&] {
    workshop.Get<Source>("/demo/desk").value.Publish(1);
    while (!stop.in_force()) std::this_thread::sleep_for(1ms);  // until it is taken: none is left behind
    if (stop.state().by == "the button /demo/desk/output/value") return true;
    (void)stop.Release("the test");
    return false;
  });
  workshop.Get<Source>("/demo/desk").value.Publish(0);  // or it would press again
  ASSERT_TRUE(stop.Release("the test"));
  change({DeleteElement{"/demo/desk"}});
  WaitUntil("it presses", [&] { return stop.in_force(); });
  EXPECT_EQ(stop.state().by, "the button /demo/desk/output/value, which is gone");
  ASSERT_TRUE(stop.Release("the test"));
  change({CreateModule{"/demo/desk", "test/source"}});
  WaitUntil("it is heard again", [&] {
    workshop.Get<Source>("/demo/desk").value.Publish(1);
    return stop.in_force();
  });
}

TEST(OperatorsTag, IsReadAndItsTimeChecked) {
  const auto errors = [](const std::string& words) {
    Workshop workshop;
    return workshop.Errors("<application name=\"demo\">" + words + "</application>");
  };
  EXPECT_THAT(errors("<operators timeout=\"199ms\"/>"), HasSubstr("operators may be silent for 200ms to 10min"));
  EXPECT_THAT(errors("<operators timeout=\"601s\"/>"), HasSubstr("operators may be silent for 200ms to 10min"));
  EXPECT_THAT(errors("<operators/>"), HasSubstr("timeout"));
  EXPECT_THAT(errors("<operators timeout=\"2s\"/><operators timeout=\"3s\"/>"), HasSubstr("said twice"));
  Workshop workshop;
  EXPECT_THAT(workshop.Errors("<application name=\"demo\"><operators timeout=\"2s\"/></application>"), IsEmpty());
  EXPECT_EQ((*workshop.runtime.root().Find("/demo"))->FindAnnotation<RunRules>()->operators_timeout, Duration(2s));
}

TEST(StopButtonTag, IsReadWithItsPortAndRefusesWhatIsNoNumber) {
  Workshop workshop;
  const auto errors = [&](const std::string& words) {
    return workshop.Errors("<application name=\"demo\"><module name=\"a\" type=\"test/source\"/>" + words +
                           "</application>");
  };
  EXPECT_THAT(errors("<stop_button port=\"a/label\"/>"),
              HasSubstr("/demo/a/output/label: cannot be a stop button, as it sends a string"));
  Workshop several;
  EXPECT_THAT(several.Errors("<application name=\"demo\"><module name=\"a\" type=\"test/source\"/><module name=\"b\" "
                             "type=\"test/source\"/>"
                             "<group name=\"g\"><port name=\"p\" type=\"double\" direction=\"input\"/></group>"
                             "<connect from=\"a/value\" to=\"g/p\"/><connect from=\"b/value\" to=\"g/p\"/>"
                             "<stop_button port=\"g/p\" releases=\"true\"/></application>"),
              HasSubstr("/demo/g/p: cannot release the STOP, as several buttons press by it"));
  Workshop other;
  EXPECT_THAT(other.Errors("<application name=\"demo\"><module name=\"a\" type=\"test/source\"/>"
                           "<stop_button port=\"a/value\" releases=\"true\"/></application>"),
              IsEmpty());
  Scheduler scheduler(other.runtime, {.clock = SchedulerOptions::ClockKind::kSimulated});
  Supervisor supervisor(other.runtime, scheduler, [](const ChangeSet&) { return Result<ChangeSet>(ChangeSet()); });
  ASSERT_TRUE(AddRules(**other.runtime.root().Find("/demo"), scheduler, supervisor));
  other.Get<Source>("/demo/a").value.Publish(1);
  WaitUntil("the STOP is in force", [&] { return other.runtime.robot_stop().in_force(); });
  other.Get<Source>("/demo/a").value.Publish(0);
  WaitUntil("it is released", [&] { return !other.runtime.robot_stop().in_force(); });
}

// A value by hand that came and went is not the button that is held.
TEST_F(StopButtonTest, IsNotHeldByAValueByHandThatIsGone) {
  MustSucceed(supervisor.Add(StopButtonRule{panel.out.path()}));
  {
    const std::lock_guard lock(runtime.structure_mutex());
    MustSucceed(panel.out.PublishByHand(internal::FillWith(AnyValue(1.))));
    WaitForStop("the button");
    ASSERT_TRUE(panel.out.Release());
  }
  WaitUntil("the STOP stays released", [&] {
    (void)runtime.robot_stop().Release("a test");
    std::this_thread::sleep_for(std::chrono::milliseconds(150));
    return !runtime.robot_stop().in_force();
  });
}

// Neither by a terminal, nor while somebody changes the application for long: nobody needs to be asked where the button is.
TEST_F(StopButtonTest, IsPressedAsLongAsItIsHeldWhoeverHasTheLock) {
  MustSucceed(supervisor.Add(StopButtonRule{panel.out.path()}));
  Press(1);
  WaitForStop("the button");
  const std::lock_guard lock(runtime.structure_mutex());
  MustSucceed(runtime.robot_stop().Release("a terminal"));
  WaitUntil("it presses again", [&] { return runtime.robot_stop().in_force(); });
}

}  // namespace
}  // namespace runnel::testing
