// Wherever memory runs out in the server's thread, no more than connections end.

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/time.h>

#include "plugins/testing/fault_injection.h"
#include "plugins/web_server/web_server.h"
#include "tests/plugins/web_server/certificate.h"
#include "tests/plugins/web_server/raw_client.h"
#include "tests/plugins/web_server/tls_client.h"
#include "tests/support/wait_until.h"

namespace runnel::test {
namespace {

std::optional<FaultInjection> injection;  // of the server's thread
std::function<void()> waker;              // of the newest session
std::atomic<int> turns{0};

/// Has the n-th allocation after the message "n" fail, and after "n m" the m behind it, too.
class Careless final : public WebSession {
 public:
  explicit Careless(WebClient& client) : client_(client) { waker = client.Waker(); }
  void OnText(std::string_view message) override {
    std::size_t nth = 0, further = 0;
    std::istringstream(std::string(message.substr(0, 20))) >> nth >> further;
    injection.reset();
    if (nth > 0) injection.emplace(InjectedFault::kAllocation, nth, further);
    if (message == "well?") client_.SendText("heard");
  }
  void OnBinary(std::string_view) override { injection.reset(); }
  SteadyTime OnPoll() override {
    ++turns;
    return std::chrono::steady_clock::now() + std::chrono::hours(1);
  }

 private:
  WebClient& client_;
};

/// Nobody's connection ends for having been silent.
std::unique_ptr<WebServer> Start(WebServerOptions options = {}) {
  options.port = 0;
  options.limits.idle_time = std::chrono::hours(1);
  turns = 0;
  options.limits.messages_per_second = 10'000;
  auto server =
      WebServer::Start(options, {{"/", "text/html", "<p>page</p>"}},
                       {{{"careless"}, [](WebClient& client) { return std::make_unique<Careless>(client); }}});
  EXPECT_TRUE(server) << server.error().ToString();
  return std::move(*server);
}

// It may meet the fault, and have no answer.
void Try(std::uint16_t port) {
  const RawClient client(port);
  const timeval patience{.tv_sec = 0, .tv_usec = 300'000};
  setsockopt(client.descriptor(), SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  client.Send("GET / HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n");
  char some[100];
  (void)recv(client.descriptor(), some, sizeof some, 0);
}

constexpr int kTries = 4;  // which allocate more often than it is counted to

TEST(WebFaults, TheServerServesOthersWhereverMemoryHasRunOut) {
  const auto server = Start();
  const std::uint16_t port = server->port();
  for (int nth = 1; nth <= 40; ++nth) {
    RawClient client(port);
    ASSERT_THAT(client.Upgrade("careless"), testing::HasSubstr("101 ")) << nth;
    client.SendText(std::to_string(nth));
    for (int i = 0; i < kTries; ++i) Try(port);
    ASSERT_THAT(RawClient(port).Get("/"), testing::HasSubstr("<p>page</p>")) << nth;
  }
  RawClient client(port);
  ASSERT_THAT(client.Upgrade("careless"), testing::HasSubstr("101 "));
  client.Send(RawClient::Frame(2, "end"));
}

// Whose page looks alive would press a STOP that nobody hears.
template <typename MakeClient>
void ExpectThatWhoIsNotHeardKnows(const WebServer& server, const MakeClient& make_client) {
  const std::string large(500'000, 'x');  // more than there is a buffer for
  for (int further : {0, 3}) {
    for (int nth = 1; nth <= 40; ++nth) {
      SCOPED_TRACE(std::to_string(nth) + " " + std::to_string(further));
      {
        auto client = make_client();
        client.Send(
            "GET / HTTP/1.1\r\nHost: localhost\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
            "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n"
            "Sec-WebSocket-Protocol: careless\r\n\r\n");
        ASSERT_THAT(client.Read("\r\n\r\n"), testing::HasSubstr("101 "));
        client.Send(RawClient::Frame(1, std::to_string(nth) + " " + std::to_string(further)));
        client.Send(RawClient::Frame(1, large));
        client.Send(RawClient::Frame(1, "well?"));
        if (client.Read("heard").find("heard") == std::string::npos) {
          WaitUntil("it has ended with its session", [&] { return server.clients() == 0; });
        }
      }
      WaitUntil("the client has gone", [&] { return server.clients() == 0; });
      for (int i = 0; i < further; ++i) Try(server.port());
    }
  }
}

TEST(WebFaults, WhoIsNotHeardAnyMoreHasNoConnection) {
  const auto server = Start();
  ExpectThatWhoIsNotHeardKnows(*server, [&] { return RawClient(server->port()); });
}

TEST(WebFaults, NorWithTls) {
  signal(SIGPIPE, SIG_IGN);  // OpenSSL writes into sockets that may have been closed
  const Certificate ours("ours");
  const auto server = Start({.certificate_file = ours.certificate, .key_file = ours.key});
  ExpectThatWhoIsNotHeardKnows(*server, [&] { return TlsClient(server->port(), ours.certificate); });
}

TEST(WebFaults, WhoWakesASessionNeedsNoMemoryAndWakesItTheNextTime) {
  const auto server = Start();
  RawClient client(server->port());
  ASSERT_THAT(client.Upgrade("careless"), testing::HasSubstr("101 "));
  WaitUntil("its session has begun", [] { return turns > 0; });
  const auto wake_again = [](bool) {
    const int before = turns;
    waker();
    WaitUntil("the session has a turn", [&] { return turns > before; });
  };
  EXPECT_GT(AtEachPoint(
                InjectedFault::kAllocation, [] { waker(); }, wake_again, 1000),
            0u);
}

TEST(WebFaults, TheServerEndsWhereMemoryIsShort) {
  WebServerOptions options{.tokens = {{WebRole::kLook, "looks_only"}, {WebRole::kDrive, "may_drive"}}};
  options.limits.clients = 1;
  std::unique_ptr<WebServer> server;
  std::vector<RawClient> clients;
  const auto begin = [&] {
    server = Start(options);
    for (int i = 0; i < 3; ++i) clients.emplace_back(server->port());
    // The second one takes the place of the first, which takes a moment to go.
    ASSERT_THAT(clients[0].Upgrade("careless", "Authorization: Bearer looks_only\r\n"), testing::HasSubstr("101 "));
    ASSERT_THAT(clients[1].Upgrade("careless", "Authorization: Bearer may_drive\r\n"), testing::HasSubstr("101 "));
  };
  const auto end = [&](bool) {
    for (RawClient& each : clients) EXPECT_TRUE(each.IsClosed());
    clients.clear();
    waker();  // of somebody who has gone
    begin();
  };
  begin();
  EXPECT_GT(AtEachPoint(
                InjectedFault::kAllocation, [&] { server.reset(); }, end, 20),
            1u);
}

}  // namespace
}  // namespace runnel::test
