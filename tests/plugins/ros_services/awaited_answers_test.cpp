// The first answer to a client waits for the client's reader, which need not be matched yet, on either engine.

#include <algorithm>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gmock/gmock.h>

#include "core/element/runtime.h"
#include "core/log/logger.h"
#include "core/module/group.h"
#include "plugins/cdr_values/cdr_stream.h"
#include "plugins/cdr_values/cdr_values.h"
#include "plugins/network_discovery/discovery_table.h"
#include "plugins/ros_messages/names.h"
#include "plugins/ros_services/ros_node.h"
#include "plugins/ros_services/service_endpoints.h"
#include "tests/support/wait_until.h"

namespace runnel::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

constexpr std::uint64_t kCaller = 5, kItsReader = 6, kOtherReader = 7;  // handles
constexpr const char* kClient = "clientid=1.2;";

// As DDS has it, its last octet says what it is.
WireId IdOf(std::uint64_t handle, bool is_writer) {
  WireId id{static_cast<std::uint8_t>(handle)};
  id.back() = is_writer ? 3 : 4;
  return id;
}

WireEndpoint EndpointOf(std::uint64_t handle, bool is_writer, const std::string& topic, const std::string& user_data) {
  WireEndpoint made{.handle = handle, .id = IdOf(handle, is_writer), .is_writer = is_writer};
  made.options = {.topic = topic, .user_data = user_data};
  return made;
}

/// A member of a network of which there is nothing but one who asks.
class Asked final : public WireParticipant {
 public:
  [[nodiscard]] const WireId& id() const noexcept override { return id_; }
  Result<std::unique_ptr<WireWriter>> MakeWriter(const WireEndpointOptions& options, OnMatched) override {
    return std::unique_ptr<WireWriter>(std::make_unique<Writer>(*this, options.topic));
  }
  Result<std::unique_ptr<WireReader>> MakeReader(const WireEndpointOptions& options, OnSample on_sample,
                                                 OnMatched) override {
    come_[options.topic] = std::move(on_sample);
    return std::unique_ptr<WireReader>(std::make_unique<Reader>());
  }
  /// `reply_to`: what the request names, beside it.
  void Ask(const std::string& service, const Octets& message, ServiceDialect dialect, const WireId& reply_to) {
    const OnSample& come = come_.at(DdsRequestTopic(service));
    if (dialect == ServiceDialect::kInFront) {
      const Octets request = WithCallId({.client = {1}, .number = 1, .writer = 0}, message);
      return come({.octets = request, .writer = kCaller});
    }
    come({.octets = message, .writer = kCaller, .identity = {IdOf(kCaller, true), 1}, .related = {reply_to, 0}});
  }
  void Match(std::uint64_t reader) {
    const std::lock_guard lock(mutex_);
    readers_.push_back(reader);
  }
  /// On which topics, one after the other.
  [[nodiscard]] std::vector<std::string> written() {
    const std::lock_guard lock(mutex_);
    return written_;
  }

 private:
  struct Writer final : WireWriter {
    Writer(Asked& of, std::string on) : asked(of), topic(std::move(on)) {}
    [[nodiscard]] const WireId& id() const noexcept override { return asked.id_; }
    [[nodiscard]] bool HasReader(std::uint64_t reader) const override {
      const std::lock_guard lock(asked.mutex_);
      return std::ranges::find(asked.readers_, reader) != asked.readers_.end();
    }
    Result<void> Write(const std::shared_ptr<const Octets>&, std::int64_t) override {
      const std::lock_guard lock(asked.mutex_);
      asked.written_.push_back(topic);
      return {};
    }
    Result<WireIdentity> WriteRelated(const std::shared_ptr<const Octets>& octets, std::int64_t time,
                                      const WireIdentity&) override {
      (void)Write(octets, time);
      return WireIdentity{id(), 1};
    }
    Asked& asked;
    const std::string topic;
  };
  struct Reader final : WireReader {
    [[nodiscard]] const WireId& id() const noexcept override { return own; }
    WireId own{4};
  };
  WireId id_{3};
  std::map<std::string, OnSample> come_;
  std::mutex mutex_;
  std::vector<std::uint64_t> readers_;  // that are matched; guarded by mutex_, as the next
  std::vector<std::string> written_;
};

class FurtherAnswersTest : public testing::Test {
 protected:
  void AddCaller(const std::string& service) {
    table_.OnEndpoint(EndpointOf(kCaller, true, DdsRequestTopic(service), kClient));
  }
  void AddReader(std::uint64_t handle, const std::string& service, const std::string& user_data) {
    table_.OnEndpoint(EndpointOf(handle, false, DdsReplyTopic(service), user_data));
  }

  DiscoveryTable table_{[] {}};
  Asked asked_;
};

