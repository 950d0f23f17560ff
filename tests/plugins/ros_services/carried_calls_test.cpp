// Calls carried from a client to a service over a network of this process.
#include <map>

#include <gmock/gmock.h>

#include "core/element/runtime.h"
#include "core/lockfree/wake_event.h"
#include "core/module/group.h"
#include "core/port/cycle.h"
#include "core/port/typed_ports.h"
#include "plugins/cdr_values/cdr_stream.h"
#include "plugins/ros_messages/message_library.h"
#include "plugins/ros_messages/names.h"
#include "plugins/ros_services/offered_service.h"
#include "plugins/ros_services/ros_time.h"
#include "plugins/ros_services/taken_service.h"
#include "plugins/services/client.h"
#include "plugins/services/service.h"
#include "plugins/testing/guards.h"
#include "tests/support/fake_wire.h"
#include "tests/support/wait_until.h"

namespace runnel::test {
namespace {

struct Nobody final : WireDiscovery {
  void OnMember(const WireMember&) override {}
  void OnMemberGone(const WireId&) override {}
  void OnEndpoint(const WireEndpoint&) override {}
  void OnEndpointGone(const WireId&) override {}
};

struct Doubler {
  Result<int> Double(const int& number) {
    if (number < 0) return Error{.message = "it is negative"};
    ++doubled;
    return 2 * number;
  }
  int doubled = 0;
};

class CarriedCallsTest : public testing::Test {
 protected:
  CarriedCallsTest() {
    (void)runtime_.MakeReady(runtime_.root());
    const auto& link = *client_.port().FindAnnotation<ClientForm>();
    auto form = ServiceForm::Make(link.form->arguments(), link.form->reply(), "", MessageLibrary::Standard());
    far_ = std::make_shared<DistantService>(link.form, *form);
    output_ = FindTypedPorts(client_.port().type())->MakeOutput(group_, "far");
    DistantService::PublishBy(*output_, far_);
    (void)Port::Connect(*output_, client_.port());
    taken_ = std::make_unique<TakenService>(runtime_, "/a/far", ServiceTakeOptions{.service = "/double"}, far_,
                                            ServiceDialect::kInFront, 1, wake_);
    (void)taken_->Follow(*near_);
  }
  void Offer() {
    offered_ =
        std::make_unique<OfferedService>(runtime_, ServiceOfferOptions{.port = "/a/double", .service = "/double"},
                                         MessageLibrary::Standard(), ServiceDialect::kInFront, 2, wake_);
    const auto followed = offered_->Follow(*there_, [](std::uint64_t) { return true; });
    ASSERT_TRUE(followed) << followed.error().ToString();
  }
  void PressAndRelease() {
    EXPECT_TRUE(runtime_.robot_stop().Press("a person"));
    EXPECT_TRUE(runtime_.robot_stop().Release("a person"));
  }
  template <typename Future>
  auto Await(Future& future) {
    WaitUntil("the call has ended", [&] {
      (void)taken_->Work();
      if (offered_ != nullptr) (void)offered_->Work();
      service_.Serve();
      return future.is_done();
    });
    return future.outcome();
  }

