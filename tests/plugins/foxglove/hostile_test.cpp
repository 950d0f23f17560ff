#include <random>

#include "tests/plugins/foxglove/foxglove_fixture.h"

namespace runnel::test {
namespace {

using FoxgloveHostileTest = FoxgloveTest;

TEST_F(FoxgloveHostileTest, EveryMistakeIsNamed) {
  Begin();
  const auto complaint_of = [this](std::string_view text) {
    SayRaw(text);
    return Complaint();
  };
  EXPECT_EQ(complaint_of(""), "this message is no JSON");
  EXPECT_EQ(complaint_of("{\"op\":"), "this message is no JSON");
  EXPECT_EQ(complaint_of(std::string(900'000, '[')), "this message is no JSON");
  for (const char* text : {"[]", "5", "null", "{}", R"({"op":5})", R"({"op":null})"}) {
    EXPECT_EQ(complaint_of(text), "a message is a JSON object with an \"op\"") << text;
  }
  EXPECT_EQ(complaint_of(R"({"op":"subcribe"})"), "there is no operation 'subcribe' here; did you mean 'subscribe'?");
  EXPECT_THAT(complaint_of(R"({"op":"fetchAsset","uri":"file:///etc/passwd","requestId":1})"),
              HasSubstr("there is no operation 'fetchAsset' here"));
  EXPECT_EQ(complaint_of(R"({"op":"subscribe"})"), "subscribe: \"subscriptions\" is missing");
  EXPECT_EQ(complaint_of(R"({"op":"subscribe","subscriptions":5})"), "subscribe: \"subscriptions\" must be a list");
  EXPECT_EQ(complaint_of(R"({"op":"subscribe","subscriptions":[5]})"), "subscribe: \"id\" is missing");
  for (const char* id : {"-1", "1.5", "4294967296", "\"1\"", "[]", "1e2"}) {
    EXPECT_EQ(complaint_of(R"({"op":"subscribe","subscriptions":[{"id":)" + std::string(id) + R"(,"channelId":1}]})"),
              "subscribe: \"id\" must be a count, at most 4294967295")
        << id;
  }
  EXPECT_EQ(complaint_of(R"({"op":"unsubscribe","subscriptionIds":["a"]})"),
            "unsubscribe: \"subscriptionIds\" must be a list of ids");
  EXPECT_EQ(complaint_of(R"({"op":"advertise","channels":[{"id":1,"topic":5}]})"),
            "advertise: \"topic\" must be a text");
  EXPECT_EQ(complaint_of(R"({"op":"getParameters","parameterNames":[5]})"),
            "getParameters: \"parameterNames\" must be a list of texts");
  EXPECT_EQ(complaint_of(R"({"op":"setParameters","parameters":[{"value":5}]})"), "setParameters: \"name\" is missing");
  EXPECT_EQ(complaint_of(R"({"op":"setParameters","parameters":["a"]})"), "setParameters: \"name\" is missing");
  EXPECT_EQ(complaint_of(R"({"op":"setParameters","parameters":[],"Id":"7"})"),
            "setParameters: has no \"Id\"; did you mean 'id'?");
  EXPECT_EQ(complaint_of(R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":1,"rate":5}]})"),
            "subscribe: has no \"rate\"");
}

TEST_F(FoxgloveHostileTest, BinaryGarbageIsRefused) {
  Begin();
  for (const std::string& bytes : {std::string(), std::string("\x01"), std::string("\x01\x00\x00\x00", 4),
                                   std::string("\x05\x00\x00\x00\x00", 5), std::string(100, '\xff')}) {
    session->OnBinary(bytes);
    EXPECT_THAT(Complaint(), HasSubstr("no binary message of this kind"));
  }
  session->OnBinary(std::string("\x01\xff\xff\xff\xff{}", 7));
  EXPECT_EQ(Complaint(), "channel 4294967295 is not advertised");
}

// Looking for the nearest of many names takes time that all clients would wait.
TEST_F(FoxgloveHostileTest, ManyWrongNamesInOneMessageAreNotAllSearchedFor) {
  Begin();
  Json names = Json::array(), channels_ = Json::array(), settings = Json::array();
  for (std::uint32_t i = 0; i < 50; ++i) {
    names.push_back("/robot/gian" + std::to_string(i));
    channels_.push_back({{"id", i}, {"topic", "/robot/gaol"}, {"encoding", "json"}});
    settings.push_back({{"name", "/robot/gian"}, {"value", 1}});
  }
  const auto count_hints = [this](const Json& message) {
    Say(message);
    std::size_t complaints = 0;
    int hints = 0;
    EXPECT_TRUE(Wait([&] {
      for (const Json& status : Take("status")) {
        ++complaints;
        if (status["message"].get<std::string>().find("did you mean") != std::string::npos) ++hints;
      }
      return complaints == 50;
    }));
    return hints;
  };
  EXPECT_EQ(count_hints({{"op", "getParameters"}, {"parameterNames", names}}), 1);
  EXPECT_EQ(count_hints({{"op", "subscribeParameterUpdates"}, {"parameterNames", names}}), 1);
  EXPECT_EQ(count_hints({{"op", "advertise"}, {"channels", channels_}}), 1);
  EXPECT_EQ(count_hints({{"op", "setParameters"}, {"parameters", settings}}), 1);
  for (int i = 0; i < 1000; ++i) settings.push_back(settings[0]);
  Say({{"op", "setParameters"}, {"parameters", settings}});
  EXPECT_EQ(Complaint(), "setParameters: more than 1000 parameters at once");
}

// Whatever comes, the session goes on, and the application is as it was.
TEST_F(FoxgloveHostileTest, GoesOnWhateverComes) {
  Begin(/*is_read_only=*/true);
  const std::vector<std::string> sensible = {
      R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":2},{"id":2,"channelId":3}]})",
      R"({"op":"unsubscribe","subscriptionIds":[1,2]})",
      R"({"op":"advertise","channels":[{"id":1,"topic":"/robot/goal","encoding":"json"}]})",
      R"({"op":"unadvertise","channelIds":[1]})",
      R"({"op":"getParameters","parameterNames":["/robot/gain"],"id":"a"})",
      R"({"op":"setParameters","parameters":[{"name":"/robot/gain","value":1.5}]})",
      R"({"op":"subscribeParameterUpdates","parameterNames":[]})",
      R"({"op":"subscribeConnectionGraph"})"};
  std::mt19937 random(3);
  for (int i = 0; i < 20000; ++i) {
    std::string text = sensible[random() % sensible.size()];
    for (auto change = random() % 4; change > 0; --change) {
      const std::size_t at = random() % text.size();
      if (random() % 2 == 0) {
        text[at] = static_cast<char>(32 + random() % 95);
      } else {
        text.erase(at, 1 + random() % 5);
      }
      if (text.empty()) text = " ";
    }
    if (random() % 8 == 0) {
      session->OnBinary(text);
    } else {
      session->OnText(text);
    }
    if (i % 100 == 0) session->OnPoll();
    client.texts.clear();
    client.binaries.clear();
  }
  EXPECT_EQ(robot.gain.Get(), 0.5);
  EXPECT_EQ(client.closed, "");
  Say({{"op", "getParameters"}, {"parameterNames", {"/robot/gain"}}, {"id", "last"}});
  EXPECT_TRUE(Wait([this] {
    return std::ranges::any_of(Take("parameterValues"),
                               [](const Json& each) { return each.value("id", "") == "last"; });
  }));
}

}  // namespace
}  // namespace runnel::test