class AwaitedAnswersTest : public FurtherAnswersTest, public testing::WithParamInterface<ServiceDialect> {};

TEST_P(AwaitedAnswersTest, GoOnceTheReaderOfWhoAsksIsMatched) {
  AddCaller("/double");
  const auto server = std::move(
      *ServiceEndpoints::Start(ServiceEndpoints::Side::kServer,
                               {.service = "/double", .dialect = GetParam(), .table = &table_}, asked_, 1, [] {}));
  asked_.Ask("/double", Octets(8), GetParam(), IdOf(kItsReader, false));
  const auto request = server->Take();
  ASSERT_TRUE(request);
  ASSERT_TRUE(server->Reply(request->id, Octets(8)));
  EXPECT_THAT(asked_.written(), IsEmpty()) << "its reader is not known";
  AddReader(kOtherReader, "/double", "clientid=1.3;");
  asked_.Match(kOtherReader);
  server->SendKept();
  EXPECT_THAT(asked_.written(), IsEmpty()) << "that is the reader of somebody else";
  AddReader(kItsReader, "/double", kClient);
  server->SendKept();
  EXPECT_THAT(asked_.written(), IsEmpty()) << "it is known, and not matched";
  asked_.Match(kItsReader);
  server->SendKept();
  server->SendKept();
  EXPECT_THAT(asked_.written(), ElementsAre(DdsReplyTopic("/double")));
}

TEST_P(AwaitedAnswersTest, OfTheStopAndOfParametersWaitToo) {
  const std::string stop = "/base/stop", get = "/base/get_parameters";
  AddCaller(stop);  // whose handle is all that counts
  Runtime runtime;
  Group& robot = runtime.Create<Group>(runtime.root(), "robot");
  Logger log(robot);
  const auto node = RosNode::Start({.node = "/base", .parameters = RosParameterUse::kRead}, asked_, robot, false, log,
                                   RosHooks{.dialect = GetParam(), .table = &table_}, [] {});
  Octets press, names;
  CdrWriter(press).Put(true);
  const std::vector<std::string> none;
  WriteCdr(TypeOf<std::vector<std::string>>(), &none, names);
  asked_.Ask(stop, press, GetParam(), IdOf(kItsReader, false));
  asked_.Ask(get, names, GetParam(), IdOf(kOtherReader, false));
  EXPECT_TRUE(runtime.robot_stop().in_force());
  std::this_thread::sleep_for(std::chrono::milliseconds(50));  // parameters are answered by a thread of their own
  EXPECT_THAT(asked_.written(), IsEmpty());
  AddReader(kItsReader, stop, kClient);
  AddReader(kOtherReader, get, kClient);
  for (const auto reader : {kItsReader, kOtherReader}) asked_.Match(reader);
  node->Tell({}, {});
  WaitUntil("both are answered", [&] { return asked_.written().size() >= 2; });
  EXPECT_THAT(asked_.written(), UnorderedElementsAre(DdsReplyTopic(stop), DdsReplyTopic(get)));
}

INSTANTIATE_TEST_SUITE_P(Dialects, AwaitedAnswersTest,
                         testing::Values(ServiceDialect::kInFront, ServiceDialect::kBeside));

// As DDS without ROS has them: nothing is known of who will read it.
TEST_F(FurtherAnswersTest, DoNotWaitForWhoNamesNoReader) {
  constexpr auto kBeside = ServiceDialect::kBeside;
  AddCaller("/double");
  const auto server = std::move(*ServiceEndpoints::Start(
      ServiceEndpoints::Side::kServer, {.service = "/double", .dialect = kBeside, .table = &table_}, asked_, 1, [] {}));
  for (const WireId& named : {WireId{}, IdOf(kCaller, true)}) asked_.Ask("/double", Octets(8), kBeside, named);
  while (const auto request = server->Take()) EXPECT_TRUE(server->Reply(request->id, Octets(8)));
  EXPECT_EQ(asked_.written().size(), 2U);
}

// As their topics say how many are kept.
TEST_F(FurtherAnswersTest, RequestsWaitAsManyAsTheServiceKeeps) {
  for (const auto& [depth, kept] : {std::pair{10U, 128U}, std::pair{1000U, 1000U}}) {
    const auto server = std::move(*ServiceEndpoints::Start(ServiceEndpoints::Side::kServer,
                                                           {.service = "/double", .depth = depth}, asked_, 1, [] {}));
    for (unsigned i = 0; i < kept + 5; ++i) asked_.Ask("/double", Octets(8), ServiceDialect::kInFront, {});
    EXPECT_EQ(server->waiting(), kept);
    EXPECT_EQ(server->lost(), 5U);
  }
}

}  // namespace
}  // namespace runnel::test
