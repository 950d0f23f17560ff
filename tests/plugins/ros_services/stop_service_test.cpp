// The STOP of the robot as a service of its node, called as nodes of ROS 2 call it.
#include "plugins/ros_services/stop_service.h"

#include <atomic>
#include <optional>
#include <thread>

#include <gmock/gmock.h>

#include "core/element/runtime.h"
#include "plugins/cdr_values/cdr_stream.h"
#include "plugins/ros_messages/names.h"
#include "plugins/ros_services/ros_time.h"
#include "tests/support/fake_wire.h"
#include "tests/support/wait_until.h"

namespace runnel::test {
namespace {

using std::chrono::seconds;
using testing::HasSubstr;

struct NobodyThere final : WireDiscovery {
  void OnMember(const WireMember&) override {}
  void OnMemberGone(const WireId&) override {}
  void OnEndpoint(const WireEndpoint&) override {}
  void OnEndpointGone(const WireId&) override {}
};

/// Says when it has sent what it sends.
class OtherClient {
 public:
  OtherClient(WireParticipant& participant, ServiceDialect dialect, Duration ago)
      : dialect_(dialect),
        ago_(ago),
        writer_(std::move(*participant.MakeWriter({.topic = DdsRequestTopic("/base/stop"),
                                                   .type = "std_srvs::srv::dds_::SetBool_Request_",
                                                   .qos = {.depth = 10}},
                                                  {}))) {}
  void Send(bool data) {
    Octets message;
    CdrWriter(message).Put(data);
    const std::int64_t time = (SinceEpoch() - ago_).time_since_epoch().count();
    if (dialect_ == ServiceDialect::kBeside) {
      EXPECT_TRUE(writer_->WriteRelated(std::make_shared<const Octets>(message), time, {}));
    } else {
      EXPECT_TRUE(writer_->Write(std::make_shared<const Octets>(WithCallId({writer_->id(), ++calls_}, message)), time));
    }
  }

 private:
  const ServiceDialect dialect_;
  const Duration ago_;
  std::int64_t calls_ = 0;
  const std::unique_ptr<WireWriter> writer_;
};

class StopServiceTest : public testing::TestWithParam<ServiceDialect> {
 protected:
  void Begin(bool may_release) {
    service_ = std::move(*StopService::Start(
        runtime_, may_release, "/base", *there_, GetParam(), [this] { return is_kept_.load(); },
        [this] { return left_ ? Result<void>(*left_) : Result<void>(); }));
    client_ = std::move(*ServiceEndpoints::Start(ServiceEndpoints::Side::kClient,
                                                 {.service = "/base/stop",
                                                  .request = {"std_srvs::srv::dds_::SetBool_Request_"},
                                                  .response = {"std_srvs::srv::dds_::SetBool_Response_"},
                                                  .dialect = GetParam()},
                                                 *near_, 1, [] {}));
    WaitUntil("it is there", [&] { return client_->is_matched(); });
  }
  std::pair<bool, std::string> Call(const Octets& request) {
    EXPECT_TRUE(client_->Request(request));
    std::optional<ServiceMessage> reply;
    WaitUntil("it has answered", [&] { return (reply = client_->Take()).has_value(); });
    std::pair<bool, std::string> answer;
    auto from = CdrReader::Begin(reply->message);
    EXPECT_TRUE(from && from->Get(answer.first) && from->GetText(answer.second));
    return answer;
  }
  std::pair<bool, std::string> Call(bool data) {
    Octets request;
    CdrWriter(request).Put(data);
    return Call(request);
  }

