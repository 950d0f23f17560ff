#include "tests/plugins/web_server/web_server_fixture.h"

namespace runnel::test {

namespace {

class WebSessions : public WebServerTest {};

TEST_F(WebSessions, SpeakTheFirstProtocolThatBothKnow) {
  Start();
  const auto agreed = [this](const std::string& offered) { return Client().Upgrade(offered); };
  EXPECT_THAT(agreed("echo.v1"), HasSubstr("Sec-WebSocket-Protocol: echo.v1\r\n"));
  EXPECT_THAT(agreed("other, echo.v2, echo.v1"), HasSubstr("Sec-WebSocket-Protocol: echo.v2\r\n"));
  EXPECT_THAT(agreed("echo.v2,echo.v1"), HasSubstr("Sec-WebSocket-Protocol: echo.v2\r\n"));
}

TEST_F(WebSessions, DoNotBeginWithoutAProtocolThatIsKnown) {
  Start();
  RawClient stranger = Client();
  EXPECT_THAT(stranger.Upgrade("other, echo.v"), StartsWith("HTTP/1.1 400 "));
  EXPECT_THAT(stranger.Read(), HasSubstr("there is echo.v1, echo.v2"));
  RawClient silent = Client();
  EXPECT_THAT(silent.Upgrade(""), StartsWith("HTTP/1.1 400 "));
  EXPECT_THAT(silent.Read(), HasSubstr("no protocol is asked for"));
  EXPECT_EQ(met.begun, 0);
}

TEST_F(WebSessions, CarryTextAndBytes) {
  Start();
  RawClient client = Talker();
  client.SendText("grüß dich");
  const auto text = client.Receive();
  ASSERT_TRUE(text);
  EXPECT_EQ(text->operation, 1);
  EXPECT_EQ(text->payload, "grüß dich");
  const std::string bytes("\x00\xff\xfe", 3);
  client.Send(RawClient::Frame(2, bytes));
  const auto binary = client.Receive();
  ASSERT_TRUE(binary);
  EXPECT_EQ(binary->operation, 2);
  EXPECT_EQ(binary->payload, bytes);
}

TEST_F(WebSessions, PutMessagesTogetherThatComeInParts) {
  Start();
  RawClient client = Talker();
  client.Send(RawClient::Frame(1, "one ", false));
  client.Send(RawClient::Frame(9, "ping in between"));
  client.Send(RawClient::Frame(0, "two", true));
  const auto pong = client.Receive();
  ASSERT_TRUE(pong);
  EXPECT_EQ(pong->operation, 10);
  const auto text = client.Receive();
  ASSERT_TRUE(text);
  EXPECT_EQ(text->payload, "one two");
}

TEST_F(WebSessions, EndByWhateverTheyThrowAndOthersGoOn) {
  Start();
  RawClient other = Talker();
  RawClient client = Talker();
  client.SendText("throw a number");
  const auto closing = client.Receive(8);
  ASSERT_TRUE(closing);
  EXPECT_EQ(closing->reason(), "exception of type int");
  other.SendText("still there");
  EXPECT_EQ(other.Receive().value().payload, "still there");
}

TEST_F(WebSessions, ArePolledWhenAnotherThreadWakesThem) {
  Start();
  RawClient client = Talker();
  client.SendText("keep the waker");
  EXPECT_TRUE(client.Receive());
  const int before = met.turns;  // the next one would come in an hour
  met.WakeAll();
  WaitUntil("a session that is woken has a turn", [&] { return met.turns > before; });
}

TEST_F(WebSessions, AreWokenInVainWhenTheyHaveGoneOrTheServerHas) {
  Start();
  {
    RawClient gone = Talker();
    gone.SendText("keep the waker");
    EXPECT_TRUE(gone.Receive());
  }
  WaitUntil("the session has ended", [&] { return met.ended == 1; });
  met.WakeAll();
  RawClient client = Talker();
  client.SendText("keep the waker");
  EXPECT_TRUE(client.Receive());
  std::atomic<bool> is_over{false};
  std::thread waking([&] {
    while (!is_over) met.WakeAll();
  });
  server.reset();
  is_over = true;
  waking.join();
  met.WakeAll();
}

TEST_F(WebSessions, CarryLargeMessages) {
  Start();
  RawClient client = Talker();
  const std::string large(1 << 20, 'x');  // what is allowed, exactly
  client.SendText(large);
  const auto answer = client.Receive();
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->payload, large);
}

TEST_F(WebSessions, EndWhenTheClientGoes) {
  Start();
  {
    RawClient client = Talker();
    EXPECT_TRUE(Eventually([&] { return met.begun == 1; }));
    EXPECT_EQ(server->clients(), 1U);
  }
  EXPECT_TRUE(Eventually([&] { return met.ended == 1; }));
  EXPECT_TRUE(Eventually([&] { return server->clients() == 0; }));
}

TEST_F(WebSessions, EndInOrderWhenTheClientSaysSo) {
  Start();
  RawClient client = Talker();
  client.Send(RawClient::Frame(8, std::string("\x03\xe8", 2)));
  const auto closing = client.Receive(8);
  ASSERT_TRUE(closing);
  EXPECT_EQ(closing->code(), 1000);
  EXPECT_TRUE(client.IsClosed());
  EXPECT_TRUE(Eventually([&] { return met.ended == 1; }));
}

TEST_F(WebSessions, CanEndThemselvesAndSayWhy) {
  Start();
  RawClient client = Talker();
  client.SendText("close");
  const auto closing = client.Receive(8);
  ASSERT_TRUE(closing);
  EXPECT_EQ(closing->code(), 1008);
  EXPECT_EQ(closing->reason(), "as you wish");
  client.Send(RawClient::Frame(8, closing->payload));
  EXPECT_TRUE(client.IsClosed());
  ExpectThatOthersAreServed();
}

TEST_F(WebSessions, OneThatThrowsEndsAloneAndTellsItsClient) {
  Start();
  RawClient other = Talker();
  RawClient client = Talker();
  client.SendText("throw");
  const auto closing = client.Receive(8);
  ASSERT_TRUE(closing);
  EXPECT_EQ(closing->code(), 1011);
  EXPECT_EQ(closing->reason(), "the session has thrown");
  other.SendText("still here");
  const auto answer = other.Receive();
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->payload, "still here");
}

