// A robot among nodes of ROS 2: another program, whose types are made by another's compiler.

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <string>

#include <gmock/gmock.h>

#include "tests/integration/program.h"
#include "tests/integration/ros_robot.h"
#include "tests/support/own_network.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/wait_until.h"

namespace runnel::test {
namespace {

using testing::HasSubstr;
using testing::Not;

const std::string kRobot = RosRobot("cyclone");

class AmongRosNodes : public testing::Test {
 protected:
  AmongRosNodes() {
    setenv("ROS_DOMAIN_ID", std::to_string(OwnDomain()).c_str(), 1);
    setenv("XDG_RUNTIME_DIR", folder_.path().c_str(), 1);
    std::ofstream(folder_ / "robot.xml") << kRobot;
  }
  ~AmongRosNodes() override {
    unsetenv("XDG_RUNTIME_DIR");
    unsetenv("ROS_DOMAIN_ID");
  }
  static Program Node(const std::string& what) {
    return Program(std::to_string(OwnDomain()) + " " + what, RUNNEL_ROS_NODE);
  }

  const TemporaryFolder folder_;
};

TEST_F(AmongRosNodes, TheyReadItsScansItsNodeItsTimeAndItsLog) {
  const Program robot("run " + std::string(folder_ / "robot.xml") + " world=" RUNNEL_XML "/worlds/rooms.xml");
  EXPECT_TRUE(Node("scan").WaitFor("scan frame laser ranges 181 from -1.571 step 0.01745 most 4.00"));
  EXPECT_TRUE(Node("clock").WaitFor("clock 1."));
  EXPECT_TRUE(Node("graph").WaitFor("node /robots base readers 2 writers 7"));
  EXPECT_TRUE(Node("log").WaitFor("is in the network"));
}

TEST_F(AmongRosNodes, TheySeeWhereItIsAlsoThoseWhoComeLate) {
  const Program robot("run " + std::string(folder_ / "robot.xml") + " world=" RUNNEL_XML "/worlds/rooms.xml");
  EXPECT_TRUE(Node("tf").WaitFor("transform map to base_link at "));
  EXPECT_TRUE(Node("tf_static").WaitFor("transform map to start at "));
}

TEST_F(AmongRosNodes, ThoseOfHumbleSeeItAsOneOfTheirs) {
  std::string humble = kRobot;
  humble.replace(humble.find("jazzy"), 5, "humble");
  std::ofstream(folder_ / "robot.xml") << humble;
  const Program robot("run " + std::string(folder_ / "robot.xml") + " world=" RUNNEL_XML "/worlds/rooms.xml");
  Program node = Node("graph_of_humble");
  EXPECT_TRUE(node.WaitFor("node /robots base readers 2 writers 7"));
  node.Send(SIGTERM);
  EXPECT_THAT(node.Wait().text, Not(HasSubstr("another participant")));
}

TEST_F(AmongRosNodes, WhoAsksForSomethingElseIsToldOf) {
  const Program robot("run " + std::string(folder_ / "robot.xml") + " world=" RUNNEL_XML "/worlds/rooms.xml");
  const auto wait_until_told = [](const std::string& what) {
    WaitUntil("it says " + what, [&] { return Runnel("log --app robot").text.find(what) != std::string::npos; });
  };
  const Program reliable = Node("reliable_scan");
  wait_until_told("does not fit: the writer sends at best effort, and the reader asks for reliable values");
  const Program latched = Node("latched_tf");
  wait_until_told("does not fit: the writer keeps nothing for who comes late, and the reader asks for it (latched)");
  const Program other = Node("other_scan");
  wait_until_told("rosgraph_msgs::msg::dds_::Clock_");
}

// By either engine, with the policy that keeps them apart.
class StrictReaders : public AmongRosNodes, public testing::WithParamInterface<const char*> {};

TEST_P(StrictReaders, AreToldOfWithWhatTheyAskFor) {
  std::ofstream(folder_ / "robot.xml") << RosRobot(GetParam());
  const Program robot("run " + std::string(folder_ / "robot.xml") + " world=" RUNNEL_XML "/worlds/rooms.xml");
  const std::pair<const char*, const char*> readers[] = {{"deadline_scan", "a deadline"},
                                                         {"liveliness_scan", "a liveliness"},
                                                         {"partition_scan", "the partition 'lab'"},
                                                         {"xcdr2_scan", "XCDR2"}};
  for (const auto& [what, asked] : readers) {
    const Program node = Node(what);
    const std::string told = std::string("the reader asks for what is not offered here: ") + asked;
    WaitUntil("the log says it",
              [&] { return Runnel("log --app robot").text.find("does not fit: " + told) != std::string::npos; });
    EXPECT_THAT(Runnel("network --app robot").text, HasSubstr("NOT MATCHED, " + told));
  }
}

INSTANTIATE_TEST_SUITE_P(Cyclone, StrictReaders, testing::Values("cyclone"));
#if RUNNEL_HAS_FAST
INSTANTIATE_TEST_SUITE_P(Fast, StrictReaders, testing::Values("fast"));
#endif

// As ROS 2 has it, its values are taken all the same.
TEST_F(AmongRosNodes, AnotherMessageOfTheSameNameIsToldOf) {
  const Program robot("run " + std::string(folder_ / "robot.xml") + " world=" RUNNEL_XML "/worlds/rooms.xml");
  const Program node = Node("other_twist");
  const std::string told =
      "is of another version: the writer's message of this name has other fields than the reader's (RIHS01_64c19139, "
      "not RIHS01_9c45bf16)";
  WaitUntil("it is told",
            [&] { return Runnel("log --app robot").text.find("/cmd_vel of somebody " + told) != std::string::npos; });
  WaitUntil("its network says so, too",  // from a moment later on
            [&] { return Runnel("network --app robot").text.find("), " + told) != std::string::npos; });
  WaitUntil("they have come", [] { return Runnel("network --app robot").text.find(", 0 came") == std::string::npos; });
}

TEST_F(AmongRosNodes, ItDrivesAsTheyTellIt) {
  const Program robot("run " + std::string(folder_ / "robot.xml") + " world=" RUNNEL_XML "/worlds/rooms.xml");
  const Program node = Node("twist");
  WaitUntil("the twist has come",
            [] { return Runnel("get /gate/wanted").text.find("{forward: 0.25, turn: -0.5}") != std::string::npos; });
  EXPECT_THAT(Runnel("network --app robot").text, HasSubstr("written by /pilots/joystick (reliable"));
}

}  // namespace
}  // namespace runnel::test
