#include <new>

#include "plugins/testing/fault_injection.h"
#include "tests/plugins/foxglove/foxglove_fixture.h"

namespace runnel::test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::Key;
using testing::Not;
using testing::UnorderedElementsAre;

Json Subscribe(std::uint32_t id, std::uint32_t channel) {
  return {{"op", "subscribe"}, {"subscriptions", {{{"id", id}, {"channelId", channel}}}}};
}

TEST_F(FoxgloveTest, GreetsWithWhatItCanDo) {
  Begin();
  const auto greetings = Take("serverInfo");
  ASSERT_EQ(greetings.size(), 1u);
  EXPECT_EQ(greetings[0]["name"], "demo");
  EXPECT_THAT(greetings[0]["capabilities"], UnorderedElementsAre("time", "parameters", "parametersSubscribe",
                                                                 "connectionGraph", "clientPublish", "services"));
  EXPECT_EQ(greetings[0]["supportedEncodings"], Json({"json"}));
  EXPECT_FALSE(greetings[0]["sessionId"].get<std::string>().empty());
  EXPECT_THAT(protocol.names, ElementsAre("foxglove.websocket.v1", "foxglove.sdk.v1"));
}

TEST_F(FoxgloveTest, AdvertisesAllThatComesOut) {
  Begin();
  std::vector<std::string> topics;
  for (const auto& [topic, channel] : Channels()) topics.push_back(topic);
  EXPECT_THAT(topics, ElementsAre("/log", "/robot/pose", "/robot/pose/foxglove", "/robot/scan", "/robot/scan/foxglove",
                                  "/robot/speed", "/stop", "/tf"));
  const Json pose = channels["/robot/pose/foxglove"];
  EXPECT_EQ(pose["encoding"], "json");
  EXPECT_EQ(pose["schemaEncoding"], "jsonschema");
  EXPECT_EQ(pose["schemaName"], "foxglove.PoseInFrame");
  EXPECT_EQ(Json::parse(pose["schema"].get<std::string>())["title"], "foxglove.PoseInFrame");
  EXPECT_EQ(channels["/robot/speed"]["schemaName"], "double");
}

TEST_F(FoxgloveTest, AdvertisesAllOfItToTheNextClientWhereverMemoryHasRunOut) {
  bool has_struck = true;
  for (std::size_t nth = 1; has_struck; nth += 7) {  // it allocates very often
    protocol = FoxgloveProtocol({.service = service, .name = "", .version = "", .steady_clock = &steady_clock});
    session = protocol.start(client);
    {
      FaultInjection fault(InjectedFault::kAllocation, nth);
      try {
        session->OnPoll();
      } catch (const std::bad_alloc&) {
      }
      has_struck = fault.has_struck();
    }
    client.texts.clear();
    channels.clear();
    session = protocol.start(client);
    Turn();
    Turn();
    ASSERT_EQ(Channels().size(), 8u) << nth;
  }
}

