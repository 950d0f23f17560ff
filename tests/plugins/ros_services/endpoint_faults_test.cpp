// What comes is counted where there is no memory for it, and each answer that has waited goes once, wherever memory runs out.

#include <memory>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/element/runtime.h"
#include "plugins/cdr_values/cdr_stream.h"
#include "plugins/network_discovery/discovery_table.h"
#include "plugins/ros_messages/names.h"
#include "plugins/ros_services/service_endpoints.h"
#include "plugins/ros_services/stop_service.h"
#include "plugins/testing/fault_injection.h"

namespace runnel::test {
namespace {

constexpr std::uint64_t kCaller = 5, kItsReader = 6;  // handles
constexpr const char* kClient = "clientid=1.2;";

/// A member of a network of which there is nothing but what endpoints are called back by, and what they write.
class Alone final : public WireParticipant {
 public:
  [[nodiscard]] const WireId& id() const noexcept override { return id_; }
  Result<std::unique_ptr<WireWriter>> MakeWriter(const WireEndpointOptions&, OnMatched) override {
    return std::unique_ptr<WireWriter>(std::make_unique<Writer>(*this));
  }
  Result<std::unique_ptr<WireReader>> MakeReader(const WireEndpointOptions&, OnSample on_sample, OnMatched) override {
    come = std::move(on_sample);
    return std::unique_ptr<WireReader>(std::make_unique<Reader>());
  }

  OnSample come;
  std::vector<Octets> written;
  bool has_reader = false;

 private:
  struct Writer final : WireWriter {
    explicit Writer(Alone& of) : alone(of) {}
    [[nodiscard]] const WireId& id() const noexcept override { return alone.id_; }
    [[nodiscard]] bool HasReader(std::uint64_t reader) const override {
      return alone.has_reader && reader == kItsReader;
    }
    Result<void> Write(const std::shared_ptr<const Octets>& octets, std::int64_t) override {
      alone.written.push_back(*octets);
      return {};
    }
    Alone& alone;
  };
  struct Reader final : WireReader {
    [[nodiscard]] const WireId& id() const noexcept override { return own; }
    WireId own{4};
  };
  WireId id_{3};
};

Octets Message(int number) { return {std::byte(0), std::byte(1), std::byte(0), std::byte(0), std::byte(number)}; }

WireEndpoint EndpointOf(std::uint64_t handle, bool is_writer, const std::string& topic) {
  WireEndpoint made{.handle = handle, .id = {static_cast<std::uint8_t>(handle)}, .is_writer = is_writer};
  made.options = {.topic = topic, .user_data = kClient};
  return made;
}

std::unique_ptr<ServiceEndpoints> Serve(Alone& alone, const DiscoveryTable* table) {
  return std::move(*ServiceEndpoints::Start(ServiceEndpoints::Side::kServer, {.service = "/double", .table = table},
                                            alone, 1, [] {}));
}

TEST(EndpointFaults, ARequestThatThereIsNoMemoryForIsCounted) {
  Alone alone;
  auto server = Serve(alone, nullptr);
  const Octets request = WithCallId({.client = {1}, .number = 1, .writer = 0}, Message(1));
  const std::size_t points = AtEachPoint(
      InjectedFault::kAllocation, [&] { (void)CallBack([&] { alone.come({.octets = request, .writer = kCaller}); }); },
      [&](bool has_struck) {
        EXPECT_EQ(server->lost(), has_struck ? 1U : 0U);
        EXPECT_EQ(server->Take().has_value(), !has_struck);
        server = Serve(alone, nullptr);
      });
  EXPECT_GT(points, 1U);
}

TEST(EndpointFaults, AnswersThatHaveWaitedGoOnceEach) {
  constexpr int kAnswers = 3;
  DiscoveryTable table([] {});
  table.OnEndpoint(EndpointOf(kCaller, true, DdsRequestTopic("/double")));
  Alone alone;
  std::unique_ptr<ServiceEndpoints> server;
  const auto keep = [&] {
    alone.has_reader = false;
    alone.written.clear();
    table.OnEndpointGone({static_cast<std::uint8_t>(kItsReader)});
    server = Serve(alone, &table);
    for (int i = 1; i <= kAnswers; ++i)
      ASSERT_TRUE(server->Reply({.client = {1}, .number = i, .writer = kCaller}, Message(i)));
    ASSERT_TRUE(alone.written.empty()) << "the reader is not there yet";
    table.OnEndpoint(EndpointOf(kItsReader, false, DdsReplyTopic("/double")));
    alone.has_reader = true;
  };
  keep();
  const std::size_t points = AtEachPoint(
      InjectedFault::kAllocation, [&] { (void)CallBack([&] { server->SendKept(); }); },
      [&](bool) {
        server->SendKept();
        ASSERT_EQ(alone.written.size(), static_cast<std::size_t>(kAnswers));
        for (int i = 1; i <= kAnswers; ++i) {
          EXPECT_EQ(alone.written[static_cast<std::size_t>(i - 1)],
                    WithCallId({.client = {1}, .number = i, .writer = 0}, Message(i)));
        }
        keep();
      });
  EXPECT_GT(points, 3U);
}

// Neither for an answer that is kept for somebody else, nor for one that there is no memory for.
TEST(EndpointFaults, AStopWaitsForNoAnswer) {
  Runtime runtime;
  DiscoveryTable table([] {});
  table.OnEndpoint(EndpointOf(kCaller, true, DdsRequestTopic("/base/stop")));
  for (const std::size_t further : {std::size_t{0}, std::size_t{1000}}) {
    Alone alone;
    std::unique_ptr<StopService> service;
    const auto ask = [&](std::int64_t number, bool is_press) {
      Octets message;
      CdrWriter(message).Put(is_press);
      return WithCallId({.client = {1}, .number = number, .writer = 0}, message);
    };
    const Octets release = ask(1, false), press = ask(2, true);
    const auto begin = [&] {
      (void)runtime.robot_stop().Release("a test");
      service = std::move(*StopService::Start(runtime, true, "/base", alone, ServiceDialect::kInFront, {}, {}, &table));
      alone.come({.octets = release, .writer = kCaller});
      ASSERT_TRUE(alone.written.empty()) << "the answer waits for its reader";
    };
    begin();
    const std::size_t points = AtEachPoint(
        InjectedFault::kAllocation, [&] { (void)CallBack([&] { alone.come({.octets = press, .writer = kCaller}); }); },
        [&](bool) {
          EXPECT_NE(runtime.robot_stop().in_force(), service->endpoints().lost() > 0);
          begin();
        },
        further);
    EXPECT_GT(points, 3U);
  }
}

}  // namespace
}  // namespace runnel::test
