// The STOP of the robot by viewers: whoever looks presses, whatever else goes on, and all are told.

#include <future>
#include <map>
#include <utility>
#include <vector>

#include "core/port/driving_ports.h"
#include "tests/plugins/inspector/viewers_stop.h"
#include "tests/support/wait_until.h"

namespace runnel::test {
namespace {

using ::testing::Not;

TEST_F(ViewersStop, WhoeverLooksPressesAndWhoDrivesReleases) {
  Start({}, LookAndDrive());
  Viewer other = Connect("runnel.inspector.v1", WebRole::kLook);
  other.Next(InForce(false), "no STOP yet");
  for (const char* protocol : {"runnel.inspector.v1", "runnel.stop.v1"}) {
    Viewer looks = Connect(protocol, WebRole::kLook);
    Viewer drives = Connect(protocol, WebRole::kDrive);
    const Json pressed = looks.Ask({{"op", "stop"}});
    EXPECT_EQ(pressed["ok"], true) << protocol << pressed;
    EXPECT_TRUE(in_force());
    EXPECT_THAT(other.Next(InForce(true), "STOP")["stop"]["by"], HasSubstr("viewer "));
    drives.Next(InForce(true), "STOP, to who drives");
    const Json refused = looks.Ask({{"op", "release"}, {"path", "stop"}});
    EXPECT_EQ(refused["ok"], false) << protocol;
    EXPECT_THAT(refused["errors"][0]["hint"], HasSubstr("'drive'"));
    EXPECT_TRUE(in_force());
    EXPECT_THAT(looks.Ask({{"op", "stop"}})["text"], HasSubstr("in force already"));
    EXPECT_EQ(drives.Ask({{"op", "release"}, {"path", "stop"}})["ok"], true);
    EXPECT_FALSE(in_force());
    other.Next(InForce(false), "no STOP any more");
  }
}

TEST_F(ViewersStop, ReadOnlyItIsPressedAllTheSame) {
  Start({.is_read_only = true});
  Viewer viewer(server->port(), "", "runnel.stop.v1");
  EXPECT_EQ(viewer.Ask({{"op", "stop"}})["ok"], true);
  EXPECT_EQ(viewer.Ask({{"op", "release"}, {"path", "stop"}})["ok"], false);
  EXPECT_TRUE(in_force());
}

TEST_F(ViewersStop, NeedsNeitherWorkerNorStructureNorRoomForRequests) {
  std::promise<void> saving;
  std::promise<void> may_end;
  hooks.save = [&](const std::string&) -> Result<std::string> {
    saving.set_value();
    may_end.get_future().wait();
    return std::string("saved");
  };
  Start();
  Viewer viewer = View();
  Viewer stop(server->port(), "", "runnel.stop.v1");
  viewer.Next("structure");
  viewer.Send({{"op", "save"}});
  saving.get_future().wait();
  const std::unique_lock lock(runtime.structure_mutex());
  for (int i = 0; i < 100; ++i) viewer.Send({{"op", "undo"}});
  viewer.Next([](const Json& each) { return each["op"] == "reply" && each["ok"] == false; }, "refusal");
  EXPECT_EQ(viewer.Ask({{"op", "stop"}})["ok"], true);
  EXPECT_TRUE(in_force());
  EXPECT_EQ(stop.Ask({{"op", "release"}, {"path", "stop"}})["ok"], true);
  EXPECT_FALSE(in_force());
  EXPECT_EQ(stop.Ask({{"op", "stop"}})["ok"], true);
  EXPECT_TRUE(in_force());
  may_end.set_value();
}

// What leaves over a network is no port that a viewer knows.
TEST_F(ViewersStop, ItsSignsOfLifeSayWhatItHoldsWhileItIsInForce) {
  Start();
  Viewer viewer = View();
  EXPECT_FALSE(viewer.Next(InForce(false), "no STOP")["stop"].contains("drives"));
  runtime.robot_stop().Press("a test");
  const auto holds = [](const std::string& what) {
    return
        [what](const Json& each) { return each["op"] == "alive" && each["stop"].value("drives", "not told") == what; };
  };
  viewer.Next(holds(""), "that it holds nothing");
  const auto elsewhere =
      std::make_shared<PortStop>(AnyValue(), Duration{}, DrivingKind::kVelocity, runtime.robot_stop().signal());
  AddWhatDrives(runtime, "/cmd_vel (in the network)", elsewhere);
  viewer.Next(holds("/cmd_vel (in the network)"), "what leaves over the network");
  {
    const std::lock_guard lock(runtime.structure_mutex());
    ASSERT_TRUE(PortAt("/app/b/input/in").SetDriving(true, AnyValue(0), {}, DrivingKind::kEffort));
  }
  viewer.Next(holds("/app/b/input/in, /cmd_vel (in the network)"), "both");
  const std::lock_guard lock(runtime.structure_mutex());
  viewer.Next(holds("not told"), "a sign of life although somebody changes the structure");
}

// No revision of the structure tells of it, so each sign of life does, over both connections.
TEST_F(ViewersStop, ItsSignsOfLifeAndItsAnswerSayWhatItDoesNotReach) {
  Start();
  {
    const std::lock_guard lock(runtime.structure_mutex());
    ASSERT_TRUE(PortAt("/app/b/input/in").SetDriving(true, AnyValue(0), {}, DrivingKind::kEffort));
  }
  Viewer viewer = View();
  Viewer stop(server->port(), "", "runnel.stop.v1");
  const auto tells = [](const Json& unreached) {
    return [unreached](const Json& each) {
      return each["op"] == "alive" && each["stop"].value("unreached", Json()) == unreached;
    };
  };
  const Json all = Json::array();
  const Json paused = Json::array({Json{{"path", "/app/b/input/in"}, {"why", "/app/b is paused"}}});
  for (Viewer* each : {&viewer, &stop}) each->Next(tells(all), "that all is reached");
  EXPECT_FALSE(viewer.Ask({{"op", "stop"}}).contains("leaves_some"));
  ASSERT_TRUE(scheduler.SetPaused("/app/b", true));
  for (Viewer* each : {&viewer, &stop}) each->Next(tells(paused), "what is paused");
  const Json answer = viewer.Ask({{"op", "stop"}});
  EXPECT_EQ(answer["ok"], true) << "it is in force";
  EXPECT_EQ(answer.value("leaves_some", false), true);
  EXPECT_THAT(answer["text"], HasSubstr("/app/b/input/in: cannot be reached: /app/b is paused"));
  EXPECT_EQ(viewer.Ask({{"op", "release"}, {"path", "stop"}})["ok"], true);
  for (Viewer* each : {&viewer, &stop}) each->Next(tells(paused), "what is paused, although no STOP is in force");
  ASSERT_TRUE(scheduler.SetPaused("/app/b", false));
  for (Viewer* each : {&viewer, &stop}) each->Next(tells(all), "that all is reached again");
  const std::lock_guard lock(runtime.structure_mutex());
  for (Viewer* each : {&viewer, &stop}) each->Next(tells(Json()), "that it is not known now");
}

TEST_F(ViewersStop, ItsSignsOfLifeSayWhetherTheRobotMayStillBrake) {
  Start();
  Viewer viewer = View();
  const auto brakes = [](bool is_braking) {
    return [is_braking](const Json& each) {
      return each["op"] == "alive" && each["stop"].value("braking", Json()) == is_braking;
    };
  };
  const auto set_brake = [&](Duration brake) {
    const std::lock_guard lock(runtime.structure_mutex());
    ASSERT_TRUE(PortAt("/app/b/input/in").SetDriving(true, AnyValue(0), brake, DrivingKind::kEffort));
  };
  set_brake(std::chrono::seconds(9));
  EXPECT_FALSE(viewer.Next(InForce(false), "no STOP")["stop"].contains("braking"));
  runtime.robot_stop().Press("a test");
  viewer.Next(brakes(true), "that it brakes");
  set_brake(Duration{});
  viewer.Next(brakes(false), "that it has its safe value");
}

TEST_F(ViewersStop, AnswersWhereItStopsNothing) {
  Start();
  Viewer viewer = View();
  const Json nothing = viewer.Ask({{"op", "stop"}});
  EXPECT_EQ(nothing["ok"], true) << "it is in force";
  EXPECT_EQ(nothing["stops_nothing"], true);
  EXPECT_THAT(nothing["text"], HasSubstr("STOP stops nothing"));
  {
    const std::lock_guard lock(runtime.structure_mutex());
    ASSERT_TRUE(PortAt("/app/b/input/in").SetDriving(true, AnyValue(0), {}, DrivingKind::kEffort));
  }
  EXPECT_FALSE(viewer.Ask({{"op", "stop"}}).contains("stops_nothing"));
}

// Without the rule of the server the STOP would wait for half a minute.
TEST_F(ViewersStop, OvertakesWhatItsConnectionHasSaidTooFast) {
  Start();
  Viewer viewer = View();
  std::string flood;
  const Json request{{"op", "preview"}, {"file", "x"}};
  for (int i = 0; i < 20'000; ++i) flood += RawClient::Frame(1, request.dump());
  viewer.raw().Send(flood);
  const Json reply = viewer.Ask({{"op", "stop"}});
  EXPECT_EQ(reply["ok"], true);
  EXPECT_TRUE(in_force());
}

/// Viewers whose messages wait, and what they are answered.
class ViewersStopOvertakes : public ViewersStop {
 protected:
  static constexpr const char* kIn = "/app/b/input/in";
  void SetUp() override { Start({}, {.limits = {.messages_per_second = 20}}); }
  /// Behind as many that half a second's worth waits; with numbers from 1.
  static void SendTooFast(Viewer& viewer, std::vector<Json> messages) {
    std::string flood;
    for (int i = 0; i < 30; ++i) flood += RawClient::Frame(1, R"({"op":"alive"})");
    for (std::size_t i = 0; i < messages.size(); ++i) {
      messages[i]["request"] = i + 1;
      flood += RawClient::Frame(1, messages[i].dump());
    }
    viewer.raw().Send(flood);
  }
  static std::map<int, Json> Replies(Viewer& viewer, std::size_t count) {
    std::map<int, Json> replies;
    while (replies.size() < count) {
      const Json reply = viewer.Next("reply");
      if (!reply.contains("request")) break;
      replies[reply["request"]] = reply;
    }
    return replies;
  }
};

TEST_F(ViewersStopOvertakes, WhatWasSentBeforeItIsNotCarriedOutAfterItsRelease) {
  Viewer viewer = View();
  const std::string seven = R"({"op":"publish","path":"/app/b/input/in","value":"7"})";
  SendTooFast(viewer, {Json::parse(seven), {{"op", "stop"}}, {{"op", "release"}, {"path", "stop"}}});
  auto replies = Replies(viewer, 3);
  EXPECT_EQ(replies[2]["ok"], true);
  EXPECT_EQ(replies[3]["ok"], true);
  EXPECT_THAT(replies[1]["errors"][0]["message"], HasSubstr("STOP was pressed or released after this was asked for"));
  EXPECT_EQ(viewer.Ask(Json::parse(seven))["ok"], true);
}

TEST_F(ViewersStopOvertakes, WhatOnlyStopsOrWritesIsCarriedOutAllTheSame) {
  Viewer viewer = View();
  const Json connect{{"change", "connect"}, {"from", "/app/a/output/out"}, {"to", "/app/b/input/in"}};
  const Json quiet{{"change", "log"}, {"path", "/app/a"}, {"level", "debug"}};
  const std::vector<Json> late{{{"op", "change"}, {"changes", {connect}}},
                               {{"op", "undo"}},
                               {{"op", "resume"}},
                               {{"op", "step"}},
                               {{"op", "change"}, {"changes", {quiet}}},
                               {{"op", "log"}, {"path", "/app/a"}, {"level", "debug"}},
                               {{"op", "block"}, {"path", kIn}},
                               {{"op", "pause"}, {"path", "/app/a"}}};
  std::vector<Json> messages = late;
  messages.push_back({{"op", "stop"}});
  SendTooFast(viewer, messages);
  auto replies = Replies(viewer, messages.size());
  for (int i = 1; i <= static_cast<int>(late.size()); ++i) {
    const bool is_refused = replies[i].dump().find("STOP was pressed or released after") != std::string::npos;
    EXPECT_EQ(is_refused, i <= 4) << late[static_cast<std::size_t>(i - 1)] << replies[i];
  }
}

TEST_F(ViewersStopOvertakes, AReleaseThatWasSentBeforeItDoesNotEndIt) {
  Viewer viewer = View();
  EXPECT_EQ(viewer.Ask({{"op", "stop"}})["ok"], true);
  SendTooFast(viewer, {{{"op", "release"}, {"path", "stop"}}, {{"op", "stop"}}});
  auto replies = Replies(viewer, 2);
  EXPECT_EQ(replies[1]["ok"], true);
  EXPECT_THAT(replies[2]["text"], Not(HasSubstr("already"))) << "the release came first";
  EXPECT_TRUE(in_force());
}

TEST_F(ViewersStopOvertakes, WhoSaysTooMuchIsHeardWhenItComesNotWhenItIsCarriedOut) {
  OperatorWatch& operators = service->operators();
  operators.Begin(1h);
  Viewer viewer = View();
  const double at = viewer.Next("alive")["at"];
  SendTooFast(viewer, {{{"op", "panel"}}, {{"op", "alive"}, {"at", at}}, {{"op", "stop"}}});
  viewer.Next([](const Json& each) { return each["op"] == "reply" && each["request"] == 3; }, "STOP");
  EXPECT_EQ(operators.Look(), Time(FromSeconds(at)) + 1h) << "though what was said before it still waits";
}

TEST_F(ViewersStopOvertakes, AHoldIsNotRenewedByWhatHasWaited) {
  Viewer viewer = View();
  SendTooFast(viewer, {{{"op", "publish"}, {"path", kIn}, {"value", "7"}, {"deadline", 0.05}, {"lease", "a"}}});
  auto replies = Replies(viewer, 1);
  EXPECT_EQ(replies[1]["ok"], false);
  EXPECT_THAT(replies[1].dump(), HasSubstr("has waited for longer than its deadline"));
}

TEST_F(ViewersStopOvertakes, WhatIsTooMuchIsRefusedWithItsNumber) {
  Viewer viewer = View();
  std::vector<Json> many(100, Json{{"op", "publish"}, {"path", kIn}, {"value", "7"}});
  SendTooFast(viewer, std::move(many));
  auto replies = Replies(viewer, 100);
  EXPECT_THAT(replies[100]["errors"][0]["message"], HasSubstr("too many requests a second"));
  EXPECT_EQ(replies[1]["ok"], true);
}

TEST_F(ViewersStopOvertakes, WhatIsTooMuchAndTooLongToBeReadIsRefusedWithItsNumberToo) {
  Viewer viewer = View();
  std::vector<Json> many(100, Json{{"op", "publish"}, {"path", kIn}, {"at", 1}});
  many.back()["path"] = std::string(100'000, '/');
  SendTooFast(viewer, std::move(many));
  auto replies = Replies(viewer, 100);
  EXPECT_THAT(replies[100]["errors"][0]["message"], HasSubstr("too many requests a second"));
}

TEST_F(ViewersStop, IsNotReleasedByAnOldRelease) {
  Start();
  Viewer viewer(server->port(), "", "runnel.stop.v1");
  const double before = viewer.Next("alive")["at"].get<double>();
  EXPECT_EQ(viewer.Ask({{"op", "stop"}})["ok"], true);
  const auto release = [&](double at) { return viewer.Ask({{"op", "release"}, {"path", "stop"}, {"at", at}}); };
  EXPECT_THAT(release(before)["errors"][0]["message"],
              HasSubstr("STOP was pressed or released after this was asked for"));
  EXPECT_TRUE(in_force());
  const double seen = viewer.Next("alive")["at"].get<double>();
  EXPECT_EQ(viewer.Ask({{"op", "stop"}})["ok"], true) << "by whoever, while it is in force";
  EXPECT_THAT(release(seen)["errors"][0]["message"],
              HasSubstr("STOP was pressed or released after this was asked for"));
  EXPECT_TRUE(in_force());
  EXPECT_EQ(release(viewer.Next("alive")["at"].get<double>())["ok"], true);
  EXPECT_FALSE(in_force());
}

TEST_F(ViewersStop, WhatOnlySpeaksOfAStopOvertakesNothing) {
  Start();
  Viewer viewer = View();
  viewer.Send({{"op", "unwatch"}, {"path", "stop"}});
  viewer.Send({{"op", "release"}, {"path", "stop"}});
  viewer.Next([](const Json& each) { return each["op"] == "reply" && each["ok"] == false; }, "refusal");
  EXPECT_FALSE(in_force());
}

TEST_F(ViewersStop, ItsConnectionsAreNoneOfTheOthers) {
  WebServerOptions options = LookAndDrive();
  options.limits.clients = 2;
  Start({}, options);
  Viewer stop = Connect("runnel.stop.v1", WebRole::kLook);
  std::vector<Viewer> drivers;
  for (int i = 0; i < 2; ++i) drivers.push_back(Connect("runnel.inspector.v1", WebRole::kDrive));
  Viewer another = Connect("runnel.stop.v1", WebRole::kLook);
  const std::string token = "runnel.token.secret-of-drive";
  EXPECT_THAT(RawClient(server->port()).Upgrade("runnel.inspector.v1, " + token), HasSubstr("503 "));
  for (Viewer* const each : {&stop, &another}) EXPECT_EQ(each->Ask({{"op", "stop"}})["ok"], true);
}

}  // namespace
}  // namespace runnel::test