TEST_F(WebSessions, ArePolledAtTheStartAndAfterMessages) {
  Start();
  RawClient client = Talker();
  EXPECT_TRUE(Eventually([&] { return met.turns == 1; }));
  client.SendText("hello");
  EXPECT_TRUE(Eventually([&] { return met.turns == 2; }));
}

TEST_F(WebSessions, ArePolledWhenTheyAreDue) {
  Start();
  RawClient client = Talker();
  client.SendText("soon");
  EXPECT_TRUE(Eventually([&] { return met.turns > 20; }));
  ExpectThatOthersAreServed();
}

TEST_F(WebSessions, AreToldWhenTheServerEnds) {
  Start();
  RawClient client = Talker();
  EXPECT_TRUE(Eventually([&] { return met.begun == 1; }));
  std::thread end([this] { server.reset(); });
  const auto closing = client.Receive(8);
  client.Send(RawClient::Frame(8, closing ? closing->payload : ""));
  end.join();
  ASSERT_TRUE(closing);
  EXPECT_EQ(closing->code(), 1001);
  EXPECT_EQ(closing->reason(), "the application has ended");
  EXPECT_EQ(met.ended, 1);
}

TEST_F(WebSessions, AreNotBegunByPagesOfOthers) {
  Start({.origins = {"https://app.example.org"}});
  EXPECT_THAT(Client().Upgrade("echo.v1", "Origin: http://evil.example\r\n"), StartsWith("HTTP/1.1 403 "));
  EXPECT_THAT(Client().Upgrade("echo.v1", "Origin: null\r\n"), StartsWith("HTTP/1.1 403 "));
  EXPECT_THAT(Client().Upgrade("echo.v1", "Origin: http://" + Client().host() + "\r\n"), StartsWith("HTTP/1.1 101 "));
  EXPECT_THAT(Client().Upgrade("echo.v1", "Origin: https://app.example.org\r\n"), StartsWith("HTTP/1.1 101 "));
  EXPECT_THAT(Client().Upgrade("echo.v1", "Origin: https://app.example.org\r\nOrigin: http://evil.example\r\n"),
              StartsWith("HTTP/1.1 400 "));
}