  Runtime runtime_;
  RobotStop& stop_ = runtime_.robot_stop();
  std::atomic<bool> is_kept_{true};
  std::optional<Error> left_;  // of the STOP
  NobodyThere nobody_;
  const std::shared_ptr<WireEngine> engine_ = MakeFakeWire();
  std::unique_ptr<WireParticipant> near_ = std::move(*engine_->Join({.name = "near"}, nobody_));
  std::unique_ptr<WireParticipant> there_ = std::move(*engine_->Join({.name = "there"}, nobody_));
  std::unique_ptr<StopService> service_;
  std::unique_ptr<ServiceEndpoints> client_;
};

TEST_P(StopServiceTest, TrueStopsTheRobotAndFalseDoesNothing) {
  Begin(false);
  const std::lock_guard lock(runtime_.structure_mutex());  // a STOP waits for none
  EXPECT_THAT(Call(true), testing::Pair(true, "the robot is stopped"));
  EXPECT_TRUE(stop_.in_force());
  EXPECT_EQ(stop_.state().by, "the service /base/stop");
  EXPECT_THAT(Call(true), testing::Pair(true, "the robot was stopped already"));
  EXPECT_THAT(Call(false), testing::Pair(false, HasSubstr("stop_releases")));
  EXPECT_TRUE(stop_.in_force());
}

TEST_P(StopServiceTest, SaysWhereTheNextProcessWouldNotKnowOfIt) {
  Begin(true);
  is_kept_ = false;
  EXPECT_THAT(Call(true), testing::Pair(true, "the robot is stopped; the next process would not know of it yet"));
  is_kept_ = true;
  EXPECT_THAT(Call(true), testing::Pair(true, "the robot was stopped already"));
  is_kept_ = false;
  EXPECT_THAT(Call(false), testing::Pair(true, "the STOP is released; the next process would not know of it yet"));
}

TEST_P(StopServiceTest, IsNoSuccessWhereItLeavesSomething) {
  left_ = Error{.message = "STOP is in force, but /base/wheels cannot be reached"};
  Begin(false);
  EXPECT_THAT(Call(true), testing::Pair(false, "STOP is in force, but /base/wheels cannot be reached"));
  EXPECT_TRUE(stop_.in_force());
}

TEST_P(StopServiceTest, FalseReleasesWhereThatIsSaid) {
  Begin(true);
  EXPECT_THAT(Call(false), testing::Pair(false, "STOP is not in force")) << "nothing is released";
  EXPECT_THAT(Call(true), testing::Pair(true, "the robot is stopped"));
  EXPECT_THAT(Call(false), testing::Pair(true, "the STOP is released"));
  EXPECT_FALSE(stop_.in_force());
}

// Each call of `ros2 service call` is one of another client, of which nothing is known.
TEST_P(StopServiceTest, AReleaseThatWasSentBeforeAPressEndsNothing) {
  Begin(true);
  ASSERT_TRUE(stop_.Press("a person"));
  OtherClient late(*near_, GetParam(), seconds(2));
  late.Send(false);
  WaitUntilQuiet(*engine_);
  EXPECT_TRUE(stop_.in_force());
  EXPECT_THAT(Call(false), testing::Pair(true, "the STOP is released")) << "by who knows of it";
  late.Send(true);
  WaitUntilQuiet(*engine_);
  EXPECT_TRUE(stop_.in_force()) << "a STOP is carried out however late it comes";
}

TEST_P(StopServiceTest, AClockThatIsBehindKeepsNobodyFromReleasing) {
  Begin(true);
  ASSERT_TRUE(stop_.Press("a person"));
  OtherClient behind(*near_, GetParam(), seconds(2));
  behind.Send(false);
  std::this_thread::sleep_for(WriterClock::kToKnow + WriterClock::kMostOfNetworks);  // as for people who ask again
  behind.Send(false);
  WaitUntilQuiet(*engine_);
  EXPECT_FALSE(stop_.in_force()) << "the second time it is known to be the clock";
  ASSERT_TRUE(stop_.Press("a person"));
  OtherClient far_behind(*near_, GetParam(), std::chrono::hours(1));
  far_behind.Send(false);
  WaitUntilQuiet(*engine_);
  EXPECT_FALSE(stop_.in_force()) << "nothing is under way for so long";
}

TEST_P(StopServiceTest, WhatIsNoRequestDoesNothing) {
  Begin(true);
  ASSERT_TRUE(stop_.Press("a test"));
  EXPECT_THAT(Call(Octets{}), testing::Pair(false, HasSubstr("SetBool")));
  EXPECT_TRUE(stop_.in_force());
}

INSTANTIATE_TEST_SUITE_P(Dialects, StopServiceTest, testing::Values(ServiceDialect::kInFront, ServiceDialect::kBeside));

}  // namespace
}  // namespace runnel::test
