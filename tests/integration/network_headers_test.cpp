// What is on the wire, told by Wireshark's dissector, which knows the protocol (RTPS) from elsewhere.

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "tests/integration/program.h"
#include "tests/integration/ros_robot.h"
#include "tests/support/own_network.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/wait_until.h"

namespace runnel::test {
namespace {

using testing::AllOf;
using testing::AnyOf;
using testing::HasSubstr;
using testing::Not;

/// The name of an engine.
class HeadersByTshark : public testing::TestWithParam<const char*> {
 protected:
  HeadersByTshark() {
    setenv("ROS_DOMAIN_ID", std::to_string(OwnDomain()).c_str(), 1);
    setenv("XDG_RUNTIME_DIR", folder_.path().c_str(), 1);
    std::ofstream(folder_ / "robot.xml") << RosRobot(GetParam());
  }
  ~HeadersByTshark() override {
    unsetenv("XDG_RUNTIME_DIR");
    unsetenv("ROS_DOMAIN_ID");
  }

  /// The first submessage, with its lines, that contains all of the words, once it has been captured.
  std::string Wait(const std::vector<std::string>& words) {
    std::string found;
    WaitUntil(words.back() + " has been captured", [&] {
      if (!(found = Find(words)).empty()) return true;
      text_ = Program("-n -O rtps -r " + capture_ + " 2>&1", "tshark").Wait().text;
      return false;
    });
    return found;
  }

 private:
  [[nodiscard]] std::string Find(const std::vector<std::string>& words) const {
    const std::string begin = "\n    submessageId:";
    for (std::size_t at = text_.find(begin); at != std::string::npos;) {
      const std::size_t next = std::min(text_.find(begin, at + 1), text_.size());
      const std::string one = text_.substr(at, next - at);
      if (std::ranges::all_of(words, [&](const std::string& word) { return one.find(word) != std::string::npos; }))
        return one;
      at = text_.find(begin, next);
    }
    return {};
  }
  std::string text_;

 protected:
  const TemporaryFolder folder_;
  const std::string capture_ = folder_ / "wire.pcapng";
};

TEST_P(HeadersByTshark, AreThoseOfRos) {
  if (OwnDomain() != 0) GTEST_SKIP() << "needs the right to make networks";
  if (std::system("command -v tshark >/dev/null") != 0) GTEST_SKIP() << "needs tshark";
  Program tshark("-n -i lo -w " + capture_, "tshark");
  if (!tshark.WaitFor("Capture started")) GTEST_SKIP() << "needs the right to capture: " << tshark.Wait().text;
  Program robot("run " + std::string(folder_ / "robot.xml") + " world=" RUNNEL_XML "/worlds/rooms.xml");
  const Program twist("0 twist", RUNNEL_ROS_NODE);
  ASSERT_TRUE(robot.WaitFor("somebody is in the network")) << robot.Wait().text;
  ASSERT_TRUE(Program("0 scan", RUNNEL_ROS_NODE).WaitFor("scan frame laser"));
  const std::string vendor = std::string(GetParam()) == "fast" ? "eProsima" : "Cyclone DDS";

  const std::string member = Wait({"ENTITYID_BUILTIN_PARTICIPANT_WRITER", "entityName: base"});
  EXPECT_THAT(member, AllOf(HasSubstr("encapsulation kind: PL_CDR_LE"),
                            HasSubstr("userData: 656e636c6176653d2f3b"),  // enclave=/;
                            HasSubstr(vendor), HasSubstr("lease_duration: 10.0")));
  EXPECT_THAT(
      Wait({"ENTITYID_BUILTIN_PUBLICATIONS_WRITER", vendor, "topic: rt/scan\n"}),
      AllOf(HasSubstr("encapsulation kind: PL_CDR_LE"), HasSubstr("typeName: sensor_msgs::msg::dds_::LaserScan_\n"),
            HasSubstr("Kind: BEST_EFFORT_RELIABILITY_QOS"), Not(HasSubstr("TRANSIENT_LOCAL_DURABILITY_QOS")),
            AnyOf(Not(HasSubstr("PID_HISTORY")), HasSubstr("  Depth: 5\n")),  // Fast DDS tells nobody
            HasSubstr("Application-defined writer (no key)"),
            // typehash=RIHS01_64c19139
            HasSubstr("userData: 74797065686173683d5249485330315f3634633139313339")));
  EXPECT_THAT(
      Wait({"ENTITYID_BUILTIN_PUBLICATIONS_WRITER", vendor, "topic: rt/tf_static\n"}),
      AllOf(HasSubstr("typeName: tf2_msgs::msg::dds_::TFMessage_\n"), HasSubstr("Kind: RELIABLE_RELIABILITY_QOS"),
            HasSubstr("Durability: TRANSIENT_LOCAL_DURABILITY_QOS"), Not(HasSubstr("Depth: 5")),
            // typehash=RIHS01_e369d0f0
            HasSubstr("userData: 74797065686173683d5249485330315f6533363964306630")));
  EXPECT_THAT(
      Wait({"ENTITYID_BUILTIN_SUBSCRIPTIONS_WRITER", vendor, "topic: rt/cmd_vel\n"}),
      AllOf(HasSubstr("typeName: geometry_msgs::msg::dds_::Twist_\n"), HasSubstr("Application-defined reader (no key)"),
            Not(HasSubstr("TRANSIENT_LOCAL_DURABILITY_QOS")), Not(HasSubstr("EXCLUSIVE_OWNERSHIP_QOS"))));
  EXPECT_THAT(
      Wait({"ENTITYID_BUILTIN_PUBLICATIONS_WRITER", vendor, "topic: ros_discovery_info\n"}),
      AllOf(HasSubstr("typeName: rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_\n"),
            HasSubstr("Durability: TRANSIENT_LOCAL_DURABILITY_QOS"), HasSubstr("Kind: RELIABLE_RELIABILITY_QOS")));
  // sec, nanosec, 6 characters "laser", filled up to 4; the smallest angle, - pi / 2.
  EXPECT_THAT(Wait({"submessageId: DATA (0x15)", "[Topic Information (from Discovery)]", "[topic: rt/scan]"}),
              AllOf(HasSubstr("[typeName: sensor_msgs::msg::dds_::LaserScan_]"),
                    HasSubstr("encapsulation kind: CDR_LE (0x0001)"), HasSubstr("encapsulation options: 0x0000"),
                    HasSubstr("060000006c61736572000000db0fc9bf"), Not(HasSubstr("Inline QoS,"))));
}

INSTANTIATE_TEST_SUITE_P(Cyclone, HeadersByTshark, testing::Values("cyclone"));
#if RUNNEL_HAS_FAST
INSTANTIATE_TEST_SUITE_P(Fast, HeadersByTshark, testing::Values("fast"));
#endif

}  // namespace
}  // namespace runnel::test