TEST_F(FoxgloveTest, TellsTheLogInItsOwnSchema) {
  log.Add({.time = Time(std::chrono::milliseconds(1500)),
           .level = LogLevel::kWarning,
           .path = "/robot/sonar",
           .text = "no echo",
           .left_out = 3});
  Begin();
  const Json channel = Channels().at("/log");
  EXPECT_EQ(channel["schemaName"], "foxglove.Log");
  Say(Subscribe(7, channel["id"]));
  log.Add(ApplicationLog::Kind::kChange, "set speed to 3");
  Turn();
  const auto values = TakeValues();
  ASSERT_EQ(values.size(), 3u);
  EXPECT_EQ(values[0].json["message"], "put in /application");
  EXPECT_EQ(values[1].subscription, 7u);
  EXPECT_EQ(values[1].timestamp, 1'500'000'000u);
  EXPECT_EQ(values[1].json, Json::parse(R"--({"timestamp":{"sec":1,"nsec":500000000},"level":3,
      "message":"no echo (3 more left out)","name":"/robot/sonar","file":"","line":0})--"));
  EXPECT_EQ(values[2].json["message"], "set speed to 3");
  EXPECT_EQ(values[2].json["level"], 2);
  Turn();
  EXPECT_THAT(TakeValues(), IsEmpty());
}

TEST_F(FoxgloveTest, SendsTheRestOfTheLogToWhoWasSlow) {
  Begin();
  Say(Subscribe(7, IdOf("/log")));
  Turn();
  TakeValues();
  for (int i = 0; i < 3; ++i) log.Add(ApplicationLog::Kind::kInfo, std::to_string(i));
  client.is_slow = true;
  Turn();
  client.is_slow = false;
  Turn();
  const auto values = TakeValues();
  ASSERT_EQ(values.size(), 3u);
  EXPECT_EQ(values[2].json["message"], "2");
}

TEST_F(FoxgloveTest, FollowsTheStructure) {
  Begin();
  Channels();
  auto& other = runtime.Create<Robot>(application, "other");
  ASSERT_TRUE(runtime.MakeReady(other));
  Turn();
  const std::uint32_t id = IdOf("/other/pose");
  EXPECT_THAT(Take("unadvertise"), IsEmpty());
  ASSERT_TRUE(runtime.Delete(other));
  Turn();
  const auto gone = Take("unadvertise");
  ASSERT_EQ(gone.size(), 1u);
  EXPECT_EQ(gone[0]["channelIds"].size(), 5u);
  EXPECT_THAT(gone[0]["channelIds"], Contains(id));
  channels.clear();
  ASSERT_TRUE(runtime.MakeReady(runtime.Create<Robot>(application, "other")));
  Turn();
  EXPECT_EQ(IdOf("/other/pose"), id) << "the same channel has the same number";
}

TEST_F(FoxgloveTest, CallsByTheWholePathWhatHasNoNameOfItsOwn) {
  auto& group = runtime.Create<Group>(application, "group");
  runtime.Create<ProxyPort>(runtime.Create<Group>(group, "inner"), "x", Port::Direction::kOutput, TypeOf<double>());
  auto& first = runtime.Create<PortGroup>(group, "first");
  auto& second = runtime.Create<PortGroup>(group, "second");
  for (auto* ports : {&first, &second}) {
    runtime.Create<ProxyPort>(*ports, "x", Port::Direction::kOutput, TypeOf<double>());
  }
  ASSERT_TRUE(runtime.MakeReady(group));
  Begin();
  EXPECT_THAT(Channels(), Contains(Key("/group/inner/x")));
  EXPECT_THAT(channels, Contains(Key("/application/group/first/x")));
  EXPECT_THAT(channels, Contains(Key("/application/group/second/x")));
  EXPECT_THAT(channels, Not(Contains(Key("/group/x"))));
}

TEST_F(FoxgloveTest, SendsTheNewestValueAndThenEachNewOne) {
  Begin();
  robot.pose.Publish({1, 2, 3});
  Say(Subscribe(7, IdOf("/robot/pose")));
  Turn();
  const auto first = TakeValues();
  ASSERT_EQ(first.size(), 1u);
  EXPECT_EQ(first[0].subscription, 7u);
  EXPECT_EQ(first[0].timestamp, 1'000'000'000u);
  EXPECT_EQ(first[0].json, (Json{{"x", 1}, {"y", 2}, {"heading", 3}}));
  Turn();
  EXPECT_EQ(TakeValues().size(), 0u) << "nothing new";
  clock.Advance(std::chrono::milliseconds(250));
  robot.pose.Publish({4, 5, 6});
  Turn();
  const auto second = TakeValues();
  ASSERT_EQ(second.size(), 1u);
  EXPECT_EQ(second[0].timestamp, 1'250'000'000u);
  EXPECT_EQ(second[0].json["x"], 4);
}

TEST_F(FoxgloveTest, TellsWhenAValueWasPublishedAndInItWhenItWasMeasured) {
  Begin();
  robot.pose.Publish({1, 2, 3}, clock.Now() - std::chrono::milliseconds(400));
  Say(Subscribe(7, IdOf("/robot/pose/foxglove")));
  Turn();
  const auto values = TakeValues();
  ASSERT_EQ(values.size(), 1u);
  EXPECT_EQ(values[0].timestamp, 1'000'000'000u);
  EXPECT_EQ(values[0].json["timestamp"], (Json{{"sec", 0}, {"nsec", 600'000'000}}));
}

TEST_F(FoxgloveTest, SendsNoMoreThanAViewerCanShow) {
  Begin();
  Say(Subscribe(7, IdOf("/robot/speed")));
  session->OnPoll();
  TakeValues();
  const auto begin = std::chrono::steady_clock::now();
  int sent = 0;
  for (int i = 0; i < 2000; ++i) {
    robot.speed.Publish(i);
    session->OnPoll();
    sent += static_cast<int>(TakeValues().size());
  }
  const double seconds = ToSeconds(std::chrono::steady_clock::now() - begin);
  EXPECT_LE(sent, 2 + seconds * 60);
}

TEST_F(FoxgloveTest, SkipsValuesForAClientThatIsSlow) {
  Begin();
  Say(Subscribe(7, IdOf("/robot/speed")));
  client.waiting = 100 << 20;
  robot.speed.Publish(1);
  Turn();
  EXPECT_EQ(TakeValues().size(), 0u);
  robot.speed.Publish(2);
  client.waiting = 0;
  Turn();
  const auto values = TakeValues();
  ASSERT_EQ(values.size(), 1u);
  EXPECT_EQ(values[0].json["value"], 2);
}

TEST_F(FoxgloveTest, SendsAgainWhatWasNotTaken) {
  Begin();
  robot.speed.Publish(1);
  Say(Subscribe(7, IdOf("/robot/speed")));
  client.is_slow = true;
  Turn();
  client.is_slow = false;
  EXPECT_EQ(TakeValues().size(), 0u);
  Turn();
  EXPECT_EQ(TakeValues().size(), 1u);
}

TEST_F(FoxgloveTest, KeepsItsPromisesToASlowClientInOrder) {
  client.is_slow = true;
  Begin();
  Say({{"op", "getParameters"}, {"parameterNames", Json::array()}});
  for (int i = 0; i < 100000; ++i) SayRaw("no JSON");
  client.is_slow = false;
  ASSERT_TRUE(Wait([this] {
    return std::ranges::any_of(client.texts, [](const Json& each) { return each["op"] == "parameterValues"; });
  }));
  EXPECT_EQ(client.texts.at(0)["op"], "serverInfo");
  EXPECT_LE(Take("status").size(), 100u) << "complaints are not kept without end";
  EXPECT_THAT(Channels(), Contains(Key("/robot/pose")));
}

TEST_F(FoxgloveTest, EndsASubscription) {
  Begin();
  Say(Subscribe(7, IdOf("/robot/speed")));
  Say({{"op", "unsubscribe"}, {"subscriptionIds", {7}}});
  robot.speed.Publish(1);
  Turn();
  EXPECT_EQ(TakeValues().size(), 0u);
  EXPECT_EQ(Complaint(), "");
  Say({{"op", "unsubscribe"}, {"subscriptionIds", {7}}});
  EXPECT_EQ(Complaint(), "unsubscribe: there is no subscription 7");
}

TEST_F(FoxgloveTest, RefusesSubscriptionsThatCannotBe) {
  Begin();
  const std::uint32_t pose = IdOf("/robot/pose"), speed = IdOf("/robot/speed");
  Say(Subscribe(1, 12345));
  EXPECT_EQ(Complaint(), "subscribe: there is no channel 12345 (any more)");
  Say(Subscribe(1, pose));
  EXPECT_EQ(Complaint(), "");
  Say(Subscribe(1, speed));
  EXPECT_EQ(Complaint(), "subscribe: the id 1 is in use");
  Say(Subscribe(2, pose));
  EXPECT_EQ(Complaint(), "subscribe: /robot/pose is subscribed to already");
}

TEST_F(FoxgloveTest, LetsGoOfSubscriptionsWhoseModuleIsDeleted) {
  auto& other = runtime.Create<Robot>(application, "other");
  ASSERT_TRUE(runtime.MakeReady(other));
  Begin();
  other.pose.Publish({1, 2, 3});
  Say(Subscribe(7, IdOf("/other/pose")));
  Turn();
  EXPECT_EQ(TakeValues().size(), 1u);
  ASSERT_TRUE(runtime.Delete(other));
  session->OnPoll();
  Turn();
  EXPECT_EQ(TakeValues().size(), 0u);
  Say(Subscribe(7, IdOf("/robot/pose")));
  EXPECT_EQ(Complaint(), "") << "the number is free again";
}

// If it waited, this test would hang.
TEST_F(FoxgloveTest, NeverWaitsForTheStructure) {
  Begin();
  robot.speed.Publish(1);
  Say(Subscribe(7, IdOf("/robot/speed")));
  Say({{"op", "getParameters"}, {"parameterNames", {"/robot/gain"}}});
  {
    const HeldStructure held(runtime);
    for (int i = 0; i < 5; ++i) Turn();
    EXPECT_EQ(TakeValues().size(), 0u);
    EXPECT_THAT(Take("parameterValues"), IsEmpty());
  }
  EXPECT_TRUE(Wait([this] { return !Take("parameterValues").empty(); }));
  EXPECT_TRUE(Wait([this] { return TakeValues().size() == 1; }));
}

TEST_F(FoxgloveTest, TellsTheTimeWhenItMoves) {
  Begin();
  ASSERT_EQ(client.binaries.size(), 1u);
  EXPECT_EQ(client.binaries[0][0], 2);
  EXPECT_EQ(Number<8>(client.binaries[0], 1), 1'000'000'000u);
  client.binaries.clear();
  Turn();
  EXPECT_EQ(client.binaries.size(), 0u) << "it stands still";
  clock.Advance(std::chrono::seconds(1));
  Turn();
  ASSERT_EQ(client.binaries.size(), 1u);
  EXPECT_EQ(Number<8>(client.binaries[0], 1), 2'000'000'000u);
}

TEST_F(FoxgloveTest, ShowsWhoPublishesAndWhoReads) {
  auto& other = runtime.Create<Robot>(application, "other");
  ASSERT_TRUE(runtime.MakeReady(other));
  ASSERT_TRUE(Port::Connect(robot.speed, other.limit));
  Begin();
  Say({{"op", "subscribeConnectionGraph"}});
  const Json whole = Take("connectionGraphUpdate").at(0);
  EXPECT_EQ(whole["publishedTopics"].size(), 6u);
  EXPECT_THAT(whole["publishedTopics"],
              Contains(Json{{"name", "/robot/speed"}, {"publisherIds", {"/application/robot"}}}));
  EXPECT_THAT(whole["subscribedTopics"],
              Contains(Json{{"name", "/robot/speed"}, {"subscriberIds", {"/application/other"}}}));
  ASSERT_TRUE(Port::Disconnect(robot.speed, other.limit));
  Turn();
  const Json change = Take("connectionGraphUpdate").at(0);
  EXPECT_EQ(change["subscribedTopics"], (Json{{{"name", "/robot/speed"}, {"subscriberIds", Json::array()}}}));
  ASSERT_TRUE(runtime.Delete(other));
  Turn();
  EXPECT_EQ(Take("connectionGraphUpdate").at(0)["removedTopics"], (Json{"/other/pose", "/other/scan", "/other/speed"}));
  Say({{"op", "unsubscribeConnectionGraph"}});
  ASSERT_TRUE(Port::Connect(robot.speed, robot.limit));
  Turn();
  EXPECT_THAT(Take("connectionGraphUpdate"), IsEmpty());
}

}  // namespace
}  // namespace runnel::test
