#include <random>
#include <thread>

#include "tests/plugins/inspector/inspector_fixture.h"
#include "tests/support/wait_until.h"

namespace runnel::test {

namespace {

// JSON says each line end by two characters.
const std::string kLargePanel = R"({"panel": 1, "widgets": []})" + std::string(250'000, '\n');

class HostileViewer : public RunningInspectorTest {
 protected:
  /// That cycles run, and viewers are served.
  void ExpectThatAllIsWell() {
    const auto cycles = [this] { return scheduler.ProgressOf("/app/a")->cycles; };
    const std::uint64_t before = cycles();
    WaitUntil("20 more cycles have run", [&] { return cycles() >= before + 20; });
    Viewer viewer = View();
    viewer.Send({{"op", "watch"}, {"path", "/app/a/output/out"}});
    EXPECT_GT(viewer.Value("/app/a/output/out")["value"], 0);
  }
};

TEST_F(HostileViewer, IsAnsweredWithTheNumberOfItsRequestWhateverIsWrong) {
  bool has_saved = false;
  hooks.save = [&](const std::string&) -> Result<std::string> {
    has_saved = true;
    return std::string("saved");
  };
  Start();
  Viewer viewer = View();
  const auto refused = [&](Json message) { return viewer.Ask(std::move(message))["errors"][0]["message"]; };
  EXPECT_THAT(refused({{"op", "publish"}, {"path", "/app/a/output/out"}, {"value", "7"}, {"rate", -5}}),
              HasSubstr("\"rate\" must be a number, not below 0"));
  EXPECT_THAT(refused({{"op", "speed"}, {"speed", -1}}), HasSubstr("\"speed\" must be"));
  EXPECT_THAT(refused({{"op", "profile"}, {"on", "no"}}), HasSubstr("\"on\" must be true or false"));
  EXPECT_THAT(refused({{"op", "save"}, {"overwrite", 1}}), HasSubstr("must be true or false"));
  EXPECT_THAT(refused({{"op", 7}}), HasSubstr("must be a text"));
  EXPECT_THAT(refused({{"path", "/"}}), HasSubstr("no \"op\""));
  EXPECT_THAT(refused({{"op", "safe"}}), HasSubstr("no operation 'safe'"));
  EXPECT_FALSE(has_saved);
}

// Each of these was carried out as if the wrong word had not been there: the file was overwritten, all of it paused.
TEST_F(HostileViewer, SaysNothingThatItsOperationDoesNotHave) {
  bool has_saved = false;
  hooks.save = [&](const std::string&) -> Result<std::string> {
    has_saved = true;
    return std::string("saved");
  };
  Start();
  Viewer viewer = View();
  const auto refused = [&](Json message) {
    const Json error = viewer.Ask(std::move(message))["errors"][0];
    return error["message"].get<std::string>() +
           (error["hint"].is_null() ? "" : "; " + error["hint"].get<std::string>());
  };
  EXPECT_EQ(refused({{"op", "save"}, {"fiel", "other.xml"}}), "'save' has no \"fiel\"; did you mean 'file'?");
  EXPECT_THAT(refused({{"op", "save"}, {"what", "config"}}),
              HasSubstr("\"what\" is 'configuration' or left out, not 'config'"));
  EXPECT_THAT(refused({{"op", "save"}, {"path", "/app/a"}}), HasSubstr("'save' has no \"path\""));
  EXPECT_THAT(refused({{"op", "pause"}, {"Path", "/app/a"}}), HasSubstr("did you mean 'path'?"));
  EXPECT_THAT(refused({{"op", "publish"}, {"path", "/app/a/out"}, {"value", "7"}, {"dedline", 1}}),
              HasSubstr("did you mean 'deadline'?"));
  EXPECT_THAT(refused({{"op", "arrange"}, {"entries", {{"note /app/a", 5}}}}),
              HasSubstr("'note /app/a' must be a text"));
  EXPECT_THAT(refused({{"op", "watch"}, {"path", "/app/a/out"}, {"as", "picture"}}),
              HasSubstr("\"as\" is 'image' or left out"));
  EXPECT_FALSE(has_saved);
  ExpectThatAllIsWell();
}

TEST_F(HostileViewer, PressesStopWhateverElseItSays) {
  Start();
  Viewer viewer = View();
  EXPECT_EQ(viewer.Ask({{"op", "stop"}, {"why", "smoke"}})["ok"], true);
  EXPECT_TRUE(runtime.robot_stop().in_force());
}

TEST_F(HostileViewer, OfAnApplicationThatStandsStillASignOfLifeComesAllTheSame) {
  Start();
  Viewer viewer = View();
  for (int i = 0; i < 2; ++i) EXPECT_EQ(viewer.Next("alive")["op"], "alive");
}

TEST_F(HostileViewer, WhatIsNoMessageIsAnsweredAndDoesNothing) {
  Start();
  Viewer viewer = View();
  for (const char* text : {"", "hello", "[]", "{\"op\":7}", "{\"op\":\"nothing\",\"request\":1}"}) {
    viewer.raw().SendText(text);
    const Json reply = viewer.Next("reply");
    EXPECT_EQ(reply["ok"], false) << text;
    EXPECT_NE(reply["errors"][0]["message"], "") << text;
  }
  viewer.raw().SendText(R"({"op":"wacth","request":3})");
  const Json reply = viewer.Next("reply");
  EXPECT_EQ(reply["request"], 3);
  EXPECT_EQ(reply["errors"][0]["hint"], "did you mean 'watch'?");
  ExpectThatAllIsWell();
}

TEST_F(HostileViewer, BytesEndTheSession) {
  Start();
  Viewer viewer = View();
  viewer.raw().Send(RawClient::Frame(2, "bytes"));
  const auto closing = viewer.raw().Receive(8);
  ASSERT_TRUE(closing);
  EXPECT_THAT(closing->reason(), HasSubstr("text"));
  ExpectThatAllIsWell();
}

TEST_F(HostileViewer, WatchesAreLimited) {
  Start({}, {.limits = {.messages_per_second = 100'000}});
  Viewer viewer = View();
  for (int i = 0; i < 500; ++i) {
    viewer.Send({{"op", "watch"}, {"path", "/app/" + std::to_string(i)}, {"request", i}});
  }
  viewer.Send({{"op", "watch"}, {"path", "/app/one/more"}, {"request", 1000}});
  const Json reply = viewer.Next("reply");
  EXPECT_EQ(reply["request"], 1000);
  EXPECT_THAT(reply["errors"][0]["message"], HasSubstr("500"));
  ExpectThatAllIsWell();
}

TEST_F(HostileViewer, RequestsUnderWayAreLimited) {
  const auto may_go_on = std::make_shared<std::atomic<bool>>(false);  // those that wait still are done after the test
  hooks.save = [may_go_on](const std::string&) -> Result<std::string> {
    WaitUntil("the saving may go on", [&] { return may_go_on->load(); });
    return std::string("saved");
  };
  Start({}, {.limits = {.messages_per_second = 100'000}});
  Viewer viewer = View();
  viewer.Next("catalogue");
  for (int i = 0; i < 200; ++i) viewer.Send({{"op", "save"}, {"request", i}});
  const Json refused = viewer.Next("reply");
  EXPECT_EQ(refused["ok"], false);
  EXPECT_THAT(refused["errors"][0]["message"], HasSubstr("too many requests"));
  *may_go_on = true;
  ExpectThatAllIsWell();
}

TEST_F(HostileViewer, OneThatDoesNotReadMissesValuesAndIsLetGo) {
  Start({}, {.limits = {.waiting_bytes = 4'000'000, .idle_time = 1s}});
  Apply("create /app/lists test/lists");
  Viewer viewer = View();
  for (int i = 0; i < 400; ++i) {
    viewer.Send({{"op", "watch"}, {"path", "/app/lists/output/list"}, {"rate", 60}, {"elements", 1000}});
  }
  WaitUntil("the client that does not read is gone", [&] { return server->clients() == 0; });
  ExpectThatAllIsWell();
}

// Refusals of who may do nothing else: there is no end of what can be refused.
TEST_F(HostileViewer, OneThatReadsNoRefusalsIsLetGo) {
  Start({}, {.limits = {.messages_per_second = 1e9, .waiting_bytes = 100'000, .idle_time = 1h}});
  const Viewer viewer = View();
  const Json wrong{{"op", "watch"}, {"path", "/app/a"}, {"as", std::string(4000, 'x')}};  // a reply of as much
  WaitUntil("the client that does not read is gone", [&] {
    viewer.Send(wrong);
    return server->clients() == 0;
  });
  ExpectThatAllIsWell();
}

TEST_F(HostileViewer, OneThatReadsNoLargeRepliesIsLetGoThoughFewWait) {
  Start({}, {.limits = {.messages_per_second = 100'000, .waiting_bytes = 100'000, .idle_time = 1h}});
  Viewer viewer = View();
  EXPECT_EQ(viewer.Ask({{"op", "save_panel"}, {"value", kLargePanel}})["ok"], true);
  for (int i = 0; i < 50; ++i) viewer.Send({{"op", "panel"}});
  WaitUntil("the client that does not read is gone", [&] { return server->clients() == 0; });
  ExpectThatAllIsWell();
}

TEST_F(HostileViewer, OneReplyMayBeLargerThanWhatMayWait) {
  Start({}, {.limits = {.waiting_bytes = 1000}});
  Viewer viewer = View();
  EXPECT_EQ(viewer.Ask({{"op", "save_panel"}, {"value", kLargePanel}})["ok"], true);
  EXPECT_EQ(viewer.Ask({{"op", "panel"}})["text"], kLargePanel);
}

TEST_F(HostileViewer, WhatIsRepeatedOfItsMessagesIsCut) {
  Start({}, {.limits = {.messages_per_second = 100'000}});
  Viewer viewer = View();
  const std::string much(1'000'000, 'x');
  for (const Json& message :
       {Json{{"op", much}}, Json{{"op", "save"}, {much, 1}}, Json{{"op", much}, {"rate", "x"}},
        Json{{"op", "watch"}, {"path", "/app/a"}, {"as", much}}, Json{{"op", "pause"}, {"path", much}},
        Json{{"op", "arrange"}, {"entries", {{much, 5}}}}, Json{{"op", "reload"}, {"plugin", much}}}) {
    const Json reply = viewer.Ask(message);
    EXPECT_EQ(reply["ok"], false);
    EXPECT_LT(reply.dump().size(), 30'000U) << message.dump().substr(0, 60);
  }
}

TEST_F(HostileViewer, RandomMessagesDoNoHarm) {
  hooks.save = [](const std::string&) -> Result<std::string> { return std::string("saved"); };
  Start({}, {.limits = {.messages_per_second = 100'000}});
  Viewer viewer = View();
  std::mt19937 random(3);
  const auto any = [&](const std::vector<Json>& of) {
    return of[std::uniform_int_distribution<std::size_t>(0, of.size() - 1)(random)];
  };
  const std::vector<Json> values{nullptr,
                                 true,
                                 -1,
                                 0,
                                 1,
                                 1e18,
                                 "",
                                 "/app/a",
                                 "/app/a/output/out",
                                 "/",
                                 "//",
                                 "/../..",
                                 "test/sink",
                                 "\n\t\"",
                                 Json::array(),
                                 Json({"set /app/a/speed 2"}),
                                 Json({"delete /app/zzz"}),
                                 Json({1, 2}),
                                 Json::object()};
  const std::vector<Json> members{"path",  "rate", "changes", "elements", "cycles",
                                  "speed", "file", "plugin",  "request",  "label"};
  const std::vector<Json> ops{"watch", "unwatch", "watch_rates", "change", "undo",  "redo",   "compatible",
                              "save",  "pause",   "resume",      "step",   "speed", "reload", "x"};
  for (int i = 0; i < 2000; ++i) {
    Json message{{"op", any(ops)}};
    for (int j = 0; j < 3; ++j) message[any(members).get<std::string>()] = any(values);
    viewer.Send(message);
    if (i % 50 == 0) viewer.Ask({{"op", "compatible"}, {"path", "/app/a"}});  // reads what has come
  }
  ExpectThatAllIsWell();
  Viewer late = View();
  EXPECT_EQ(late.Element("/app/b")["type"], "test/sink");
}

}  // namespace

}  // namespace runnel::test
