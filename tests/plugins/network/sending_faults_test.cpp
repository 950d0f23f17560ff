// What there is no memory to send ends nothing, and is sent when there is memory again; a port that goes finds none either.

#include <cstring>
#include <memory>
#include <optional>
#include <utility>

#include "core/lockfree/thread_epoch.h"
#include "core/module/after_cycle.h"
#include "core/module/group.h"
#include "core/port/cycle.h"
#include "core/port/output.h"
#include "plugins/network/offered_port.h"
#include "plugins/testing/fault_injection.h"

namespace runnel::test {
namespace {

constexpr std::size_t kForAWhile = 1000;  // allocations that fail one after the other

/// A member of a network of which there is nothing but what is written.
class Listener final : public WireParticipant {
 public:
  [[nodiscard]] const WireId& id() const noexcept override { return id_; }
  Result<std::unique_ptr<WireWriter>> MakeWriter(const WireEndpointOptions&, OnMatched on_matched) override {
    auto writer = std::make_unique<Writer>(*this);
    on_matched(1);
    return std::unique_ptr<WireWriter>(std::move(writer));
  }
  Result<std::unique_ptr<WireReader>> MakeReader(const WireEndpointOptions&, OnSample, OnMatched) override {
    return Error{.message = "nothing is read here"};
  }

  std::optional<double> heard;  // last

 private:
  struct Writer final : WireWriter {
    explicit Writer(Listener& of) : listener(of) {}
    [[nodiscard]] const WireId& id() const noexcept override { return listener.id_; }
    [[nodiscard]] bool HasReader(std::uint64_t) const override { return true; }
    Result<void> Write(const std::shared_ptr<const Octets>& octets, std::int64_t) override {
      const auto copy = std::make_unique<Octets>(*octets);  // as engines allocate
      double value = 0;
      std::memcpy(&value, copy->data() + 4, sizeof value);
      listener.heard = value;
      return {};
    }
    Listener& listener;
  };
  WireId id_{};
};

/// A velocity that is offered: in STOP its safe value, 0, is sent.
class SendingFaults : public testing::TestWithParam<ValueQuality> {
 protected:
  SendingFaults() {
    (void)runtime_.MakeReady(runtime_.root());
    Offer();
    Publish(1);
    (void)port_->Send(SteadyClock().Now());
  }
  void Offer() {
    OfferOptions options{.topic = "/speed", .quality = GetParam(), .sending = ValueSending::kAfterCycle, .unit = "m/s"};
    port_ = std::make_unique<OfferedPort>(group_, "offer", TypeOf<double>(), "/a/speed", options,
                                          *ValueForm::Make(TypeOf<double>(), ""), ClockOffset{}, wake_);
    EXPECT_TRUE(port_->Begin(listener_));
    const std::lock_guard lock(runtime_.structure_mutex());
    port_->Attach(&speed_);
  }
  void Publish(double value) {
    const OwnCycle cycle(runtime_.clock().Now());
    speed_.Publish(value);
  }
  /// As executors do it.
  void PublishInCycle(double value) {
    const EpochGuard guard;
    const AfterCycleScope after;
    Publish(value);
  }
  /// The network's thread, which is told when to look again, has all sent that is left.
  void SendRest() {
    const Time now = SteadyClock().Now() + std::chrono::seconds(1);
    const auto again = port_->Send(now);
    if (again) (void)port_->Send(*again);
  }
  /// What has been lost is told, as a queue holds what waits no longer.
  void ExpectHeard(double value, bool has_struck) {
    SendRest();
    const auto error = port_->TakeError();
    if (listener_.heard == value) return;
    EXPECT_TRUE(has_struck);
    EXPECT_EQ(GetParam(), ValueQuality::kEach);
    ASSERT_TRUE(error);
    EXPECT_EQ(error->path, "/a/speed");
    EXPECT_NE(error->message.find("a value cannot be sent"), std::string::npos);
  }

  Listener listener_;
  Runtime runtime_;
  Group& group_ = runtime_.Create<Group>(runtime_.root(), "a");
  Output<double> speed_{group_, "speed", {.unit = "m/s"}};
  const std::shared_ptr<WakeEvent> wake_ = std::make_shared<WakeEvent>();
  std::unique_ptr<OfferedPort> port_;
};

TEST_P(SendingFaults, TheNetworksThreadSendsAValueLater) {
  for (const std::size_t further : {std::size_t{0}, kForAWhile}) {
    double value = 1;
    Publish(++value);
    const std::size_t points = AtEachPoint(
        InjectedFault::kAllocation, [&] { (void)port_->Send(SteadyClock().Now()); },
        [&](bool has_struck) {
          ExpectHeard(value, has_struck);
          Publish(++value);
        },
        further);
    EXPECT_GT(points, 2U);
  }
}

TEST_P(SendingFaults, AValueThatACycleCannotSendIsLeftToTheNetworksThread) {
  for (const std::size_t further : {std::size_t{0}, kForAWhile}) {
    double value = 1;
    Publish(++value);
    (void)port_->Send(SteadyClock().Now());
    const std::size_t points = AtEachPoint(
        InjectedFault::kAllocation, [&] { PublishInCycle(++value); },
        [&](bool has_struck) { ExpectHeard(value, has_struck); }, further);
    EXPECT_GT(points, 2U);
  }
}

TEST_P(SendingFaults, AStopSendsTheSafeValueLater) {
  for (const std::size_t further : {std::size_t{0}, kForAWhile}) {
    RobotStop& stop = runtime_.robot_stop();
    const std::size_t points = AtEachPoint(
        InjectedFault::kAllocation, [&] { EXPECT_TRUE(stop.Press("a test")); },
        [&](bool) {
          SendRest();
          EXPECT_EQ(listener_.heard, 0);
          EXPECT_TRUE(stop.Release("a test"));
          Publish(5);
          SendRest();
          EXPECT_EQ(listener_.heard, 5);
          (void)port_->TakeError();
        },
        further);
    EXPECT_GT(points, 2U);
  }
}

// Nobody elsewhere goes on by what was sent before.
TEST_P(SendingFaults, AStopThatThereWasNoMemoryForIsSentWithItsRelease) {
  RobotStop& stop = runtime_.robot_stop();
  FaultInjection injection(InjectedFault::kAllocation, 1, kForAWhile);
  EXPECT_TRUE(stop.Press("a test"));
  injection.End();
  EXPECT_EQ(listener_.heard, 1);
  EXPECT_TRUE(stop.Release("a test"));
  EXPECT_EQ(listener_.heard, 0);
}

TEST_P(SendingFaults, APortIsWithdrawn) {
  const std::size_t points = AtEachPoint(
      InjectedFault::kAllocation, [&] { port_.reset(); }, [&](bool) { Offer(); }, 20);
  EXPECT_GT(points, 0U);
}

INSTANTIATE_TEST_SUITE_P(Qualities, SendingFaults, testing::Values(ValueQuality::kNewest, ValueQuality::kEach));

}  // namespace
}  // namespace runnel::test
