// What plugins/web_server/SECURITY.md says that others can try, tried.

#include <functional>

#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/plugins/web_server/web_server_fixture.h"

namespace runnel::test {

namespace {

class Attack : public WebServerTest {
 protected:
  static constexpr uid_t kNobody = 65534;

  /// Has another user of this machine do it; whether it has come to its end. For who can become another user.
  static bool AsAnotherUser(const std::function<bool()>& attempt) {
    const pid_t child = fork();
    if (child == 0) _exit(setgid(kNobody) == 0 && setuid(kNobody) == 0 && attempt() ? 0 : 1);
    int status = 0;
    return waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
  }
};

const std::string kHandshake =
    "GET / HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
    "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n"
    "Sec-WebSocket-Protocol: echo.v1\r\n\r\n";

TEST_F(Attack, APageOfAnotherPlaceCannotTalk) {
  Start();
  for (const char* origin : {"http://evil.example", "https://evil.example:8765", "null", "file://",
                             "http://127.0.0.1:1", "http://localhost.evil.example"}) {
    EXPECT_THAT(Client().Upgrade("echo.v1", "Origin: " + std::string(origin) + "\r\n"), StartsWith("HTTP/1.1 403 "))
        << origin;
  }
  EXPECT_EQ(met.begun, 0);
}

TEST_F(Attack, AFormOfAnotherPlaceChangesNothing) {
  Start();
  RawClient client = Client();
  client.Send("POST /?delete=all HTTP/1.1\r\nHost: " + client.host() +
              "\r\nOrigin: http://evil.example\r\nContent-Type: text/plain\r\n"
              "Content-Length: 5\r\n\r\nop=me");
  EXPECT_THAT(client.Read(), ::testing::AnyOf(StartsWith("HTTP/1.1 413 "), StartsWith("HTTP/1.1 400 ")));
  EXPECT_EQ(met.begun, 0);
}

TEST_F(Attack, AnotherPlaceIsNotAllowedToReadEmbedOrFrameThePage) {
  Start();
  const std::string page = Client().Get("/", "Origin: http://evil.example\r\n");
  EXPECT_THAT(page, Not(HasSubstr("Access-Control-Allow-Origin")));
  EXPECT_THAT(page, HasSubstr("Cross-Origin-Resource-Policy: same-origin\r\n"));
  EXPECT_THAT(page, HasSubstr("Cross-Origin-Opener-Policy: same-origin\r\n"));
  EXPECT_THAT(page, HasSubstr("frame-ancestors 'none'"));
  EXPECT_THAT(page, HasSubstr("X-Frame-Options: DENY\r\n"));
}

TEST_F(Attack, ANameThatHasBeenLedHereIsRefusedForPagesAndWebSockets) {
  Start();
  for (const char* host : {"evil.example", "robot.local", "127.0.0.1.nip.io", "0x7f000001"}) {
    RawClient page = Client();
    page.Send("GET / HTTP/1.1\r\nHost: " + std::string(host) + "\r\n\r\n");
    EXPECT_THAT(page.Read(), StartsWith("HTTP/1.1 421 ")) << host;
    std::string handshake = kHandshake;
    handshake.replace(handshake.find("localhost"), 9, host);
    RawClient socket = Client();
    socket.Send(handshake);
    EXPECT_THAT(socket.Read(), StartsWith("HTTP/1.1 421 ")) << host;
  }
}

TEST_F(Attack, NothingOfARequestComesIntoTheRulesForThePage) {
  Start();
  for (const char* host : {"127.0.0.1; script-src *", "127.0.0.1:80; x", "[::1%; script-src *]", "[fe80::1%25lo;x]:80",
                           "127.0.0.1:80 'unsafe-inline'"}) {
    RawClient client = Client();
    client.Send("GET / HTTP/1.1\r\nHost: " + std::string(host) + "\r\n\r\n");
    EXPECT_THAT(client.Read(), Not(StartsWith("HTTP/1.1 200 "))) << host;
  }
}

TEST_F(Attack, ATokenLeaksIntoNoAnswerNoCookieAndNoReferrer) {
  Start({.tokens = {{WebRole::kChange, "open-sesame"}}});
  for (const char* target : {"/?token=open-sesame", "/access?token=open-sesame", "/nowhere?token=open-sesame",
                             "/page.js?token=open-sesame"}) {
    const std::string answer = Client().Get(target);
    EXPECT_THAT(answer, Not(HasSubstr("open-sesame"))) << target;
    EXPECT_THAT(answer, Not(HasSubstr("Set-Cookie"))) << target;
    EXPECT_THAT(answer, HasSubstr("Referrer-Policy: no-referrer\r\n")) << target;
    EXPECT_THAT(answer, HasSubstr("Cache-Control: no-store\r\n")) << target;
  }
}

TEST_F(Attack, APageWithTheBrowsersCookiesHasNoTokenByThem) {
  Start({.tokens = {{WebRole::kChange, "open-sesame"}}});
  EXPECT_THAT(Client().Upgrade("echo.v1", "Origin: http://" + Client().host() +
                                              "\r\nCookie: runnel_token=open-sesame; token=open-sesame\r\n"),
              StartsWith("HTTP/1.1 401 "));
}

// A proxy says of whom it speaks what it likes; only the token counts.
TEST_F(Attack, WhatAProxySaysOfItsClientIsNotBelieved) {
  Start({.tokens = {{WebRole::kChange, "open-sesame"}}, .host_names = {"robot.example.org"}});
  EXPECT_THAT(Client().Upgrade("echo.v1",
                               "X-Forwarded-For: 127.0.0.1\r\nX-Forwarded-Host: localhost\r\n"
                               "X-Real-IP: 127.0.0.1\r\nForwarded: for=127.0.0.1\r\n"),
              StartsWith("HTTP/1.1 401 "));
  RawClient proxied = Client();
  std::string handshake = kHandshake;
  handshake.replace(handshake.find("localhost"), 9, "robot.example.org");
  handshake.insert(handshake.find("\r\n\r\n"),
                   "\r\nOrigin: https://robot.example.org\r\nAuthorization: Bearer open-sesame");
  proxied.Send(handshake);
  EXPECT_THAT(proxied.Read("\r\n\r\n"), StartsWith("HTTP/1.1 101 "));
}

TEST_F(Attack, AnotherUserOfThisMachineIsRefused) {
  if (geteuid() != 0) GTEST_SKIP() << "only the superuser can become another user";
  Start();
  EXPECT_TRUE(AsAnotherUser([this] {
    const bool has_no_page = Client().Get("/").starts_with("HTTP/1.1 403 ");
    return has_no_page && Client().Upgrade("echo.v1").starts_with("HTTP/1.1 403 ");
  }));
  EXPECT_EQ(met.begun, 0);
  ExpectThatOthersAreServed();
}

// The system says of a socket that nobody has open any more that it belongs to user 0.
TEST_F(Attack, AnotherUserWhoHangsUpBeforeItIsAskedForIsRefused) {
  if (geteuid() != 0) GTEST_SKIP() << "only the superuser can become another user";
  Start();
  EXPECT_TRUE(AsAnotherUser([this] {
    for (int i = 0; i < 50; ++i) {
      const RawClient client = Client();
      client.Send(kHandshake + RawClient::Frame(1, "move"));
      shutdown(client.descriptor(), SHUT_RDWR);
    }
    return true;
  }));
  ExpectThatOthersAreServed();
  EXPECT_EQ(met.messages, 1) << "the one of those that are served";
}

TEST_F(Attack, AnotherUserComesInWithTheTokenOrWhereAllMay) {
  if (geteuid() != 0) GTEST_SKIP() << "only the superuser can become another user";
  Start({.tokens = {{WebRole::kLook, "just-look-7"}}});
  EXPECT_TRUE(AsAnotherUser(
      [this] { return Client().Upgrade("echo.v1, runnel.token.just-look-7").starts_with("HTTP/1.1 101 "); }));
  EXPECT_TRUE(AsAnotherUser([this] { return Client().Upgrade("echo.v1").starts_with("HTTP/1.1 401 "); }));
  Start({.is_for_all_users = true});
  EXPECT_TRUE(AsAnotherUser([this] { return Client().Upgrade("echo.v1").starts_with("HTTP/1.1 101 "); }));
}

TEST_F(Attack, AThousandConnectionsCostNobodyElseAnything) {
  Start();
  std::vector<RawClient> silent;
  for (int i = 0; i < 1000; ++i) {
    silent.push_back(Client());
    if (i % 3 == 0) silent.back().Send("GET / HTTP/1.1\r\nHost: loc");
  }
  ExpectThatOthersAreServed();
}

// What the page weighs lies in memory once, however many have asked for it and do not read.
TEST_F(Attack, ReadersOfThePageThatDoNotReadAreLetGo) {
  Start({.limits = {.request_time = 300ms}});
  std::vector<RawClient> stuck;
  for (int i = 0; i < 3; ++i) {
    stuck.push_back(Client());
    std::string requests;
    for (int request = 0; request < 1500; ++request) {
      requests += "GET / HTTP/1.1\r\nHost: localhost\r\n\r\n";
    }
    send(stuck.back().descriptor(), requests.data(), requests.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
  }
  ExpectThatOthersAreServed();
  for (RawClient& each : stuck) EXPECT_TRUE(each.IsClosed());
}

}  // namespace

}  // namespace runnel::test
