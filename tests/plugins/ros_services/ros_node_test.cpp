// What nodes of ROS 2 are told of an application.
#include "plugins/ros_services/ros_node.h"

#include <map>

#include <gmock/gmock.h>

#include "core/log/logger.h"
#include "core/module/group.h"
#include "core/types/type_of.h"
#include "plugins/cdr_values/cdr_values.h"
#include "plugins/ros_services/ros_time.h"
#include "tests/support/fake_wire.h"
#include "tests/support/wait_until.h"

namespace runnel::test {
namespace {

class RosNodeTest : public testing::Test {
 protected:
  std::unique_ptr<WireReader> Hear(const std::string& topic, const std::string& type,
                                   const WireQos& qos = {.is_latched = true}) {
    return std::move(*there_->MakeReader(
        {.topic = topic, .type = type, .qos = qos},
        [this](const WireSample& sample) { heard_.assign(sample.octets.begin(), sample.octets.end()); }, {}));
  }
  std::unique_ptr<RosNode> Start(const RosOptions& options) {
    return RosNode::Start(options, *here_, group_, false, log_,
                          RosHooks{.health = [] { return std::vector<RosDiagnosticStatus>(); }}, [] {});
  }

  struct Listener final : WireDiscovery {
    void OnMember(const WireMember&) override {}
    void OnMemberGone(const WireId&) override {}
    void OnEndpoint(const WireEndpoint& endpoint) override {
      said[endpoint.options.topic] = endpoint.options.user_data;
      qos[endpoint.options.topic] = endpoint.options.qos;
    }
    void OnEndpointGone(const WireId&) override {}
    std::map<std::string, std::string> said;  // by topic, as the next
    std::map<std::string, WireQos> qos;
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

// As ROS_DISTRO may say them.
TEST(RosDistributionsTest, AreAllThatSpeakThisWireByTheirAge) {
  EXPECT_THAT(RosDistributions(),
              testing::ElementsAre("foxy", "galactic", "humble", "iron", "jazzy", "kilted", "rolling"));
}

// 16 octets of the participant's id, 8 more up to Humble, and the count of its nodes.
TEST_F(RosNodeTest, IsToldAsTheOthersDistributionHasIt) {
  for (const std::string distribution : {"foxy", "galactic", "humble", "iron", "jazzy", "kilted", "rolling"}) {
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

// As ROS 2 has it: who comes late is not told what is long over. An engine drops what is older.
TEST_F(RosNodeTest, KeepsWhatModulesHaveSaidForTenSeconds) {
  const auto node = Start({.node = "/base", .sends_log = true, .parameters = RosParameterUse::kRead});
  WaitUntilQuiet(*engine_);
  const WireQos log = listener_.qos["rt/rosout"];
  EXPECT_EQ(log.lifespan, std::chrono::seconds(10));
  EXPECT_TRUE(log.is_latched);
  EXPECT_EQ(log.depth, 1000U);
  EXPECT_EQ(listener_.qos["rt/parameter_events"].lifespan, Duration{});
  EXPECT_EQ(listener_.qos["rq/base/get_parametersRequest"].depth, 1000U);
}

// Stamps of all that it sends count from 1970; so does the time by which others compare them.
TEST_F(RosNodeTest, TheTimeIsThatOfItsStamps) {
  const auto node = Start({.node = "/base", .sends_clock = true});
  const auto reader = Hear("rt/clock", "rosgraph_msgs::msg::dds_::Clock_", {.is_reliable = false});
  WaitUntilQuiet(*engine_);
  (void)node->Work(SteadyClock().Now());
  WaitUntilQuiet(*engine_);
  Time told;
  ASSERT_TRUE(ReadCdr(TypeOf<Time>(), heard_, &told));
  EXPECT_LT(std::chrono::abs(SinceEpoch() - told), std::chrono::hours(1));
}

TEST_F(RosNodeTest, ItsTopicsSayTheHashesOfTheirMessages) {
  const auto node = Start({.node = "/base",
                           .sends_clock = true,
                           .sends_log = true,
                           .sends_diagnostics = true,
                           .parameters = RosParameterUse::kRead});
  WaitUntilQuiet(*engine_);
  EXPECT_THAT(listener_.said["rt/clock"], testing::StartsWith("typehash=RIHS01_692f7a66"));
  for (const char* const topic : {"rt/clock", "rt/rosout", "rt/diagnostics", "rt/parameter_events"}) {
    EXPECT_THAT(listener_.said[topic], testing::MatchesRegex("typehash=RIHS01_[0-9a-f]*;")) << topic;
  }
}

// Those of std_srvs/srv/SetBool as rosidl has made them for Iron and later.
TEST_F(RosNodeTest, ItsServicesSayTheHashesOfTheirMessages) {
  const auto node = Start({.node = "/base", .parameters = RosParameterUse::kRead});
  WaitUntilQuiet(*engine_);
  const auto says = [](const std::string& hash) {
    return testing::MatchesRegex("serviceid=[0-9a-f.]*;typehash=RIHS01_" + hash + ";");
  };
  EXPECT_THAT(listener_.said["rq/base/stopRequest"],
              says("c62fbb99d94e1b25e8ef9e109f9581956bb1b3361a45a4e5810c36a90d29932e"));
  EXPECT_THAT(listener_.said["rr/base/stopReply"],
              says("d0814e7f7b4880ab77e9c57426c7aa1562ab69f11eef8e2e968812f9cbd0b059"));
  for (const char* const name : {"list_parameters", "get_parameters", "get_parameter_types", "describe_parameters",
                                 "set_parameters", "set_parameters_atomically"}) {
    EXPECT_THAT(listener_.said["rq/base/" + std::string(name) + "Request"], says("[0-9a-f]{64}"));
    EXPECT_THAT(listener_.said["rr/base/" + std::string(name) + "Reply"], says("[0-9a-f]{64}"));
  }
}

/// An engine that refuses topics, as one with keys does for want of a permission.
class RefusingParticipant final : public WireParticipant {
 public:
  explicit RefusingParticipant(WireParticipant& inner) : inner_(inner) {}
  [[nodiscard]] const WireId& id() const noexcept override { return inner_.id(); }
  Result<std::unique_ptr<WireWriter>> MakeWriter(const WireEndpointOptions& options, OnMatched on_matched) override {
    if (options.topic != "rt/clock") return WithPermissionHint({.message = "it is not allowed"}, true, options, true);
    return inner_.MakeWriter(options, std::move(on_matched));
  }
  Result<std::unique_ptr<WireReader>> MakeReader(const WireEndpointOptions& options, OnSample, OnMatched) override {
    return WithPermissionHint({.message = "it is not allowed"}, true, options, false);
  }

 private:
  WireParticipant& inner_;
};

TEST_F(RosNodeTest, GoesOnWithoutWhatItsPermissionsRefuse) {
  std::string said;
  const LogSink sink(runtime_, [&](const LogMessage& message) { said += message.text + "\n"; });
  RefusingParticipant refusing(*here_);
  const auto node = RosNode::Start(
      {.distribution = "jazzy", .node = "/base", .sends_clock = true, .parameters = RosParameterUse::kRead}, refusing,
      group_, false, log_, {}, [] {});
  node->Tell({}, {});
  WaitUntilQuiet(*engine_);
  EXPECT_TRUE(listener_.said.contains("rt/clock"));
  FlushLog();
  EXPECT_THAT(said,
              testing::HasSubstr("is to have <publish><topics><topic>ros_discovery_info</topic></topics></publish>"));
  EXPECT_THAT(said, testing::HasSubstr("<topic>rr/base/stopReply</topic>"));
}

}  // namespace
}  // namespace runnel::test
