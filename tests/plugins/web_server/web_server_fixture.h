#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gmock/gmock.h>

#include "plugins/web_server/web_server.h"
#include "tests/plugins/web_server/raw_client.h"
#include "tests/support/wait_until.h"

namespace runnel::test {

using namespace std::chrono_literals;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

/// More than the sockets of a connection take.
inline const std::string kLarge(40'000'000, 'x');
inline constexpr std::size_t kLargeMessage = 8'000'000;

/// What sessions of a test have met; of any thread.
struct Met {
  std::atomic<int> begun{0};
  std::atomic<int> ended{0};
  std::atomic<int> turns{0};
  std::atomic<int> messages{0};
  std::atomic<int> refused{0};  // by SendText()
  std::atomic<int> too_many{0};

  void Keep(std::function<void()> waker) {
    const std::lock_guard lock(mutex);
    wakers.push_back(std::move(waker));
  }
  void WakeAll() {
    const std::lock_guard lock(mutex);
    for (const auto& wake : wakers) wake();
  }
  std::mutex mutex;
  std::vector<std::function<void()>> wakers;  // guarded by mutex
};

/// Says what it is told. Some words have a meaning: "throw", "close", "role", "much",
/// "large", "soon".
class Echo final : public WebSession {
 public:
  Echo(WebClient& client, Met& met) : client_(client), met_(met) { ++met_.begun; }
  ~Echo() override { ++met_.ended; }

  void OnText(std::string_view message) override {
    ++met_.messages;
    if (message == "throw a number") throw 1;
    if (message == "keep the waker") met_.Keep(client_.Waker());
    if (message == "throw") throw std::runtime_error("the session has thrown");
    if (message == "role") {
      client_.SendText(std::string(WebRoleName(client_.role())));
      return;
    }
    if (message == "close") return client_.Close("as you wish");
    if (message == "much") {
      for (int i = 0; i < 100; ++i) {
        if (!client_.SendText(std::string(100'000, 'x'))) ++met_.refused;
      }
      return;
    }
    if (message == "large") {
      client_.SendText(std::string(kLargeMessage, 'x'));
      return;
    }
    if (message == "soon") {
      is_soon_ = true;
      return;
    }
    client_.SendText(std::string(message));
  }
  void OnBinary(std::string_view message) override { client_.SendBinary(std::string(message)); }
  WebArrival OnArrival(std::string_view message, bool is_text) override {
    return {.outranks = is_text && message == "at once", .may_be_late = message.starts_with("late")};
  }
  void OnTooMany(std::string_view /*message*/, bool /*is_text*/) override { ++met_.too_many; }
  SteadyTime OnPoll() override {
    ++met_.turns;
    const auto now = std::chrono::steady_clock::now();
    return is_soon_ ? now : now + 1h;
  }

 private:
  WebClient& client_;
  Met& met_;
  bool is_soon_ = false;
};

class WebServerTest : public ::testing::Test {
 protected:
  void Start(WebServerOptions options = {}) {
    options.port = 0;
    auto started = WebServer::Start(options,
                                    {{"/", "text/html", "<p>page</p>"},
                                     {"/page.js", "text/javascript", "let page = 1"},
                                     {"/large", "text/plain", kLarge}},
                                    {{{"echo.v1", "echo.v2", "echo.kept"},
                                      [this](WebClient& client) { return std::make_unique<Echo>(client, met); },
                                      "echo.kept"}});
    ASSERT_TRUE(started) << started.error().ToString();
    server = std::move(*started);
  }
  [[nodiscard]] RawClient Client() const { return RawClient(server->port()); }
  /// A client whose session has begun.
  [[nodiscard]] RawClient Talker() const {
    RawClient client = Client();
    EXPECT_THAT(client.Upgrade("echo.v1"), HasSubstr("101 "));
    return client;
  }
  /// That the server still does what it is for.
  void ExpectThatOthersAreServed() const {
    EXPECT_THAT(Client().Get("/"), HasSubstr("<p>page</p>"));
    RawClient talker = Talker();
    talker.SendText("are you there");
    const auto answer = talker.Receive();
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->payload, "are you there");
  }
  template <typename Condition>
  static bool Eventually(const Condition& condition) {
    const auto latest = std::chrono::steady_clock::now() + kLongestWait;
    while (!condition() && std::chrono::steady_clock::now() < latest) {
      std::this_thread::sleep_for(1ms);
    }
    return condition();
  }

  Met met;  // sessions use it to their end
  std::unique_ptr<WebServer> server;
};

}  // namespace runnel::test
