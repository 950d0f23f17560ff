// What one application may do in another one, who is heard of two, and networks that lose what is sent.

#include <chrono>
#include <csignal>
#include <thread>

#include <gmock/gmock.h>

#include "tests/integration/other_network.h"
#include "tests/integration/two_robots.h"
#include "tests/support/lossy_cable.h"

namespace runnel::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

using FarApplications = TwoRobots;

// What the planner wants, as others may have it under another name.
std::string Passer(const std::string& network, const std::string& offer) {
  return "  <network " + network + ">\n    " + offer + R"(
  </network>
  <module name="gate" type="motion/command_gate"/>
  <connect from="//planner/planner/twist" to="gate/wanted"/>
)";
}

TEST_F(FarApplications, ParametersAreSetAndModulesSwappedWhereTheFileAllowsIt) {
  const auto robot = Start("two_robots.xml");
  const auto planner = StartWith("two_robots_planner.xml", "commands=\"set swap\"");
  const Program asker("run " + Write("asker", Passer("", "")));
  WaitForText("network --app asker", "member planner");
  WaitForText("network --app asker", "member robot");
  const Ended set = Runnel("set --app asker //planner/planner/cruise_speed 0.123");
  EXPECT_EQ(set.code, kDone) << set.text;
  EXPECT_THAT(Runnel("get --app planner /planner/cruise_speed").text, HasSubstr("0.123"));
  const Ended again = Runnel("set --app asker //planner/planner/cruise_speed 0.124");
  EXPECT_EQ(again.code, kDone) << again.text;
  EXPECT_THAT(Runnel("get --app planner /planner/cruise_speed").text, HasSubstr("0.124"));
  const Ended wrong = Runnel("set --app asker //planner/planner/cruise_speed fast");
  EXPECT_EQ(wrong.code, kBadInput);
  EXPECT_THAT(wrong.text, AllOf(HasSubstr("planner says"), HasSubstr("cruise_speed")));
  const Ended swap = Runnel("swap --app asker //planner/planner planning/bug1");
  EXPECT_EQ(swap.code, kDone) << swap.text;
  EXPECT_THAT(Runnel("ls --app planner /planner").text, HasSubstr("planning/bug1"));
  EXPECT_THAT(Runnel("log --app planner").text,
              AllOf(HasSubstr("//asker has it done: set /planner/planner/cruise_speed 0.124"),
                    Not(HasSubstr("has it done: set /planner/planner/cruise_speed fast"))));
  ASSERT_EQ(Runnel("undo --app planner").code, kDone);
  EXPECT_THAT(Runnel("ls --app planner /planner").text, HasSubstr("planning/bug2"));
  const Ended refused = Runnel("set --app asker //robot/world/goal_x 1");
  EXPECT_EQ(refused.code, kBadInput);
  EXPECT_THAT(refused.text, HasSubstr("<network commands=\"set\">"));
  EXPECT_THAT(Runnel("set --app asker //robt/world/goal_x 1").text, HasSubstr("did you mean '//robot'?"));
}

TEST_F(FarApplications, WhatHasFailedIsNotDoneLaterAndWhatIsAskedAgainIsDoneAgain) {
  const std::string told = Write("told", R"(  <network commands="set" lease="1s"/>
  <module name="drive" type="motion/differential_drive"/>
  <connect from="//nobody/twist" to="drive/twist"/>
)");
  const std::string get = "get --app told /drive/maximum_speed", set = "set --app asker //told/drive/maximum_speed ";
  auto robot = std::make_unique<Program>("run " + told);
  const Program asker("run " + Write("asker", Passer("", "")));
  WaitForText("network --app asker", "member told");
  // Who asks and goes has asked for nothing more: the same words of the next one are a command of their own.
  robot->Send(SIGSTOP);
  {
    Program gives_up(set + "0.31");
    std::this_thread::sleep_for(std::chrono::milliseconds(500));
    gives_up.Send(SIGKILL);
    (void)gives_up.Wait();
  }
  robot->Send(SIGCONT);
  WaitForText("network --app asker", "member told");
  ASSERT_EQ(Runnel("set --app told /drive/maximum_speed 0.4").code, kDone);
  WaitUntil("it is asked", [&] { return Runnel(set + "0.31").code == kDone; });
  EXPECT_THAT(Runnel(get).text, HasSubstr("0.31"));
  robot->Send(SIGSTOP);
  const Ended failed = Runnel(set + "0.27");
  EXPECT_NE(failed.code, kDone) << failed.text;
  robot->Send(SIGKILL);
  (void)robot->Wait();
  robot = std::make_unique<Program>("run " + told);
  // Whoever answers this one has heard what was said before.
  WaitUntil("it is there again", [&] { return Runnel(set + "0.35").code == kDone; });
  EXPECT_THAT(Runnel("log --app told").text, Not(HasSubstr("0.27")));
}

