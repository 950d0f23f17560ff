// Every operation of the protocol, by clients of every role.

#include "plugins/command_service/request_table.h"
#include "plugins/foxglove/internal/client_message.h"
#include "tests/plugins/foxglove/foxglove_fixture.h"

namespace runnel::test {
namespace {

using namespace runnel::internal;

struct Case {
  const char* message;
  WebRole needed;
};

// One for each alternative of ClientSaid, in their order; one that is missing does not compile.
constexpr std::array kCases{
    Case{R"({"op":"subscribe","subscriptions":[]})", WebRole::kLook},
    Case{R"({"op":"unsubscribe","subscriptionIds":[]})", WebRole::kLook},
    Case{R"({"op":"advertise","channels":[]})", WebRole::kLook},
    Case{R"({"op":"unadvertise","channelIds":[]})", WebRole::kLook},
    Case{R"({"op":"getParameters","parameterNames":[]})", WebRole::kLook},
    Case{R"({"op":"setParameters","parameters":[]})", WebRole::kChange},
    Case{R"({"op":"subscribeParameterUpdates","parameterNames":[]})", WebRole::kLook},
    Case{R"({"op":"subscribeConnectionGraph"})", WebRole::kLook},
};
static_assert(kCases.size() == std::variant_size_v<ClientSaid>);

TEST(OperationsOfFoxglove, TakeTheRoleOfTheTable) {
  EXPECT_EQ(WebRoleName(ParseClientMessage(kCases[5].message)->role), FindRequest("set").value()->role);
}

TEST_F(FoxgloveTest, EveryOperationIsForItsRolesOnly) {
  for (std::size_t i = 0; i < kCases.size(); ++i) {
    const auto parsed = ParseClientMessage(kCases[i].message);
    ASSERT_TRUE(parsed) << kCases[i].message;
    ASSERT_EQ(parsed->said.index(), i) << kCases[i].message;
    EXPECT_EQ(parsed->role, kCases[i].needed);
    for (const WebRole role : {WebRole::kLook, WebRole::kDrive, WebRole::kChange}) {
      client.its_role = role;
      Begin();
      SayRaw(kCases[i].message);
      const std::string complaint = Complaint();
      const bool is_refused = complaint.find("it takes a token for the role") != std::string::npos;
      EXPECT_EQ(is_refused, role < kCases[i].needed)
          << kCases[i].message << " by " << WebRoleName(role) << ": " << complaint;
    }
  }
}

TEST_F(FoxgloveTest, WhoMayOnlyLookPublishesNothingAndSetsNothing) {
  client.its_role = WebRole::kLook;
  Begin();
  Say({{"op", "advertise"}, {"channels", {{{"id", 1}, {"topic", "/robot/goal"}, {"encoding", "json"}}}}});
  Publish(1, R"({"x":1,"y":2})");
  EXPECT_THAT(Complaint(), HasSubstr("publishing: viewers may only look"));
  Say({{"op", "setParameters"}, {"parameters", {{{"name", "/robot/gain"}, {"value", 1}}}}});
  Turn();
  EXPECT_EQ(robot.gain.Get(), 0.5);
  EXPECT_FALSE(robot.goal.Read().has_value());
}

TEST_F(FoxgloveTest, WhoMayDrivePublishesAndSetsNothing) {
  client.its_role = WebRole::kDrive;
  Begin();
  EXPECT_THAT(Take("serverInfo").at(0)["capabilities"], testing::Contains("clientPublish"));
  Say({{"op", "advertise"}, {"channels", {{{"id", 1}, {"topic", "/robot/goal"}, {"encoding", "json"}}}}});
  Publish(1, R"({"x":1,"y":2})");
  EXPECT_TRUE(Wait([&] { return robot.goal.Read().has_value(); }));
  Say({{"op", "setParameters"}, {"parameters", {{{"name", "/robot/gain"}, {"value", 1}}}}});
  EXPECT_THAT(Complaint(), HasSubstr("viewers may only drive"));
  EXPECT_EQ(robot.gain.Get(), 0.5);
}

}  // namespace
}  // namespace runnel::test
