// Wherever memory runs out in the server's thread, no more than connections end.

#include <memory>
#include <optional>
#include <string>

#include <gmock/gmock.h>
#include <sys/socket.h>
#include <sys/time.h>

#include "plugins/testing/fault_injection.h"
#include "plugins/web_server/web_server.h"
#include "tests/plugins/web_server/raw_client.h"

namespace runnel::test {
namespace {

std::optional<FaultInjection> injection;  // of the server's thread

/// Has the n-th allocation after the message "n" fail.
class Careless final : public WebSession {
 public:
  void OnText(std::string_view message) override {
    const std::string number(message);
    injection.reset();
    injection.emplace(InjectedFault::kAllocation, std::stoul(number));
  }
  void OnBinary(std::string_view) override { injection.reset(); }
  SteadyTime OnPoll() override { return std::chrono::steady_clock::now() + std::chrono::hours(1); }
};

// It may meet the fault, and have no answer.
void Try(std::uint16_t port) {
  const RawClient client(port);
  const timeval patience{.tv_sec = 0, .tv_usec = 300'000};
  setsockopt(client.descriptor(), SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  client.Send("GET / HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n");
  char some[100];
  (void)recv(client.descriptor(), some, sizeof some, 0);
}

TEST(WebFaults, TheServerServesOthersWhereverMemoryHasRunOut) {
  constexpr int kTries = 4;  // which allocate more often than it is counted to
  auto server = WebServer::Start({.port = 0}, {{"/", "text/html", "<p>page</p>"}},
                                 {{{"careless"}, [](WebClient&) { return std::make_unique<Careless>(); }}});
  ASSERT_TRUE(server) << server.error().ToString();
  const std::uint16_t port = (*server)->port();
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

}  // namespace
}  // namespace runnel::test