TEST_F(FarApplications, WhatARobotThatStoodStillFindsInItsSocketIsNotDone) {
  const std::string told = Write("told", R"(  <network commands="set"/>
  <module name="drive" type="motion/differential_drive"/>
  <connect from="//nobody/twist" to="drive/twist"/>
)");
  // In a folder of its own, so that whoever looks for the asker does not wait for it.
  const TemporaryFolder own;
  const auto there = [&](const auto& work) {
    setenv("XDG_RUNTIME_DIR", own.path().c_str(), 1);
    auto done = work();
    setenv("XDG_RUNTIME_DIR", folder_.path().c_str(), 1);
    return done;
  };
  const auto robot = there([&] { return std::make_unique<Program>("run " + told); });
  const Program asker("run " + Write("asker", Passer("", "")));
  WaitForText("network --app asker", "member told");
  const std::string set = "set --app asker //told/drive/maximum_speed ";
  ASSERT_EQ(Runnel(set + "0.31").code, kDone);
  robot->Send(SIGSTOP);
  {
    Program gives_up(set + "0.29");
    std::this_thread::sleep_for(std::chrono::milliseconds(500));  // until it has been sent
    gives_up.Send(SIGKILL);
    (void)gives_up.Wait();
  }
  robot->Send(SIGCONT);
  WaitUntil("it is asked", [&] { return Runnel(set + "0.33").code == kDone; });
  const std::string log = there([] { return Runnel("log --app told").text; });
  EXPECT_THAT(log, AllOf(HasSubstr("0.31"), HasSubstr("0.33"), Not(HasSubstr("0.29"))));
}

TEST_F(FarApplications, WhatFilesAllowIsChecked) {
  const auto check = [&](const std::string& network) {
    return Runnel("check " + Write("wrong", Passer(network, ""))).text;
  };
  EXPECT_THAT(check("commands=\"set swop\""),
              AllOf(HasSubstr("cannot be allowed to 'swop'"), HasSubstr("did you mean 'swap'?")));
  EXPECT_THAT(check("lease=\"10ms\""), HasSubstr("from 1 s to 1 h"));
  EXPECT_THAT(check("lease=\"2 s\""), Not(HasSubstr("error:")));
}

TEST_F(FarApplications, WhoHasAShorterLeaseIsGoneSooner) {
  const auto robot = Start("two_robots.xml");
  auto planner = StartWith("two_robots_planner.xml", "lease=\"1 s\"");
  auto passer = std::make_unique<Program>("run " + Write("passer", Passer("lease=\"60s\"", "")));
  WaitForText("network --app robot", "member planner");
  WaitForText("network --app robot", "member passer");
  planner->Send(SIGKILL);
  passer->Send(SIGKILL);
  ASSERT_TRUE(robot->WaitFor("planner has left the network"));
  EXPECT_THAT(Runnel("log --app robot").text, Not(HasSubstr("passer has left the network")));
}

TEST_F(FarApplications, OfTwoMastersTheStrongerIsHeardAndTold) {
  const auto robot = Start("two_robots.xml");
  const auto planner = Start("two_robots_planner.xml");
  const auto offer = [](int strength) {
    return "<offer port=\"gate/allowed\" topic=\"/drive\" strength=\"" + std::to_string(strength) + "\"/>";
  };
  const Program drive("run " + Write("drive", R"(  <network>
    <take topic="/drive" to="gate/wanted" exclusive="true"/>
  </network>
  <module name="gate" type="motion/command_gate"/>
)"));
  const Program weak("run " + Write("weak", Passer("", offer(1))));
  WaitForText("network --app drive", "weak (strength 1) has it");
  WaitForText("log --app drive", "weak (strength 1) has it now");
  auto strong = std::make_unique<Program>("run " + Write("strong", Passer("lease=\"1 s\"", offer(5))));
  WaitForText("network --app drive", "strong (strength 5) has it");
  WaitForText("log --app drive", "strong (strength 5) has it now instead of weak (strength 1)");
  strong->Send(SIGKILL);
  WaitForText("network --app drive", "weak (strength 1) has it");
}

// As over a bad radio.
TEST_F(FarApplications, TheyDriveOverACableThatIsLongAndLosesFrames) {
  if (OwnDomain() != 0) GTEST_SKIP() << "needs the right to make networks";
  const OtherNetwork other;
  const LossyCable cable(other.process(), {.loss = 0.05, .delay = std::chrono::milliseconds(100), .seed = 5});
  if (!cable.is_there()) GTEST_SKIP() << "needs iproute2, and /dev/net/tun";
  const auto robot = StartWith("two_robots.xml", "reach=\"network\"");
  const std::string within = other.within() + RUNNEL_PROGRAM;
  auto planner = StartWith("two_robots_planner.xml", "reach=\"network\"", within);
  WaitUntilItDrives();
  planner.reset();
  ASSERT_TRUE(robot->WaitFor("published {forward: 0, turn: 0} at /robot/gate/input/wanted"));
  planner = StartWith("two_robots_planner.xml", "reach=\"network\"", within);
  ASSERT_TRUE(robot->WaitFor("values come again"));
  WaitUntilItDrives();
}

}  // namespace
}  // namespace runnel::test
