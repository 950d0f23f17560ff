// Clients on slow lines have all that is sent to them; those that take nothing are let go.

#include <algorithm>
#include <string>
#include <thread>

#include <sys/socket.h>

#include "tests/plugins/web_server/web_server_fixture.h"

namespace runnel::test {

namespace {

class SlowWebClient : public WebServerTest {};

// A browser on a slow line: each piece of the page comes in time, but not the whole.
TEST_F(SlowWebClient, WhoTakesALargeAnswerSlowlyHasAllOfIt) {
  Start({.limits = {.request_time = 500ms}});
  const RawClient client = Client();
  client.Send("GET /large HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n");
  std::string piece(256 * 1024, ' ');
  std::size_t taken = 0;
  for (ssize_t more = 1; more > 0; taken += static_cast<std::size_t>(std::max<ssize_t>(more, 0))) {
    std::this_thread::sleep_for(10ms);
    more = recv(client.descriptor(), piece.data(), piece.size(), 0);
  }
  EXPECT_GT(taken, kLarge.size());
}

// Into the sockets fits more than it takes in the time that each piece has.
TEST_F(SlowWebClient, WhoTakesALargeAnswerVerySlowlyIsNotTakenForGone) {
  Start({.limits = {.request_time = 1s}});
  const RawClient client = Client();
  client.Send("GET /large HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n");
  std::string piece(256 * 1024, ' ');
  std::size_t taken = 0;
  const auto take = [&](std::size_t most) {
    const ssize_t more = recv(client.descriptor(), piece.data(), most, 0);
    taken += static_cast<std::size_t>(std::max<ssize_t>(more, 0));
    return more > 0;
  };
  for (int i = 0; i < 120 && take(16 * 1024); ++i) std::this_thread::sleep_for(25ms);
  while (take(piece.size())) {
  }
  EXPECT_GT(taken, kLarge.size());
}

TEST_F(SlowWebClient, WhoTakesALargeMessageSlowlyHasAllOfIt) {
  Start({.limits = {.idle_time = 600ms}});
  const RawClient client = Talker();
  client.SendText("large");
  std::string piece(32 * 1024, ' ');
  std::size_t taken = 0;
  for (int i = 0; taken < kLargeMessage; ++i) {
    std::this_thread::sleep_for(10ms);
    if (i % 10 == 0) client.Send(RawClient::Frame(10, ""));  // a sign of life
    const ssize_t more = recv(client.descriptor(), piece.data(), piece.size(), 0);
    if (more <= 0) break;
    taken += static_cast<std::size_t>(more);
  }
  EXPECT_GE(taken, kLargeMessage);
}

TEST_F(SlowWebClient, ALargeMessageIsOneMessage) {
  Start();
  RawClient client = Talker();
  client.SendText("large");
  client.SendText("behind it");
  const auto large = client.Receive();
  ASSERT_TRUE(large);
  EXPECT_EQ(large->operation, 1);
  EXPECT_TRUE(large->payload == std::string(kLargeMessage, 'x'));
  const auto behind = client.Receive();
  ASSERT_TRUE(behind);
  EXPECT_EQ(behind->payload, "behind it");
}

TEST_F(SlowWebClient, WhoTakesNothingOfAnAnswerIsLetGo) {
  Start({.limits = {.request_time = 200ms}});
  const RawClient client = Client();
  client.Send("GET /large HTTP/1.1\r\nHost: localhost\r\n\r\n");
  std::this_thread::sleep_for(1s);
  std::string piece(256 * 1024, ' ');
  std::size_t taken = 0;
  for (ssize_t more = 0; (more = recv(client.descriptor(), piece.data(), piece.size(), 0)) > 0;)
    taken += static_cast<std::size_t>(more);
  EXPECT_LT(taken, kLarge.size());
}

}  // namespace

}  // namespace runnel::test
