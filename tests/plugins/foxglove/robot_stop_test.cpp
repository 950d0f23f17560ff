// The STOP of the robot as the protocol has it: a service, a topic to publish to, a topic that tells of it.

#include "tests/plugins/foxglove/foxglove_fixture.h"

namespace runnel::test {
namespace {

class FoxgloveStop : public FoxgloveTest {
 protected:
  FoxgloveStop() { Mark(true); }
  void Mark(bool drives) {
    const std::lock_guard lock(runtime.structure_mutex());
    EXPECT_TRUE(robot.speed.SetDriving(drives, AnyValue(0.0), {}, DrivingKind::kVelocity));
  }
  static std::string Word(std::uint32_t number) {
    std::string bytes;
    for (int i = 0; i < 4; ++i) bytes += static_cast<char>(number >> (8 * i) & 0xff);
    return bytes;
  }
  /// What the service answers, at once; nothing if it does not.
  Json Call(const std::string& name, const std::string& json) {
    Turn();
    for (const Json& message : Take("advertiseServices")) {
      for (const Json& each : message["services"]) services[each["name"]] = each["id"];
    }
    client.binaries.clear();
    session->OnBinary("\x02" + Word(services.at(name)) + Word(++calls) + Word(4) + "json" + json);
    for (const std::string& bytes : client.binaries) {
      if (bytes[0] == 3 && bytes.substr(5, 4) == Word(calls)) return Json::parse(bytes.substr(17));
    }
    return {};
  }
  [[nodiscard]] bool in_force() { return runtime.robot_stop().in_force(); }