  Runtime runtime_;
  Group& group_ = runtime_.Create<Group>(runtime_.root(), "a");
  Doubler doubler_;
  Service<int(int)> service_{group_, doubler_, "double", &Doubler::Double};
  Client<int(int)> client_{group_, "client"};
  Nobody nobody_;
  const std::shared_ptr<WakeEvent> wake_ = std::make_shared<WakeEvent>();
  const std::shared_ptr<WireEngine> engine_ = MakeFakeWire();
  std::unique_ptr<WireParticipant> near_ = std::move(*engine_->Join({.name = "near"}, nobody_));
  std::unique_ptr<WireParticipant> there_ = std::move(*engine_->Join({.name = "there"}, nobody_));
  std::unique_ptr<Port> output_;
  std::shared_ptr<DistantService> far_;
  std::unique_ptr<TakenService> taken_;
  std::unique_ptr<OfferedService> offered_;
};

TEST_F(CarriedCallsTest, ComeBackWithTheReplyOrTheReason) {
  Offer();
  auto good = client_.Begin(21);
  EXPECT_EQ(*Await(good), 42);
  auto bad = client_.Begin(-1);
  const auto outcome = Await(bad);
  EXPECT_EQ(outcome.status(), CallStatus::kFailed);
  EXPECT_THAT(std::string(outcome.error()), testing::HasSubstr("it is negative"));
}

/// Keeps what endpoints say of themselves, by topic.
struct Hearer final : WireDiscovery {
  void OnMember(const WireMember&) override {}
  void OnMemberGone(const WireId&) override {}
  void OnEndpoint(const WireEndpoint& endpoint) override {
    said[endpoint.options.topic].push_back(endpoint.options.user_data);
  }
  void OnEndpointGone(const WireId&) override {}
  std::map<std::string, std::vector<std::string>> said;
};

// `ros2 topic info -v` and others show it.
TEST_F(CarriedCallsTest, BothEndsSayTheHashesOfRequestsAndOfReplies) {
  Offer();
  Hearer hearer;
  const auto hearing = std::move(*engine_->Join({.name = "hearing"}, hearer));
  WaitUntilQuiet(*engine_);
  const auto says = [](const std::string& hash) {
    return testing::UnorderedElementsAre(testing::MatchesRegex("clientid=[0-9a-f.]*;typehash=" + hash + ";"),
                                         testing::MatchesRegex("serviceid=[0-9a-f.]*;typehash=" + hash + ";"));
  };
  const std::string request = far_->form->request_type().hash, response = far_->form->response_type().hash;
  EXPECT_THAT(request, testing::MatchesRegex("RIHS01_[0-9a-f]{64}"));
  EXPECT_NE(request, response);
  EXPECT_THAT(hearer.said["rq/doubleRequest"], says(request));
  EXPECT_THAT(hearer.said["rr/doubleReply"], says(response));
}

// A client may ask as soon as it has met both ends of a service, which may not have met the reader of its answers yet.
TEST_F(CarriedCallsTest, TheFirstAnswerWaitsForTheReaderOfWhoAsks) {
  DiscoveryTable table([] {});
  const auto serving = std::move(*engine_->Join({.name = "serving"}, table));
  OfferedService offered(runtime_, {.port = "/a/double", .service = "/double"}, MessageLibrary::Standard(),
                         ServiceDialect::kInFront, 2, wake_, &table);
  ASSERT_TRUE(offered.Follow(*serving, [](std::uint64_t) { return true; }));
  const ServiceTopics topics = offered.endpoints()->topics();
  const auto writer = near_->MakeWriter({.topic = DdsRequestTopic("/double"),
                                         .type = topics.request.name,
                                         .qos = {.depth = 10},
                                         .user_data = "clientid=1.2;"},
                                        {});
  WaitUntilQuiet(*engine_);
  Octets message;
  CdrWriter(message).Put(std::int32_t{21});
  ASSERT_TRUE((*writer)->Write(std::make_shared<const Octets>(WithCallId({(*writer)->id(), 1}, message)), 1));
  WaitUntil("it has answered", [&] {
    (void)offered.Work();
    service_.Serve();
    return offered.Text().find("1 answered") != std::string::npos;
  });
  const auto hear = [&](const std::string& user_data, int& heard) {
    auto reader = std::move(*near_->MakeReader(
        {.topic = DdsReplyTopic("/double"), .type = topics.response.name, .qos = {.depth = 10}, .user_data = user_data},
        [&heard](const WireSample&) { ++heard; }, {}));
    WaitUntilQuiet(*engine_);
    (void)offered.Work();
    WaitUntilQuiet(*engine_);
    return reader;
  };
  int others = 0, own = 0;
  const auto other = hear("clientid=1.3;", others);
  EXPECT_EQ(others, 0) << "it is kept for somebody else";
  const auto reader = hear("clientid=1.2;", own);
  EXPECT_EQ(own, 1);
}

TEST_F(CarriedCallsTest, WaitForAServiceThatComesLater) {
  auto call = client_.Begin(4);
  (void)taken_->Work();
  EXPECT_FALSE(call.is_done());
  Offer();
  EXPECT_EQ(*Await(call), 8);
}

// Of a server that does not say which call it answers.
TEST_F(CarriedCallsTest, AreNotEndedByWhatAnswersNoCall) {
  auto call = client_.Begin(4);
  (void)taken_->Work();
  const auto writer = std::move(*there_->MakeWriter(
      {.topic = DdsReplyTopic("/double"), .type = far_->form->response_type().name, .qos = {.depth = 10}}, {}));
  const int wrong = 99;
  Octets message;
  ASSERT_TRUE(far_->form->WriteResponse({.success = true, .message = ""}, &wrong, message));
  ASSERT_TRUE(
      writer->Write(std::make_shared<const Octets>(WithCallId({taken_->endpoints()->writer_id(), 0}, message)), 1));
  WaitUntilQuiet(*engine_);
  (void)taken_->Work();
  EXPECT_FALSE(call.is_done());
  Offer();
  EXPECT_EQ(*Await(call), 8);
}

TEST_F(CarriedCallsTest, AreNotSentIfStopWasPressedWhileTheyWaitForTheService) {
  auto call = client_.Begin(4);
  (void)taken_->Work();
  runtime_.robot_stop().Press("a person");
  ASSERT_TRUE(runtime_.robot_stop().Release("a person"));
  Offer();
  const auto outcome = Await(call);
  EXPECT_EQ(outcome.status(), CallStatus::kFailed);
  EXPECT_THAT(std::string(outcome.error()),
              testing::HasSubstr("STOP was pressed or released after this was asked for"));
  EXPECT_EQ(service_.state().failed + service_.state().answered, 0u) << "it has not come there";
}

TEST_F(CarriedCallsTest, EndWithTheNetwork) {
  auto call = client_.Begin(4);
  (void)taken_->Work();
  taken_.reset();
  EXPECT_EQ(call.outcome().status(), CallStatus::kDisconnected);
}

TEST_F(CarriedCallsTest, FromBeforeAStopAreRefusedThoughNobodyHasTakenThemYet) {
  Offer();
  WaitUntilQuiet(*engine_);  // the two know of each other
  auto call = client_.Begin(21);
  (void)taken_->Work();
  WaitUntilQuiet(*engine_);  // it has come
  PressAndRelease();
  const auto outcome = Await(call);
  EXPECT_EQ(outcome.status(), CallStatus::kFailed);
  EXPECT_THAT(std::string(outcome.error()),
              testing::HasSubstr("STOP was pressed or released after this was asked for"));
  auto again = client_.Begin(21);
  EXPECT_EQ(*Await(again), 42);
  EXPECT_EQ(doubler_.doubled, 1);
}

TEST_F(CarriedCallsTest, FromBeforeAStopAreRefusedThoughTheyComeAfterIt) {
  Offer();
  PressAndRelease();
  const auto writer = std::move(*near_->MakeWriter(
      {.topic = DdsRequestTopic("/double"), .type = offered_->endpoints()->topics().request.name, .qos = {.depth = 10}},
      {}));
  const auto send = [&](std::int64_t number, Duration ago) {
    Octets message;
    CdrWriter(message).Put(std::int32_t{21});
    (void)writer->Write(std::make_shared<const Octets>(WithCallId({writer->id(), number}, message)),
                        (SinceEpoch() - ago).time_since_epoch().count());
    WaitUntilQuiet(*engine_);
    (void)offered_->Work();
    service_.Serve();
    (void)offered_->Work();
  };
  send(1, std::chrono::seconds(20));
  EXPECT_EQ(doubler_.doubled, 0);
  send(2, {});
  EXPECT_EQ(doubler_.doubled, 1);
}

TEST_F(CarriedCallsTest, CostTheCallersCycleNoMemory) {
  Offer();
  auto first = client_.Begin(1);
  (void)Await(first);
  const OwnCycle cycle(runtime_.clock().Now());
  const AllocationGuard guard;
  const CallStatus status = client_.Send(2);
  const auto allocations = guard.allocations();
  EXPECT_EQ(status, CallStatus::kPending);
  EXPECT_EQ(allocations, 0u);
}

}  // namespace
}  // namespace runnel::test
