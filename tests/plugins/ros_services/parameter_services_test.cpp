// Parameters as those of a node of ROS 2, set from elsewhere.
#include "plugins/ros_services/parameter_services.h"

#include <algorithm>
#include <limits>
#include <mutex>

#include <gmock/gmock.h>

#include "core/element/runtime.h"
#include "core/log/logger.h"
#include "core/module/group.h"
#include "core/module/module.h"
#include "plugins/cdr_values/cdr_values.h"
#include "plugins/parameters/parameter.h"
#include "tests/support/fake_wire.h"
#include "tests/support/wait_until.h"

namespace runnel::test {
namespace {

using testing::HasSubstr;

class Planner final : public Module {
 public:
  using Module::Module;
  Parameter<double> speed{this, "speed", {.default_value = 1}};
  Parameter<double> goal{this, "goal", {.default_value = std::numeric_limits<double>::quiet_NaN()}};

 private:
  void Update() override {}
};

struct NobodyHere final : WireDiscovery {
  void OnMember(const WireMember&) override {}
  void OnMemberGone(const WireId&) override {}
  void OnEndpoint(const WireEndpoint&) override {}
  void OnEndpointGone(const WireId&) override {}
};

TEST(ParameterServicesTest, WhatWasSentBeforeAStopIsNotSetAfterIt) {
  Runtime runtime;
  Group& robot = runtime.Create<Group>(runtime.root(), "robot");
  runtime.Create<Planner>(robot, "planner");
  ASSERT_TRUE(runtime.MakeReady(runtime.root()));
  Logger log(robot);
  NobodyHere nobody;
  const auto engine = MakeFakeWire();
  const auto here = std::move(*engine->Join({.name = "here"}, nobody));
  int sets = 0;
  const auto set = [&](const std::vector<ParameterChange>& changes) -> Result<void> {
    sets += static_cast<int>(changes.size());
    return {};
  };
  const auto services = std::move(*ParameterServices::Start(robot, "/base", *here, ServiceDialect::kInFront, set, log));
  RosParameterValue value;
  value.type = RosParameterType::kDouble;
  value.double_value = 2;
  const std::vector<RosParameter> request{{"planner.speed", value}};
  const Time before = SteadyClock().Now();
  EXPECT_TRUE(services->SetAtomically(request, before).successful);
  EXPECT_EQ(sets, 1);
  ASSERT_TRUE(runtime.robot_stop().Press("a person"));
  ASSERT_TRUE(runtime.robot_stop().Release("a person"));
  const RosSetResult late = services->SetAtomically(request, before);
  EXPECT_FALSE(late.successful);
  EXPECT_THAT(late.reason, HasSubstr("STOP was pressed or released after this was asked for"));
  EXPECT_THAT(services->Set(request, before), testing::ElementsAre(testing::Field(&RosSetResult::successful, false)));
  EXPECT_EQ(sets, 1);
  EXPECT_TRUE(services->Set(request, SteadyClock().Now()).front().successful);
  EXPECT_EQ(sets, 2);
}

TEST(ParameterServicesTest, WhatIsNoNumberHasNotChangedBecauseOfThat) {
  Runtime runtime;
  Group& robot = runtime.Create<Group>(runtime.root(), "robot");
  Planner& planner = runtime.Create<Planner>(robot, "planner");
  ASSERT_TRUE(runtime.MakeReady(runtime.root()));
  Logger log(robot);
  NobodyHere nobody;
  const auto engine = MakeFakeWire();
  const auto here = std::move(*engine->Join({.name = "here"}, nobody));
  const auto there = std::move(*engine->Join({.name = "there"}, nobody));
  const auto services = std::move(*ParameterServices::Start(robot, "/base", *here, ServiceDialect::kInFront, {}, log));
  std::mutex mutex;
  std::vector<std::string> changed;
  const auto reader = there->MakeReader(
      {.topic = "rt/parameter_events", .type = "rcl_interfaces::msg::dds_::ParameterEvent_", .qos = {.depth = 1000}},
      [&](const WireSample& sample) {
        RosParameterEvent event;
        EXPECT_TRUE(ReadCdr(TypeOf<RosParameterEvent>(), sample.octets, &event));
        const std::lock_guard lock(mutex);
        for (const RosParameter& each : event.changed_parameters) changed.push_back(each.name);
      },
      {});
  ASSERT_TRUE(planner.speed.Set(2));
  WaitUntil("it is told", [&] {
    const std::lock_guard lock(mutex);
    return std::ranges::find(changed, "planner.speed") != changed.end();
  });
  const std::lock_guard lock(mutex);
  EXPECT_THAT(changed, testing::ElementsAre("planner.speed"));
}

}  // namespace
}  // namespace runnel::test
