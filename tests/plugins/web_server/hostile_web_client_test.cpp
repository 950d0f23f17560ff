#include <cstdlib>
#include <random>

#include "tests/plugins/web_server/web_server_fixture.h"

namespace runnel::test {

namespace {

class HostileWebClient : public WebServerTest {};

constexpr WebLimits kImpatient{.request_time = 200ms, .idle_time = 400ms};

TEST_F(HostileWebClient, WhoSaysNothingIsLetGo) {
  Start({.limits = kImpatient});
  RawClient client = Client();
  EXPECT_TRUE(client.IsClosed());
}

TEST_F(HostileWebClient, WhoSpeaksVerySlowlyIsLetGo) {
  Start({.limits = kImpatient});
  RawClient client = Client();
  client.Send("GET / HTTP/1.1\r\nHost: localhost\r\n");
  // A letter each 20 ms: each comes in time, but the whole does not.
  WaitUntil("it is let go", [&] {
    std::this_thread::sleep_for(20ms);
    return !client.Send("x");
  });
}

TEST_F(HostileWebClient, WhoClosesHalfOfItIsAnsweredAndLetGo) {
  Start();
  RawClient client = Client();
  client.Send("GET / HTTP/1.1\r\nHost: localhost\r\n\r\n");
  client.CloseSending();
  EXPECT_THAT(client.Read(), HasSubstr("<p>page</p>"));
  RawClient early = Client();
  early.Send("GET / HT");
  early.CloseSending();
  EXPECT_TRUE(early.IsClosed());
}

TEST_F(HostileWebClient, ManyThatSayNothingKeepNobodyOut) {
  Start({.limits = {.visitors = 8}});
  std::vector<RawClient> silent;
  for (int i = 0; i < 100; ++i) silent.push_back(Client());
  ExpectThatOthersAreServed();
  EXPECT_TRUE(silent.front().IsClosed());  // it has made room
}

TEST_F(HostileWebClient, LongHeadersAreRefused) {
  Start();
  RawClient client = Client();
  client.Send("GET / HTTP/1.1\r\nHost: localhost\r\nX: " + std::string(9'000, 'x') + "\r\n\r\n");
  EXPECT_THAT(client.Read(), StartsWith("HTTP/1.1 431 "));
  RawClient target = Client();
  target.Send("GET /" + std::string(9'000, 'x') + " HTTP/1.1\r\nHost: localhost\r\n\r\n");
  EXPECT_THAT(target.Read(), StartsWith("HTTP/1.1 431 "));
  RawClient endless = Client();
  const std::string piece(10'000, 'x');
  int pieces = 0;
  while (pieces < 10'000 && endless.Send(piece)) ++pieces;
  EXPECT_LT(pieces, 10'000);
  ExpectThatOthersAreServed();
}

TEST_F(HostileWebClient, BodiesAreRefused) {
  Start();
  for (const std::string body : {"Content-Length: 4\r\n\r\nbody", "Content-Length: 99999999999\r\n\r\n",
                                 "Transfer-Encoding: chunked\r\n\r\n4\r\nbody\r\n0\r\n\r\n"}) {
    RawClient client = Client();
    client.Send("POST / HTTP/1.1\r\nHost: localhost\r\n" + body);
    const std::string answer = client.Read();
    EXPECT_THAT(answer, ::testing::AnyOf(StartsWith("HTTP/1.1 413 "), StartsWith("HTTP/1.1 400 ")));
    EXPECT_THAT(answer, Not(HasSubstr("<p>page</p>")));
  }
}

TEST_F(HostileWebClient, WhatIsNoRequestIsRefused) {
  Start();
  for (const std::string request :
       {"\r\n\r\nGET / HTTP/9.9\r\n\r\n", "GET\r\n\r\n", "\x16\x03\x01\x02garbage\r\n\r\n",
        "GET / HTTP/1.1\r\nHost: localhost\r\nContent-Length: -1\r\n\r\n", "GET / HTTP/1.1\r\n: no name\r\n\r\n",
        "GET / HTTP/1.1\r\nHost: a\r\nHost: localhost\r\n\r\n"}) {
    RawClient client = Client();
    client.Send(request);
    EXPECT_THAT(client.Read(), StartsWith("HTTP/1.1 400 ")) << request;
  }
  RawClient nameless = Client();
  nameless.Send("GET / HTTP/1.1\r\n\r\n");
  EXPECT_THAT(nameless.Read(), StartsWith("HTTP/1.1 400 "));
}

struct BadFrame {
  const char* what;
  std::string bytes;
  int code;
};

TEST_F(HostileWebClient, FramesThatAreNoneEndTheSession) {
  Start();
  const std::string unmasked("\x81\x02hi", 4);
  const std::vector<BadFrame> frames{
      {"not masked", unmasked, 1002},
      {"reserved bits", "\xf1" + RawClient::Frame(1, "hi").substr(1), 1002},
      {"no such operation", RawClient::Frame(3, "hi"), 1002},
      {"a ping in parts", RawClient::Frame(9, "hi", false), 1002},
      {"a long ping", RawClient::Frame(9, std::string(126, 'x')), 1002},
      {"goes on with nothing", RawClient::Frame(0, "hi"), 1002},
      {"begins anew in the middle", RawClient::Frame(1, "a", false) + RawClient::Frame(1, "b"), 1002},
      {"a closing of one byte", RawClient::Frame(8, "x"), 1002},
      {"no UTF-8", RawClient::Frame(1, "\xc3\x28"), 1007},
      {"half a letter", RawClient::Frame(1, "\xe2\x82"), 1007},
      {"half of a pair", RawClient::Frame(1, "\xed\xa0\x80"), 1007},
  };
  for (const BadFrame& frame : frames) {
    RawClient client = Talker();
    client.Send(frame.bytes);
    const auto closing = client.Receive(8);
    ASSERT_TRUE(closing) << frame.what;
    EXPECT_EQ(closing->code(), frame.code) << frame.what;
    EXPECT_TRUE(client.IsClosed()) << frame.what;
  }
  EXPECT_EQ(met.messages, 0);
  ExpectThatOthersAreServed();
}

TEST_F(HostileWebClient, MessagesThatAreTooLongAreRefusedBeforeTheyCome) {
  Start({.limits = {.message_bytes = 1000}});
  RawClient client = Talker();
  // Says that it sends an exabyte, and sends nothing of it.
  client.Send(std::string("\x81\xff\x0f\x00\x00\x00\x00\x00\x00\x00\x01\x02\x03\x04", 14));
  const auto closing = client.Receive(8);
  ASSERT_TRUE(closing);
  EXPECT_EQ(closing->code(), 1009);
  RawClient in_parts = Talker();
  in_parts.Send(RawClient::Frame(1, std::string(600, 'x'), false));
  in_parts.Send(RawClient::Frame(0, std::string(600, 'x')));
  const auto second = in_parts.Receive(8);
  ASSERT_TRUE(second);
  EXPECT_EQ(second->code(), 1009);
  EXPECT_EQ(met.messages, 0);
}

TEST_F(HostileWebClient, AFloodOfMessagesIsReadAtTheRateThatIsAllowed) {
  Start({.limits = {.messages_per_second = 100}});
  RawClient client = Talker();
  const auto start = std::chrono::steady_clock::now();
  std::string flood;
  for (int i = 0; i < 200; ++i) flood += RawClient::Frame(1, "x");
  client.Send(flood);
  ExpectThatOthersAreServed();
  for (int i = 0; i < 200; ++i) ASSERT_TRUE(client.Receive(1));
  // 100 at once, then 100 a second: the clock can only make it longer.
  const auto took = std::chrono::steady_clock::now() - start;
  EXPECT_GE(took, 900ms);
  EXPECT_EQ(met.too_many, 0);
}

TEST_F(HostileWebClient, WhatOutranksTheRateComesBeforeWhatWasSaidTooFast) {
  Start({.limits = {.messages_per_second = 1}});
  RawClient client = Talker();
  std::string flood;
  const std::string usual(100, 'x');
  for (int i = 0; i < 20'000; ++i) flood += RawClient::Frame(1, usual);
  client.Send(flood);
  client.SendText("at once");
  int before = 0;
  for (auto answer = client.Receive(1); answer.value().payload == usual; answer = client.Receive(1)) ++before;
  EXPECT_LT(before, 1000) << "one a second";
  EXPECT_GE(met.too_many, 19'000) << "the rest is refused, or what outranks would not be read";
  EXPECT_EQ(client.Receive(1).value().payload, usual) << "a second's worth waits";
}

TEST_F(HostileWebClient, WhatMayBeLateWaitsForLonger) {
  Start({.limits = {.messages_per_second = 1000}});
  RawClient client = Talker();
  std::string flood;
  for (int i = 0; i < 3000; ++i) flood += RawClient::Frame(1, "late " + std::to_string(i));
  client.Send(flood);
  for (int i = 0; i < 3000; ++i) ASSERT_EQ(client.Receive(1).value().payload, "late " + std::to_string(i));
  EXPECT_EQ(met.too_many, 0);
}

TEST_F(HostileWebClient, OfWhatWaitsThereIsABound) {
  Start({.limits = {.messages_per_second = 100}});
  RawClient client = Talker();
  std::string flood;
  for (int i = 0; i < 500; ++i) flood += RawClient::Frame(1, "x");
  for (int i = 0; i < 2000; ++i) flood += RawClient::Frame(1, "late");
  client.Send(flood);
  client.SendText("at once");
  while (client.Receive(1).value().payload != "at once") {
  }
  EXPECT_GE(met.too_many, 1000);
}

TEST_F(HostileWebClient, AFloodOfPingsEndsTheSession) {
  Start({.limits = {.messages_per_second = 10}});
  RawClient client = Talker();
  std::string flood;
  for (int i = 0; i < 10'000; ++i) flood += RawClient::Frame(9, "x");
  client.Send(flood);
  const auto closing = client.Receive(8);
  ASSERT_TRUE(closing);
  EXPECT_EQ(closing->reason(), "too many pings");
  ExpectThatOthersAreServed();
}

TEST_F(HostileWebClient, OneThatDoesNotReadIsNotWrittenForAndLetGo) {
  Start({.limits = {.waiting_bytes = 1'000'000, .idle_time = 500ms}});
  RawClient client = Talker();
  client.SendText("much");                                     // 10 MB
  EXPECT_TRUE(Eventually([&] { return met.refused >= 50; }));  // the system's buffers have taken some
  ExpectThatOthersAreServed();
  EXPECT_TRUE(Eventually([&] { return met.ended >= 1; }));
}

TEST_F(HostileWebClient, OneThatAnswersNoPingIsLetGo) {
  Start({.limits = kImpatient});
  RawClient client = Talker();
  EXPECT_TRUE(Eventually([&] { return met.ended == 1; }));
  EXPECT_TRUE(client.IsClosed());
}

TEST_F(HostileWebClient, OneThatAnswersPingsStays) {
  Start({.limits = kImpatient});
  RawClient client = Talker();
  for (int pings = 0; pings < 5; ++pings) ASSERT_TRUE(client.AnswerPing());
  EXPECT_EQ(met.ended, 0);
  client.SendText("x");
  EXPECT_TRUE(client.Receive(1));
}

TEST_F(HostileWebClient, AHandshakeThatAsksForNothingIsNone) {
  Start();
  RawClient client = Client();
  client.Send(
      "GET / HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
      "Sec-WebSocket-Protocol: echo.v1\r\nSec-WebSocket-Version: 8\r\n"
      "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n");
  EXPECT_THAT(client.Read("\r\n\r\n"), Not(HasSubstr("101 ")));
  RawClient keyless = Client();
  keyless.Send(
      "GET / HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
      "Sec-WebSocket-Protocol: echo.v1\r\nSec-WebSocket-Version: 13\r\n\r\n");
  EXPECT_THAT(keyless.Read("\r\n\r\n"), Not(HasSubstr("101 ")));
  EXPECT_EQ(met.begun, 0);
  ExpectThatOthersAreServed();
}

std::size_t RandomInputs() {
  const char* const wanted = std::getenv("RUNNEL_RANDOM_INPUTS");
  return wanted != nullptr ? std::stoul(wanted) : 300;
}

TEST_F(HostileWebClient, RandomBytesDoNoHarm) {
  Start({.limits = kImpatient});
  std::mt19937 random(7);
  const auto below = [&](std::size_t end) { return std::uniform_int_distribution<std::size_t>(0, end - 1)(random); };
  for (std::size_t i = 0; i < RandomInputs(); ++i) {
    std::string bytes;
    RawClient client = Client();
    if (below(2) == 0) {
      bytes = "GET / HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n\r\n";
    } else {
      EXPECT_THAT(client.Upgrade("echo.v1"), HasSubstr("101 "));
      for (std::size_t frame = 0; frame < 4; ++frame) {
        bytes += RawClient::Frame(static_cast<int>(below(16)), std::string(below(300), 'x'), below(2) == 0);
      }
    }
    for (std::size_t change = below(5); change > 0; --change) {
      bytes[below(bytes.size())] = static_cast<char>(below(256));
    }
    client.Send(std::string_view(bytes).substr(0, below(bytes.size()) + 1));
  }
  ExpectThatOthersAreServed();
}

}  // namespace

}  // namespace runnel::test
