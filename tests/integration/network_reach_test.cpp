// Who hears of an application, and of whom it hears: as its file says, and nobody else.

#include <memory>

#include <gmock/gmock.h>

#include "tests/integration/other_network.h"
#include "tests/integration/two_robots.h"
#include "tests/support/sent_packets.h"

namespace runnel::test {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// The name of an engine. Here is a machine with two cables, `left` (10.77.1.1) and `right` (10.77.2.1), to two others.
class NetworkReach : public TwoRobots, public testing::WithParamInterface<const char*> {
 protected:
  void SetUp() override {
    if (OwnDomain() != 0) GTEST_SKIP() << "needs the right to make networks";
    left_ = std::make_unique<OtherNetwork>();
    right_ = std::make_unique<OtherNetwork>();
    if (!Cable("left")) GTEST_SKIP() << "needs iproute2, and networks of pairs";
    ASSERT_TRUE(Cable("right"));
  }
  void TearDown() override { (void)RunsWell("ip link del left; ip link del right"); }
  [[nodiscard]] bool Cable(const std::string& name, bool has_multicast = true) const {
    return name == "left" ? left_->Connect(name, 1, has_multicast) : right_->Connect(name, 2, has_multicast);
  }

  /// An application with this in its <network>; `there`: nullptr if it is here.
  std::unique_ptr<Program> Run(const std::string& name, const std::string& attributes,
                               const OtherNetwork* there = nullptr) {
    const std::string file = Write(name, "<network engine=\"" + std::string(GetParam()) + "\" " + attributes +
                                             R"(><take topic="/nothing" to="gate/wanted"/></network>
  <module name="gate" type="motion/command_gate"/>
)");
    return std::make_unique<Program>("run " + file, (there == nullptr ? "" : there->within()) + RUNNEL_PROGRAM);
  }
  static void WaitUntilEachKnows(const std::string& one, const std::string& other) {
    WaitForText("network --app " + one, "member " + other);
    WaitForText("network --app " + other, "member " + one);
  }
  static void ExpectStrangers(const std::string& one, const std::string& other) {
    EXPECT_THAT(Runnel("network --app " + one).text, Not(HasSubstr("member " + other)));
    EXPECT_THAT(Runnel("network --app " + other).text, Not(HasSubstr("member " + one)));
  }

