// What nodes of ROS 2 are told of an application.
#include "plugins/ros_services/ros_node.h"

#include <gmock/gmock.h>

#include "core/log/logger.h"
#include "core/module/group.h"
#include "core/types/type_of.h"
#include "plugins/cdr_values/cdr_values.h"
#include "tests/support/fake_wire.h"
#include "tests/support/wait_until.h"

namespace runnel::test {
namespace {

class RosNodeTest : public testing::Test {
 protected:
  std::unique_ptr<WireReader> Hear(const std::string& topic, const std::string& type) {
    return std::move(*there_->MakeReader({.topic = topic, .type = type, .qos = {.is_latched = true}},
                                         [this](const WireSample& sample) { heard_.assign(sample.octets.begin(), sample.octets.end()); }, {}));
  }
  std::unique_ptr<RosNode> Start(const RosOptions& options) {
    return std::move(*RosNode::Start(options, *here_, group_, false, log_, {}, [] {}));
  }

  struct Listener final : WireDiscovery {
    void OnMember(const WireMember&) override {}
    void OnMemberGone(const WireId&) override {}
    void OnEndpoint(const WireEndpoint&) override {}
    void OnEndpointGone(const WireId&) override {}
  };
  Runtime runtime_;
  Group& group_ = runtime_.Create<Group>(runtime_.root(), "robot");
  Group& module_ = runtime_.Create<Group>(group_, "sonar");
  Logger log_{module_};
  Listener listener_;
  Octets heard_;
  const std::shared_ptr<WireEngine> engine_ = MakeFakeWire();
  std::unique_ptr<WireParticipant> here_ = std::move(*engine_->Join({.name = "here"}, listener_));
  std::unique_ptr<WireParticipant> there_ = std::move(*engine_->Join({.name = "there"}, listener_));
};

// 16 octets of the participant's id, 8 more up to Humble, and the count of its nodes.
TEST_F(RosNodeTest, IsToldAsTheOthersDistributionHasIt) {
  for (const std::string& distribution : RosDistributions()) {
    const bool is_old = distribution == "foxy" || distribution == "galactic" || distribution == "humble";
    const auto node = Start({.distribution = distribution, .node = "/base"});
    const auto reader = Hear("ros_discovery_info", "rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_");
    node->Tell({}, {});
    WaitUntilQuiet(*engine_);
    ASSERT_GT(heard_.size(), 32U);
    EXPECT_EQ(heard_[4 + (is_old ? 24 : 16)], std::byte{1}) << distribution;
    EXPECT_EQ(heard_[4 + (is_old ? 16 : 24)] == std::byte{0}, is_old) << distribution;
  }
}

TEST_F(RosNodeTest, SaysWhatModulesSayByNamesWithDots) {
  const auto node = Start({.node = "/base", .sends_log = true});
  const auto reader = Hear("rt/rosout", "rcl_interfaces::msg::dds_::Log_");
  log_.Warn("no echo");
  FlushLog();
  WaitUntilQuiet(*engine_);
  RosLog said;
  ASSERT_TRUE(ReadCdr(TypeOf<RosLog>(), heard_, &said));
  EXPECT_EQ(said.name, "robot.sonar");
  EXPECT_EQ(said.msg, "no echo");
  EXPECT_EQ(said.level, 30);
}

}  // namespace
}  // namespace runnel::test