  std::map<std::string, std::uint32_t> services;
  std::uint32_t calls = 0;
};

TEST_F(FoxgloveStop, IsPressedByWhoeverMayLookWhileTheStructureIsLocked) {
  client.its_role = WebRole::kLook;
  Begin(true);
  EXPECT_EQ(Call("/stop", R"({"data":false})")["success"], true);
  EXPECT_FALSE(in_force()) << "false does nothing";
  EXPECT_EQ(services.size(), 1u) << "what else there is takes a role";
  {
    const HeldStructure held(runtime);
    const Json reply = Call("/stop", R"({"data":true})");
    EXPECT_EQ(reply["success"], true);
    EXPECT_THAT(reply["message"].get<std::string>(), HasSubstr("STOP is in force"));
    EXPECT_TRUE(in_force());
  }
  EXPECT_EQ(Call("/stop", R"({"data":false})")["success"], true);
  EXPECT_TRUE(in_force()) << "false does not release";
}

TEST_F(FoxgloveStop, IsNoSuccessWhereItStopsNothing) {
  Mark(false);
  Begin();
  const Json reply = Call("/stop", R"({"data":true})");
  EXPECT_EQ(reply["success"], false);
  EXPECT_THAT(reply["message"].get<std::string>(),
              testing::AllOf(HasSubstr("STOP is in force"), HasSubstr("STOP stops nothing")));
  EXPECT_TRUE(in_force()) << "for ports that come later";
}

TEST_F(FoxgloveStop, OvertakesWhatIsSaidTooFast) {
  client.its_role = WebRole::kLook;
  Begin();
  EXPECT_EQ(Call("/stop", "{}")["success"], true);
  const auto call = [&](const std::string& name) {
    return "\x02" + Word(services.at(name)) + Word(1) + Word(4) + "json{}";
  };
  const auto outranks = [&](const std::string& message) { return session->OnArrival(message, false).outranks; };
  EXPECT_TRUE(outranks(call("/stop")));
  EXPECT_FALSE(session->OnArrival(call("/stop"), true).outranks);
  EXPECT_FALSE(outranks("\x02" + Word(12345) + Word(1)));
  Say({{"op", "advertise"}, {"channels", {{{"id", 3}, {"topic", "/stop"}, {"encoding", "json"}}}}});
  EXPECT_TRUE(outranks("\x01" + Word(3) + "{}"));
  EXPECT_FALSE(outranks("\x01" + Word(4) + "{}"));
  EXPECT_FALSE(outranks("\x01"));
}

// Its messages do not say when they were sent.
TEST_F(FoxgloveStop, IsNoOperatorWhoIsHeard) {
  service.operators().Begin(std::chrono::hours(1));
  Begin();
  client.its_role = WebRole::kDrive;
  const auto begun = service.operators().Look();
  WaitUntil("time has passed", [&] { return SteadyClock().Now() + std::chrono::hours(1) > begun; });
  (void)session->OnArrival(R"({"op":"subscribeConnectionGraph"})", true);
  Say({{"op", "subscribeConnectionGraph"}});
  EXPECT_EQ(service.operators().Look(), begun);
}

TEST_F(FoxgloveStop, IsPressedByACallThatSaysNothing) {
  Begin();
  EXPECT_EQ(Call("/stop", "{}")["success"], true);
  EXPECT_TRUE(in_force());
  (void)runtime.robot_stop().Release("the test");
  EXPECT_EQ(Call("/stop", "")["success"], true);
  EXPECT_TRUE(in_force());
}

TEST_F(FoxgloveStop, IsReleasedByWhoMayDrive) {
  client.its_role = WebRole::kDrive;
  Begin();
  EXPECT_EQ(Call("/release", "{}")["success"], false) << "it is not in force";
  runtime.robot_stop().Press("the test");
  const Json unsaid = Call("/release", "{}");
  EXPECT_EQ(unsaid["success"], false);
  EXPECT_THAT(unsaid["message"].get<std::string>(), HasSubstr(R"(say which STOP is meant: {"number": 1})"));
  runtime.robot_stop().Press("somebody, while it is in force");
  const Json late = Call("/release", R"({"number": 1})");
  EXPECT_EQ(late["success"], false);
  EXPECT_THAT(late["message"].get<std::string>(), HasSubstr("STOP was pressed or released after this was asked for"));
  EXPECT_TRUE(in_force());
  const Json more = Call("/release", R"({"number": 2, "when": "now"})");
  EXPECT_EQ(more["success"], false);
  EXPECT_THAT(more["message"].get<std::string>(), HasSubstr("has no \"when\""));
  EXPECT_TRUE(in_force());
  EXPECT_EQ(Call("/release", R"({"number": 2})")["success"], true);
  EXPECT_FALSE(in_force());
  runtime.robot_stop().Press("the test");
  const std::uint32_t release = services.at("/release");
  client.its_role = WebRole::kLook;
  session->OnBinary("\x02" + Word(release) + Word(99) + Word(4) + "json{}");
  session->OnPoll();
  EXPECT_FALSE(Take("serviceCallFailure").empty());
  EXPECT_TRUE(in_force());
}

TEST_F(FoxgloveStop, IsPressedByATopicThatClientsPublish) {
  client.its_role = WebRole::kLook;
  Begin();
  Say({{"op", "advertise"}, {"channels", {{{"id", 3}, {"topic", "/stop"}, {"encoding", "json"}}}}});
  Turn();
  Publish(3, R"({"data":false})");
  EXPECT_FALSE(in_force());
  Publish(3, R"({"data":true})");
  EXPECT_TRUE(in_force());
  EXPECT_EQ(Complaint(), "");
  Say({{"op", "unadvertise"}, {"channelIds", {3}}});
  Publish(3, R"({"data":true})");
  EXPECT_NE(Complaint(), "");
}

TEST_F(FoxgloveStop, WhatWaitedMeanwhileIsNotCarriedOut) {
  Begin();
  Turn();
  Say({{"op", "advertise"},
       {"channels", {{{"id", 3}, {"topic", "/application/robot/input/limit"}, {"encoding", "json"}}}}});
  ASSERT_EQ(Complaint(), "");
  client.its_arrival = session->OnArrival("", false);
  EXPECT_EQ(Call("/stop", "{}")["success"], true) << "the newest STOP counts whatever was before";
  client.its_arrival = session->OnArrival("", false);
  (void)runtime.robot_stop().Release("the test");
  runtime.robot_stop().Press("the test");
  EXPECT_EQ(Call("/release", "{}"), Json());
  EXPECT_FALSE(Take("serviceCallFailure").empty());
  EXPECT_TRUE(in_force());
  Publish(3, "{}");
  EXPECT_THAT(Complaint(), HasSubstr("STOP was pressed or released after this was asked for"));
  Say({{"op", "setParameters"}, {"parameters", Json::array()}});
  EXPECT_THAT(Complaint(), HasSubstr("STOP was pressed or released after this was asked for"));
  session->OnTooMany("", false);
  EXPECT_THAT(Complaint(), HasSubstr("too many messages a second"));
}

TEST_F(FoxgloveStop, IsTold) {
  Begin();
  Turn();
  Say({{"op", "subscribe"}, {"subscriptions", {{{"id", 5}, {"channelId", IdOf("/stop")}}}}});
  Turn();
  auto values = TakeValues();
  ASSERT_EQ(values.size(), 1u);
  EXPECT_EQ(values[0].json["data"], false);
  clock.Set(Time(std::chrono::seconds(7)));
  runtime.robot_stop().Press("a button");
  Turn();
  values = TakeValues();
  ASSERT_EQ(values.size(), 1u);
  EXPECT_EQ(values[0].json["data"], true);
  EXPECT_EQ(values[0].json["by"], "a button");
  EXPECT_EQ(values[0].json["since"], 7);
  Turn();
  EXPECT_THAT(TakeValues(), IsEmpty()) << "nothing new";
}

TEST_F(FoxgloveStop, IsToldEachSecondHoweverMuchWaits) {
  Begin();
  Turn();
  Say({{"op", "subscribe"}, {"subscriptions", {{{"id", 5}, {"channelId", IdOf("/stop")}}}}});
  Turn();
  ASSERT_EQ(TakeValues().size(), 1u);
  client.waiting = 2 << 20;
  runtime.robot_stop().Press("a button");
  Turn();
  auto values = TakeValues();
  ASSERT_EQ(values.size(), 1u);
  EXPECT_EQ(values[0].json["data"], true);
  for (int second = 0; second < 3; ++second) {
    steady_clock.Advance(std::chrono::seconds(1));
    session->OnPoll();
    values = TakeValues();
    ASSERT_EQ(values.size(), 1u);
    EXPECT_EQ(values[0].json["data"], true);
    Turn();
    EXPECT_THAT(TakeValues(), IsEmpty()) << "it is told already";
  }
  client.is_slow = true;  // it takes nothing
  steady_clock.Advance(std::chrono::seconds(1));
  session->OnPoll();
  client.is_slow = false;
  Turn();
  EXPECT_EQ(TakeValues().size(), 1u) << "what was not taken is told later";
}

}  // namespace
}  // namespace runnel::test