TEST_F(WebSessions, NeedTheToken) {
  Start({.tokens = {{WebRole::kChange, "open-sesame"}}});
  EXPECT_THAT(Client().Upgrade("echo.v1"), StartsWith("HTTP/1.1 401 "));
  EXPECT_THAT(Client().Upgrade("echo.v1", "", "/?token=wrong-sesame"), StartsWith("HTTP/1.1 401 "));
  EXPECT_THAT(Client().Upgrade("echo.v1", "", "/?token=open-sesame"), StartsWith("HTTP/1.1 101 "));
}

TEST_F(WebSessions, TakeTheTokenAmongTheProtocolsAndDoNotRepeatIt) {
  Start({.tokens = {{WebRole::kLook, "just-look-7"}}});
  RawClient client = Client();
  const std::string answer = client.Upgrade("echo.v1, runnel.token.just-look-7");
  EXPECT_THAT(answer, StartsWith("HTTP/1.1 101 "));
  EXPECT_THAT(answer, Not(HasSubstr("just-look-7")));
  client.SendText("role");
  EXPECT_EQ(client.Receive().value().payload, "look");
}

TEST_F(WebSessions, ThatMayDoMoreFindAPlace) {
  Start({.tokens = {{WebRole::kChange, "open-sesame"}, {WebRole::kLook, "just-look-7"}}, .limits = {.clients = 2}});
  std::vector<RawClient> lookers;
  for (int i = 0; i < 2; ++i) {
    lookers.push_back(Client());
    EXPECT_THAT(lookers.back().Upgrade("echo.v1", "", "/?token=just-look-7"), HasSubstr("101 "));
  }
  EXPECT_THAT(Client().Upgrade("echo.v1", "", "/?token=just-look-7"), StartsWith("HTTP/1.1 503 "));
  RawClient owner = Client();
  EXPECT_THAT(owner.Upgrade("echo.v1", "", "/?token=open-sesame"), StartsWith("HTTP/1.1 101 "));
  const auto closing = lookers[0].Receive(8);
  ASSERT_TRUE(closing);
  EXPECT_EQ(closing->reason(), "somebody who may do more needs the place");
  owner.SendText("there");
  EXPECT_EQ(owner.Receive().value().payload, "there");
  lookers[1].SendText("the other one stays");
  EXPECT_TRUE(lookers[1].Receive(1));
}

TEST_F(WebSessions, WhosePlacesAreKeptMakeRoomForNoOthers) {
  Start({.tokens = {{WebRole::kChange, "open-sesame"}, {WebRole::kLook, "just-look-7"}}, .limits = {.clients = 1}});
  const auto connect = [this](const char* protocol, const char* token) {
    RawClient client = Client();
    const std::string answer = client.Upgrade(protocol, "", std::string("/?token=") + token);
    return std::pair(std::move(client), answer);
  };
  auto [kept, answer] = connect("echo.kept", "just-look-7");
  EXPECT_THAT(answer, HasSubstr("101 "));
  auto [other, other_answer] = connect("echo.v1", "just-look-7");
  EXPECT_THAT(other_answer, HasSubstr("101 "));
  EXPECT_THAT(connect("echo.kept", "just-look-7").second, HasSubstr("503 ")) << "they have a limit, too";
  EXPECT_THAT(connect("echo.v1", "open-sesame").second, HasSubstr("101 "));
  EXPECT_EQ(other.Receive(8).value().reason(), "somebody who may do more needs the place");
  kept.SendText("still there");
  EXPECT_EQ(kept.Receive(1).value().payload, "still there");
}

TEST_F(WebSessions, AreLimitedInNumber) {
  Start({.limits = {.clients = 2}});
  RawClient first = Talker();
  {
    RawClient second = Talker();
    RawClient third = Client();
    EXPECT_THAT(third.Upgrade("echo.v1"), StartsWith("HTTP/1.1 503 "));
    EXPECT_THAT(third.Read(), HasSubstr("2 clients already"));
  }
  EXPECT_TRUE(Eventually([&] { return server->clients() == 1; }));
  ExpectThatOthersAreServed();
}

}  // namespace

}  // namespace runnel::test
