// What is offered and taken, changed from a terminal while it runs.

#include <gmock/gmock.h>

#include "tests/integration/two_robots.h"

namespace runnel::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

using NetworkChanges = TwoRobots;

const std::string kFollower = R"(  <network>
    <offer ports="gate/*"/>
  </network>
  <module name="gate" type="motion/command_gate"/>
  <connect from="//nobody/twist" to="gate/wanted"/>
)";

const std::string kOther = R"(  <network/>
  <module name="gate" type="motion/command_gate"/>
  <connect from="//nobody/twist" to="gate/wanted"/>
)";

TEST_F(NetworkChanges, OffersComeAndGoAndAreUndoneAndSaved) {
  const std::string file = Write("follower", kFollower);
  const std::string before = Read(file);
  const Program other("run " + Write("other", kOther));
  const Program follower("run " + file);
  WaitForText("network --app other", "written /follower/gate/allowed");
  ASSERT_EQ(Runnel("offer --app follower /gate/allowed --topic /go --qos latched --sending after_cycle").code, kDone);
  WaitForText("network --app other", "written /go");
  ASSERT_EQ(Runnel("offer --app follower /gate/allowed --topic /follower/gate/allowed --remove").code, kDone);
  WaitUntil("it is gone",
            [] { return Runnel("network --app other").text.find("/follower/gate/allowed") == std::string::npos; });
  ASSERT_EQ(Runnel("save --app follower").code, kDone);
  EXPECT_THAT(Read(file),
              AllOf(HasSubstr(R"(<offer ports="gate/* !/gate/allowed"/>)"),
                    HasSubstr(R"(<offer port="gate/allowed" topic="/go" qos="latched" sending="after_cycle"/>)")));
  EXPECT_EQ(Runnel("check " + file).code, kDone);
  ASSERT_EQ(Runnel("undo --app follower").code, kDone);
  ASSERT_EQ(Runnel("undo --app follower").code, kDone);
  WaitForText("network --app other", "written /follower/gate/allowed");
  WaitUntil("the other is gone", [] { return Runnel("network --app other").text.find("/go") == std::string::npos; });
  ASSERT_EQ(Runnel("save --app follower").code, kDone);
  EXPECT_EQ(Read(file), before);
  ASSERT_EQ(Runnel("redo --app follower").code, kDone);
  WaitForText("network --app other", "written /go");
  // It goes with the name of its module.
  ASSERT_EQ(Runnel("rename --app follower /gate door").code, kDone);
  WaitForText("network --app follower", "offers /follower/door/output/allowed as /go");
  ASSERT_EQ(Runnel("save --app follower").code, kDone);
  EXPECT_THAT(Read(file), HasSubstr(R"(<offer port="door/allowed" topic="/go" qos="latched" sending="after_cycle"/>)"));
}

TEST_F(NetworkChanges, MistakesAreToldAndNothingIsChanged) {
  const Program follower("run " + Write("follower", kFollower));
  WaitForText("network --app follower", "offers /follower/gate/output/allowed");
  const auto told = [](const std::string& command) {
    const Ended ended = Runnel(command);
    EXPECT_EQ(ended.code, kBadInput) << command;
    return ended.text;
  };
  EXPECT_THAT(told("offer --app follower /gate/alowed"), HasSubstr("did you mean 'allowed'?"));
  EXPECT_THAT(told("offer --app follower /gate/wanted"), HasSubstr("wanted"));
  EXPECT_THAT(told("offer --app follower //nobody/twist"),
              AllOf(HasSubstr("//nobody/twist"), HasSubstr("comes from the network itself")));
  EXPECT_THAT(told("offer --app follower /gate/allowed --qos quick"), HasSubstr("qos: "));
  EXPECT_THAT(told("offer --app follower /gate/allowed --sending after_cycles"),
              HasSubstr("did you mean 'after_cycle'?"));
  EXPECT_THAT(told("offer --app follower /gate/allowed --sending after_cycle --rate 5"),
              HasSubstr("by the network's thread"));
  EXPECT_THAT(told("offer --app follower /gate/allowed --topic 'go there'"), HasSubstr("topic: "));
  EXPECT_THAT(told("offer --app follower /gate/allowed"), HasSubstr("is offered as /follower/gate/allowed already"));
  EXPECT_THAT(told("offer --app follower /gate/allowed --topic /x --remove"), HasSubstr("is not offered as /x"));
  EXPECT_THAT(told("take --app follower /x /gate/wanted --remove"), HasSubstr("'/x' is not taken"));
  EXPECT_THAT(told("take --app follower /x /gate/wanted --as geometry_msgs/msg/Twst"), HasSubstr("did you mean"));
  const Program lonely("run " + Write("lonely",
                                      "  <module name=\"gate\" type=\"motion/command_gate\"/>\n  <connect "
                                      "from=\"gate/allowed\" to=\"gate/wanted\" late=\"true\"/>\n"));
  WaitForText("ps", "lonely");
  EXPECT_THAT(told("offer --app lonely /gate/allowed"), HasSubstr("<network/>"));
  // It is used until the run ends.
  for (const char* const command : {"delete --app follower /network", "rename --app follower /network other"}) {
    EXPECT_THAT(told(command), HasSubstr("what a tag of the file or a program has made"));
  }
  EXPECT_THAT(Runnel("network --app follower").text, HasSubstr("offers /follower/gate/output/allowed"));
}

TEST_F(NetworkChanges, TakesComeAndGoAndAreUndoneAndSaved) {
  const std::string file = Write("follower", kOther);
  const std::string before = Read(file);
  const auto robot = Start("two_robots.xml");
  const auto planner = Start("two_robots_planner.xml");
  const Program follower("run " + file);
  WaitForText("ps", "follower");
  ASSERT_EQ(Runnel("take --app follower /planner/planner/twist /gate/wanted --qos newest").code, kDone);
  WaitForText("get --app follower /gate/wanted", "forward: 0.");
  ASSERT_EQ(Runnel("save --app follower").code, kDone);
  EXPECT_THAT(Read(file), HasSubstr(R"(<take topic="/planner/planner/twist" to="gate/wanted" qos="newest"/>)"));
  EXPECT_EQ(Runnel("check " + file).code, kDone);
  EXPECT_EQ(Runnel("take --app follower /planner/planner/twist /gate/wanted --qos sensor").code, kBadInput);
  ASSERT_EQ(Runnel("take --app follower /planner/planner/twist /gate/wanted --remove").code, kDone);
  WaitUntil("nobody takes it",
            [] { return Runnel("network --app planner").text.find("read by follower") == std::string::npos; });
  ASSERT_EQ(Runnel("save --app follower").code, kDone);
  EXPECT_THAT(Read(file), Not(HasSubstr("<take")));
  ASSERT_EQ(Runnel("take --app follower /planner/planner/twist /gate/wanted --qos sensor").code, kDone);
  WaitForText("network --app planner", "read by follower (best effort");
  ASSERT_EQ(Runnel("undo --app follower").code, kDone);
  ASSERT_EQ(Runnel("undo --app follower").code, kDone);
  ASSERT_EQ(Runnel("undo --app follower").code, kDone);
}

TEST_F(NetworkChanges, OneFieldOfMessagesIsTakenUndoneAndSaved) {
  const std::string file = Write("follower", kOther);
  const Program source("run " + Write("source", R"(  <network>
    <offer port="gate/allowed" topic="/stamped" as="geometry_msgs/msg/TwistStamped" qos="latched"/>
  </network>
  <module name="gate" type="motion/command_gate"/>
  <connect from="//nobody/twist" to="gate/wanted"/>
)"));
  const Program follower("run " + file);
  WaitForText("ps", "follower");
  const std::string take = "take --app follower /stamped /gate/wanted --as geometry_msgs/msg/TwistStamped --field ";
  const Ended wrong = Runnel(take + "twst");
  EXPECT_EQ(wrong.code, kBadInput);
  EXPECT_THAT(wrong.text, HasSubstr("geometry_msgs/msg/TwistStamped has no field 'twst'; did you mean 'twist'?"));
  EXPECT_THAT(Runnel("take --app follower /stamped /gate/wanted --field twist").text, HasSubstr("say it: as="));
  ASSERT_EQ(Runnel(take + "twist").code, kDone);
  WaitForText("network --app follower", "written by source");
  WaitUntil("values come", [] {
    const std::string told = Runnel("network --app follower").text;
    const std::size_t line = told.find("takes /stamped.twist to ");
    return line != std::string::npos &&
           told.substr(line, told.find('\n', line) - line).find(", 0 came") == std::string::npos;
  });
  EXPECT_THAT(Runnel("network --app follower").text, Not(HasSubstr("could not be read")));
  ASSERT_EQ(Runnel("save --app follower").code, kDone);
  EXPECT_THAT(
      Read(file),
      HasSubstr(R"(<take topic="/stamped" to="gate/wanted" as="geometry_msgs/msg/TwistStamped" field="twist"/>)"));
  EXPECT_EQ(Runnel("check " + file).code, kDone);
  ASSERT_EQ(Runnel("undo --app follower").code, kDone);
  ASSERT_EQ(Runnel("save --app follower").code, kDone);
  EXPECT_THAT(Read(file), Not(HasSubstr("<take")));
  ASSERT_EQ(Runnel("redo --app follower").code, kDone);
  WaitForText("network --app follower", "takes /stamped.twist to ");
}

}  // namespace
}  // namespace runnel::test
