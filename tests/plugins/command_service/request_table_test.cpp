#include "plugins/command_service/request_table.h"

#include <set>

#include <gmock/gmock.h>

namespace runnel::test {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

std::string ErrorOf(const char* name, const RequestFields& fields) {
  const auto made = MakeRequest(name, fields, "a test");
  return made ? "" : made.error().ToString();
}
template <typename Request>
Request Made(const char* name, const RequestFields& fields) {
  auto made = MakeRequest(name, fields, "a test");
  EXPECT_TRUE(made) << made.error().ToString();
  return std::get<Request>(*made);
}

TEST(RequestTable, EachRequestSaysWhatItNeeds) {
  const std::set<std::string_view> made_by_clients{"change", "save", "call", "step", "speed"};
  for (const DescribedRequest& each : RequestTable()) {
    if (made_by_clients.contains(each.name)) {
      EXPECT_THAT(ErrorOf(each.name.data(), {}), HasSubstr("is made by its client"));
      continue;
    }
    EXPECT_THAT(std::string(each.example), ::testing::StartsWith(std::string(each.name)));
    EXPECT_FALSE(each.help.empty());
    EXPECT_TRUE(each.role == "look" || each.role == "drive" || each.role == "change") << each.name;
    EXPECT_TRUE(each.role_of_whole.empty() || each.role_of_whole == "drive") << each.name;
    RequestFields fields;
    for (const RequestField& field : each.fields) {
      if (!field.is_required) continue;
      EXPECT_THAT(ErrorOf(each.name.data(), fields), HasSubstr(std::string(field.name)));
      fields[std::string(field.name)] = field.name == "level" ? "info" : "a";
    }
    EXPECT_EQ(ErrorOf(each.name.data(), fields), "");
    EXPECT_EQ(LetsMove(*MakeRequest(each.name, fields, "a test")), each.lets_move)
        << each.name << " is called otherwise";
  }
  EXPECT_EQ((*FindRequest("stop"))->role, "look") << "anybody may press";
  EXPECT_EQ((*FindRequest("release"))->role, "drive");
  for (const char* const name : {"pause", "resume"}) {
    EXPECT_EQ((*FindRequest(name))->role, "change")
        << name << " of a module, which may be what keeps the robot from colliding";
    EXPECT_EQ((*FindRequest(name))->role_of_whole, "drive") << name;
  }
}

TEST(RequestTable, SaysWhatMayLetSomethingMove) {
  std::set<std::string_view> rests;
  for (const DescribedRequest& each : RequestTable()) {
    EXPECT_EQ(LetsMove(each.name), each.lets_move);
    if (!each.lets_move) rests.insert(each.name);
  }
  EXPECT_THAT(rests, ::testing::ElementsAre("block", "log", "pause", "quit", "save", "stop"));
  EXPECT_FALSE(LetsMove("arrange")) << "what is no request";
  EXPECT_FALSE(LetsMove(SaveRequest{}));
  EXPECT_THAT(ErrorOf("log", {{"level", "loud"}}), HasSubstr("there is no log level 'loud'"));
}

TEST(RequestTable, StopAndReleaseAreOfTheRobotOrOfAPort) {
  EXPECT_TRUE(Made<RobotStopRequest>("stop", {}).is_pressed);
  EXPECT_EQ(Made<RobotStopRequest>("stop", {}).by, "a test");
  EXPECT_FALSE(Made<RobotStopRequest>("release", {{"path", "stop"}}).is_pressed);
  EXPECT_EQ(Made<ReleaseRequest>("release", {{"path", "gate/stop"}}).port, "gate/stop");
  EXPECT_EQ(Made<BlockRequest>("block", {{"path", "/drive"}}).port, "/drive");
  EXPECT_TRUE(Made<PauseRequest>("pause", {{"path", "/drive"}}).is_paused);
  EXPECT_FALSE(Made<PauseRequest>("resume", {{"path", "/drive"}}).is_paused);
}

TEST(RequestTable, NumbersAndDurationsAreReadAsTheyCome) {
  const auto publish = Made<PublishRequest>(
      "publish", {{"path", "/drive"}, {"value", 3.5}, {"rate", "20"}, {"deadline", "300ms"}, {"lease", "a"}});
  EXPECT_EQ(publish.value, "3.5");
  EXPECT_EQ(publish.rate, 20);
  EXPECT_EQ(publish.deadline, Duration(300ms));
  EXPECT_EQ(Made<PublishRequest>("publish", {{"path", "/a"}, {"value", ""}, {"deadline", 0.25}}).deadline,
            Duration(250ms));
  const auto change = Made<ChangeRequest>("set", {{"path", "/a/speed"}, {"value", "0.3"}});
  EXPECT_EQ(std::get<SetParameter>(change.placed.changes.at(0)).path, "/a/speed");
  EXPECT_EQ(change.client, "a test");
}

TEST(RequestTable, WhatIsWrongIsRefusedWithTheNearestName) {
  EXPECT_THAT(ErrorOf("stopp", {}), HasSubstr("did you mean 'stop'?"));
  EXPECT_THAT(ErrorOf("", {}), HasSubstr("there is no request ''"));
  EXPECT_THAT(ErrorOf("block", {{"paths", "/a"}}), HasSubstr("did you mean 'path'?"));
  EXPECT_THAT(ErrorOf("stop", {{"path", ""}}), HasSubstr("has no field 'path'"));
  EXPECT_THAT(ErrorOf("release", {{"path", ""}}), HasSubstr("empty word"));
  EXPECT_THAT(ErrorOf("release", {{"path", 7.0}}), HasSubstr("got a number"));
  const RequestFields publish{{"path", "/a"}, {"value", "1"}};
  const auto with = [&](const char* name, const char* value) {
    RequestFields fields = publish;
    fields[name] = value;
    return ErrorOf("publish", fields);
  };
  EXPECT_THAT(with("rate", "often"), HasSubstr("no number"));
  EXPECT_THAT(with("deadline", "soon"), HasSubstr("soon"));
}

}  // namespace
}  // namespace runnel::test