  std::unique_ptr<OtherNetwork> left_;
  std::unique_ptr<OtherNetwork> right_;
};

TEST_P(NetworkReach, UnlessTheFileSaysMoreNothingLeavesTheMachineAndNobodyOutsideIsHeard) {
  SentPackets sent("left");
  ASSERT_TRUE(sent.is_there());
  const auto quiet = Run("quiet", "");
  const auto still = Run("still", "");
  WaitUntilEachKnows("quiet", "still");
  EXPECT_THAT(sent.Take(), IsEmpty());
  // It asks all to whom multicast gets, and each port of this machine, on which it finds the one that is open.
  const auto open = Run("open", "reach=\"network\"");
  const auto far = Run("far", "reach=\"network\" peers=\"10.77.1.1\"", left_.get());
  WaitUntilEachKnows("open", "far");
  EXPECT_THAT(sent.Take(), Not(IsEmpty()));
  ExpectStrangers("quiet", "far");
  EXPECT_THAT(Runnel("network --app quiet").text, Not(HasSubstr("member open")));
}

TEST_P(NetworkReach, ByAnInterfaceThatIsNamedNobodyOfAnotherIsReached) {
  SentPackets sent("right");
  ASSERT_TRUE(sent.is_there());
  const auto choosy = Run("choosy", "reach=\"network\" interface=\"left\"");
  const auto left = Run("neighbour", "reach=\"network\"", left_.get());
  WaitUntilEachKnows("choosy", "neighbour");
  EXPECT_THAT(sent.Take(), IsEmpty());
  const auto other = Run("other", "reach=\"network\" interface=\"10.77.2.1\"");
  const auto stranger = Run("stranger", "reach=\"network\" peers=\"10.77.2.1\"", right_.get());
  WaitUntilEachKnows("other", "stranger");
  ExpectStrangers("choosy", "stranger");
  ExpectStrangers("other", "neighbour");
}

TEST_P(NetworkReach, OnOneMachineNobodyElseIsAskedOrHeard) {
  SentPackets sent("left");
  ASSERT_TRUE(sent.is_there());
  const auto home = Run("home", "reach=\"machine\"");
  const auto inside = Run("inside", "reach=\"machine\"");
  WaitUntilEachKnows("home", "inside");
  EXPECT_THAT(sent.Take(), IsEmpty());
  const auto open = Run("open", "reach=\"network\"");
  const auto far = Run("far", "reach=\"network\" peers=\"10.77.1.1\"", left_.get());
  WaitUntilEachKnows("open", "far");
  ExpectStrangers("home", "far");
}

TEST_P(NetworkReach, WhereMulticastDoesNotGetThroughPeersAreNamed) {
  ASSERT_TRUE(RunsWell("ip link del left") && Cable("left", false));
  const auto here = Run("here", "reach=\"network\" interface=\"left\" multicast=\"false\" peers=\"10.77.1.2\"");
  const auto there = Run("there", "reach=\"network\" multicast=\"false\"", left_.get());
  WaitUntilEachKnows("here", "there");
}

TEST_P(NetworkReach, AnInterfaceWithoutMulticastHasPeers) {
  ASSERT_TRUE(RunsWell("ip link del left") && Cable("left", false));
  const auto here = Run("here", "reach=\"network\" interface=\"left\" peers=\"10.77.1.2\"");
  const auto there = Run("there", "reach=\"network\"", left_.get());
  WaitUntilEachKnows("here", "there");
}

// A cable is pulled and put back.
TEST_P(NetworkReach, ValuesComeAgainWhenTheNetworkHasBeenDown) {
  const std::string attributes = "reach=\"network\" engine=\"" + std::string(GetParam()) + "\"";
  const auto robot = StartWith("two_robots.xml", attributes);
  const auto planner = StartWith("two_robots_planner.xml", attributes, left_->within() + RUNNEL_PROGRAM);
  WaitUntilItDrives();
  ASSERT_TRUE(RunsWell("ip link set left down"));
  ASSERT_TRUE(robot->WaitFor("published {forward: 0, turn: 0} at /robot/gate/input/wanted"));
  ASSERT_TRUE(RunsWell("ip link set left up"));
  ASSERT_TRUE(robot->WaitFor("values come again"));
}

TEST_F(TwoRobots, ThatThereIsNoNetworkIsTold) {
  if (OwnDomain() != 0) GTEST_SKIP() << "needs the right to make networks";
  const std::string gate =
      "  <module name=\"gate\" type=\"motion/command_gate\"/>\n  <connect from=\"//nobody/twist\" "
      "to=\"gate/wanted\"/>\n";
  const auto log_with = [&](const std::string& name) {
    const Program lonely("run " + Write(name, "  <network reach=\"network\"/>\n" + gate));
    WaitForText("log --app " + name,
                "wanted has never come");  // half a second later, and all that has been said before
    return Runnel("log --app " + name).text;
  };
  const std::string told = "this machine is in no network";
  EXPECT_THAT(log_with("lonely"), HasSubstr(told));
  if (!RunsWell(
          "ip link add cable type veth peer name end && ip addr add 10.77.9.1/24 dev cable && ip link set cable up")) {
    GTEST_SKIP() << "needs iproute2, and networks of pairs";
  }
  EXPECT_THAT(log_with("connected"), Not(HasSubstr(told)));
  ASSERT_TRUE(RunsWell("ip link del cable"));
}

INSTANTIATE_TEST_SUITE_P(Cyclone, NetworkReach, testing::Values("cyclone"));
#if RUNNEL_HAS_FAST
INSTANTIATE_TEST_SUITE_P(Fast, NetworkReach, testing::Values("fast"));
#endif

}  // namespace
}  // namespace runnel::test
