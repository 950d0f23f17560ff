// Every operation of the protocol, by viewers of every role.

#include <set>

#include "plugins/command_service/request_table.h"
#include "plugins/inspector/internal/requests.h"
#include "tests/plugins/inspector/inspector_fixture.h"

namespace runnel::test {

namespace {

using internal::AllOperations;
using internal::Operation;

constexpr std::array kRoles{WebRole::kLook, WebRole::kDrive, WebRole::kChange};

WebServerOptions Tokens() {
  WebServerOptions options;
  for (const WebRole role : kRoles) {
    options.tokens.push_back({role, "secret-of-" + std::string(WebRoleName(role))});
  }
  options.limits.messages_per_second = 100'000;
  return options;
}

class Roles : public SimulatedInspectorTest {
 protected:
  [[nodiscard]] Viewer ViewAs(WebRole role) const {
    return Viewer(server->port(), "runnel.token.secret-of-" + std::string(WebRoleName(role)));
  }
  /// Whether it is refused for want of a role.
  static bool IsRefused(Viewer& viewer, const std::string& op, const std::string& path) {
    Json message{{"op", op}, {"request", 1}};
    if (!path.empty()) message["path"] = path;
    viewer.Send(message);
    // Not everything is answered; what follows it is.
    viewer.Send({{"op", "nothing"}, {"request", 2}});
    bool is_refused = false;
    for (;;) {
      const Json reply = viewer.Next("reply");
      if (!reply.contains("errors")) {
        if (!reply.contains("ok")) return is_refused;
        continue;
      }
      const std::string error = reply["errors"][0]["message"];
      if (error.find("is not allowed to who may only") != std::string::npos) is_refused = true;
      if (error.find("there is no operation 'nothing'") != std::string::npos) return is_refused;
    }
  }
};

// What each operation takes, said a second time: an operation that is new, or has got another role, fails here.
const std::map<std::string, std::pair<WebRole, WebRole>, std::less<>> kNeeded{
    {"watch", {WebRole::kLook, WebRole::kLook}},       {"unwatch", {WebRole::kLook, WebRole::kLook}},
    {"watch_rates", {WebRole::kLook, WebRole::kLook}}, {"alive", {WebRole::kLook, WebRole::kLook}},
    {"compatible", {WebRole::kLook, WebRole::kLook}},  {"conversions", {WebRole::kLook, WebRole::kLook}},
    {"panel", {WebRole::kLook, WebRole::kLook}},       {"save_panel", {WebRole::kChange, WebRole::kChange}},
    {"arrange", {WebRole::kChange, WebRole::kChange}}, {"publish", {WebRole::kDrive, WebRole::kDrive}},
    {"release", {WebRole::kDrive, WebRole::kDrive}},   {"call", {WebRole::kDrive, WebRole::kDrive}},
    {"abort", {WebRole::kDrive, WebRole::kDrive}},     {"pause", {WebRole::kDrive, WebRole::kChange}},
    {"resume", {WebRole::kDrive, WebRole::kChange}},   {"change", {WebRole::kChange, WebRole::kChange}},
    {"undo", {WebRole::kChange, WebRole::kChange}},    {"redo", {WebRole::kChange, WebRole::kChange}},
    {"save", {WebRole::kChange, WebRole::kChange}},    {"step", {WebRole::kChange, WebRole::kChange}},
    {"speed", {WebRole::kChange, WebRole::kChange}},   {"reload", {WebRole::kChange, WebRole::kChange}},
    {"log", {WebRole::kChange, WebRole::kChange}},     {"profile", {WebRole::kChange, WebRole::kChange}},
    {"latency", {WebRole::kChange, WebRole::kChange}}, {"preview", {WebRole::kChange, WebRole::kChange}},
    {"restart", {WebRole::kChange, WebRole::kChange}}, {"quit", {WebRole::kChange, WebRole::kChange}},
    {"stop", {WebRole::kLook, WebRole::kLook}},        {"block", {WebRole::kDrive, WebRole::kDrive}}};

TEST_F(Roles, MayDoOfEveryOperationWhatTheyMay) {
  hooks.save = [](const std::string&) -> Result<std::string> { return std::string("saved"); };
  Start({}, Tokens());
  for (const WebRole role : kRoles) {
    Viewer viewer = ViewAs(role);
    const Json hello = viewer.Next("hello");
    EXPECT_EQ(hello["role"], std::string(WebRoleName(role)));
    EXPECT_EQ(hello["read_only"], role == WebRole::kLook);
    viewer.Next("catalogue");
    for (const Operation& operation : AllOperations()) {
      const auto needed = kNeeded.find(operation.name);
      ASSERT_NE(needed, kNeeded.end()) << operation.name << " has no role in this test";
      const std::string op(operation.name);
      EXPECT_EQ(IsRefused(viewer, op, ""), role < needed->second.first) << op << " by " << WebRoleName(role);
      EXPECT_EQ(IsRefused(viewer, op, "/app/a"), role < needed->second.second)
          << op << " of a module, by " << WebRoleName(role);
    }
  }
}

// A request of the table that pages lack, or that has a role of its own here, fails; and so does a new operation that the
// table does not describe, unless it is named below.
TEST(OperationsOfViewers, AreTheRequestsOfTheTable) {
  for (const DescribedRequest& each : RequestTable()) {
    if (each.name == "set") continue;  // pages send it as a change
    const Operation* const operation = internal::FindOperation(each.name);
    ASSERT_NE(operation, nullptr) << each.name;
    EXPECT_EQ(WebRoleName(operation->role_of_modules), each.role) << each.name;
    EXPECT_EQ(WebRoleName(operation->role), each.role_of_whole.empty() ? each.role : each.role_of_whole) << each.name;
  }
  std::set<std::string_view> others;
  for (const Operation& each : AllOperations()) {
    if (!FindRequest(each.name)) others.insert(each.name);
  }
  EXPECT_THAT(others, ElementsAre("abort", "alive", "arrange", "compatible", "conversions", "latency", "panel",
                                  "preview", "profile", "save_panel", "unwatch", "watch", "watch_rates"));
}

TEST_F(Roles, WhoLooksSeesAllAndChangesNothing) {
  bool has_saved = false;
  hooks.save = [&](const std::string&) -> Result<std::string> {
    has_saved = true;
    return std::string("saved");
  };
  Start({}, Tokens());
  Viewer viewer = ViewAs(WebRole::kLook);
  viewer.Next("catalogue");
  for (const Operation& operation : AllOperations()) {
    if (operation.role == WebRole::kLook) continue;
    const Json reply = viewer.Ask({{"op", std::string(operation.name)},
                                   {"path", "/app/a/output/out"},
                                   {"value", "7"},
                                   {"speed", 1},
                                   {"changes", Json::array({ChangeMessage("set /app/a/speed 2")})}});
    EXPECT_EQ(reply["ok"], false) << operation.name;
  }
  EXPECT_FALSE(has_saved);
  EXPECT_FALSE(scheduler.pace().is_paused());
  EXPECT_EQ(ViewAs(WebRole::kLook).Element("/app/a/parameter/speed")["value"], "1");
}

TEST_F(Roles, WhoDrivesPublishesByHandAndStops) {
  Start({}, Tokens());
  Viewer viewer = ViewAs(WebRole::kDrive);
  viewer.Next("catalogue");
  EXPECT_EQ(viewer.Ask({{"op", "publish"}, {"path", "/app/a/output/out"}, {"value", "7"}})["ok"], true);
  EXPECT_EQ(viewer.Ask({{"op", "release"}, {"path", "/app/a/output/out"}})["ok"], true);
  EXPECT_EQ(viewer.Ask({{"op", "pause"}})["ok"], true);
  EXPECT_TRUE(scheduler.pace().is_paused());
  const Json change = viewer.Change({"set /app/a/speed 2"});
  EXPECT_EQ(change["ok"], false);
  EXPECT_THAT(change["errors"][0]["hint"], HasSubstr("'change'"));
}

}  // namespace

}  // namespace runnel::test
