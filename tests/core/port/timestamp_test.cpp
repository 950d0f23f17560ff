// When a value was measured, and when it was published.

#include "core/port/probe_port.h"
#include "tests/core/port/pull_fixture.h"

namespace runnel::test {
namespace {

using namespace std::chrono_literals;

// Each way of travelling: inlined, in buffers but copied in queues, in buffers.
template <typename T>
class TimestampTest : public PortTest {
 protected:
  static constexpr Time kMeasured{2s};
  static constexpr Time kPublished{5s};

  TimestampTest() { clock.Set(kPublished); }
  static void ExpectTimes(const Lease<T>& lease, Time timestamp) {
    ASSERT_TRUE(lease);
    EXPECT_EQ(lease.timestamp(), timestamp);
    EXPECT_EQ(lease.publication_time(), kPublished);
  }

  Sender<T>& sender = MakeSender<T>();
  Receiver<T>& receiver = MakeReceiver<T>();
};
using TimedTypes = testing::Types<int, Stubborn, Scan, Image>;
TYPED_TEST_SUITE(TimestampTest, TimedTypes);

TYPED_TEST(TimestampTest, IsThatOfThePublicationIfNobodySaysAnother) {
  this->Connect(this->sender.out, this->receiver.in);
  this->sender.out.Publish(TypeParam{});
  this->ExpectTimes(this->receiver.in.Read(), this->kPublished);
}

TYPED_TEST(TimestampTest, IsWhatThePublisherSaysHoweverItPublishes) {
  this->Connect(this->sender.out, this->receiver.in, {.queue = 4});
  const TypeParam value{};
  this->sender.out.Publish(value, this->kMeasured);
  this->ExpectTimes(this->receiver.in.Read(), this->kMeasured);
  this->ExpectTimes(this->receiver.in.Peek(), this->kMeasured);
  this->sender.out.Publish(TypeParam{}, this->kMeasured + 1s);
  this->ExpectTimes(this->receiver.in.Read(), this->kMeasured + 1s);
  this->sender.out.Publish(this->sender.out.Loan(), this->kMeasured - 1s);
  this->ExpectTimes(this->receiver.in.Read(), this->kMeasured - 1s);
  ASSERT_TRUE(this->sender.out.PublishFilled([](void*) -> Result<void> { return {}; }, this->kMeasured + 2s));
  this->ExpectTimes(this->receiver.in.Read(), this->kMeasured + 2s);
  for (const Duration later : {0s, 1s, -1s, 2s}) {
    this->ExpectTimes(this->receiver.in.Take(), this->kMeasured + later);
  }
}

TYPED_TEST(TimestampTest, OneValueHasAnotherAndTheNextHasNone) {
  this->Connect(this->sender.out, this->receiver.in);
  for (int i = 0; i < 20; ++i) {  // each cell and each buffer in turn
    this->sender.out.Publish(TypeParam{}, this->kMeasured);
    this->ExpectTimes(this->receiver.in.Read(), this->kMeasured);
    this->sender.out.Publish(TypeParam{});
    this->ExpectTimes(this->receiver.in.Read(), this->kPublished);
  }
}

TYPED_TEST(TimestampTest, ProbesAndViewersSeeBoth) {
  ProbePort probe(this->runtime.root(), "probe", TypeOf<TypeParam>());
  this->Connect(this->sender.out, this->receiver.in);
  this->sender.out.Publish(TypeParam{}, this->kMeasured);
  this->Connect(this->sender.out, probe);
  this->sender.out.Publish(TypeParam{}, this->kMeasured + 1s);
  std::vector<Time> seen;
  const Port::Visitor look = [&](const void*, ValueTimes times) {
    seen.push_back(times.timestamp);
    EXPECT_EQ(times.publication_time, this->kPublished);
  };
  while (probe.Take(look)) {
  }
  EXPECT_TRUE(this->sender.out.VisitLatest(look));
  EXPECT_TRUE(this->receiver.in.VisitLatest(look));
  const Time last = this->kMeasured + 1s;
  EXPECT_THAT(seen, testing::ElementsAre(this->kMeasured, last, last, last));
}

TYPED_TEST(TimestampTest, AConnectionThatComesLaterDeliversIt) {
  this->sender.out.Publish(TypeParam{}, this->kMeasured);
  this->Connect(this->sender.out, this->receiver.in, {.queue = 4});
  this->ExpectTimes(this->receiver.in.Take(), this->kMeasured);
}

TYPED_TEST(TimestampTest, AProviderMaySayIt) {
  auto& pullable = this->template MakeSender<TypeParam>("pullable", kPullable);
  auto& puller = this->template MakeReceiver<TypeParam>("puller", kPulls);
  this->Connect(pullable.out, puller.in);
  bool says_so = true;
  pullable.out.SetProvider([&](TypeParam&, std::optional<Time>& timestamp) {
    if (says_so) timestamp = this->kMeasured;
    return true;
  });
  this->ExpectTimes(puller.in.Read(), this->kMeasured);
  says_so = false;
  this->ExpectTimes(puller.in.Read(), this->kPublished);
}

// It would never grow old.
TYPED_TEST(TimestampTest, WhatIsStillToComeCountsAsNow) {
  this->Connect(this->sender.out, this->receiver.in);
  this->sender.out.Publish(TypeParam{}, this->kPublished + 50ms);
  this->ExpectTimes(this->receiver.in.Read(), this->kPublished);
  EXPECT_FALSE(this->sender.out.stamps_ahead()) << "as where a cycle measures";
  const CycleScope cycle({.now = this->kPublished});
  this->sender.out.Publish(TypeParam{}, this->kPublished + 1h);
  this->ExpectTimes(this->receiver.in.Read(), this->kPublished);
  EXPECT_TRUE(this->sender.out.stamps_ahead());
}

TYPED_TEST(TimestampTest, WhatIsFilledOrPulledIsNotToComeEither) {
  auto& pullable = this->template MakeSender<TypeParam>("pullable", kPullable);
  auto& puller = this->template MakeReceiver<TypeParam>("puller", kPulls);
  this->Connect(pullable.out, puller.in);
  pullable.out.SetProvider([&](TypeParam&, std::optional<Time>& timestamp) {
    timestamp = this->kPublished + 1h;
    return true;
  });
  this->ExpectTimes(puller.in.Read(), this->kPublished);
  this->Connect(this->sender.out, this->receiver.in);
  const auto filled = this->sender.out.PublishFilled([](void*) -> Result<void> { return {}; }, this->kPublished + 1h);
  ASSERT_TRUE(filled) << filled.error().ToString();
  this->ExpectTimes(this->receiver.in.Read(), this->kPublished);
  EXPECT_TRUE(this->sender.out.stamps_ahead());
}

// Its age would be too long for a Duration, and negative then.
TYPED_TEST(TimestampTest, WhatIsSaidToBeFromLongAgoIsOld) {
  this->Connect(this->sender.out, this->receiver.in);
  const CycleScope cycle({.now = this->kPublished});
  for (const Time stamp : {Time::min(), Time(-kFarthest) - 1ns, Time(-kFarthest)}) {
    this->sender.out.Publish(TypeParam{}, stamp);
    const auto read = this->receiver.in.Read();
    EXPECT_EQ(read.timestamp(), Time(-kFarthest));
    EXPECT_GT(CurrentCycle()->now - read.timestamp(), 1h);
  }
  EXPECT_FALSE(this->sender.out.stamps_ahead());
}

// Of several sources the value published last counts, however old it is.
TYPED_TEST(TimestampTest, DoesNotDecideWhichOfSeveralSourcesCounts) {
  auto& other = this->template MakeSender<TypeParam>("other");
  this->sender.out.Publish(TypeParam{}, this->kMeasured + 9s);
  this->clock.Advance(1s);
  other.out.Publish(TypeParam{}, this->kMeasured);
  this->Connect(this->sender.out, this->receiver.in);
  this->Connect(other.out, this->receiver.in);
  EXPECT_EQ(this->receiver.in.Read().timestamp(), this->kMeasured);
  this->clock.Advance(1s);
  this->sender.out.Publish(TypeParam{}, this->kMeasured - 1s);
  EXPECT_EQ(this->receiver.in.Read().timestamp(), this->kMeasured - 1s);
}

TEST_F(PortTest, WhatIsPublishedIsAsOldAsTheOldestMeasurementReadInTheCycle) {
  auto& laser = MakeSender<double>("laser");
  auto& goal = MakeSender<double>("goal");
  auto& scan = MakeReceiver<double>("scan", {.ageing = Ageing::kTimesOut});
  auto& target = MakeReceiver<double>("target", {.ageing = Ageing::kSetOnce});
  auto& command = MakeSender<double>("command");
  auto& drive = MakeReceiver<double>("drive");
  Connect(laser.out, scan.in);
  Connect(goal.out, target.in);
  Connect(command.out, drive.in);
  clock.Set(Time(5s));
  goal.out.Publish(1.0, Time(1s));
  laser.out.Publish(2.0, Time(5s));
  const CycleScope cycle({.now = Time(20s)});
  command.out.Publish(0.0);
  EXPECT_EQ(drive.in.Read().timestamp(), Time(20s)) << "nothing has been read";
  (void)target.in.Read();
  (void)scan.in.Get();
  command.out.Publish(1.0);
  EXPECT_EQ(drive.in.Read().timestamp(), Time(5s));
  EXPECT_EQ(drive.in.Read().publication_time(), Time(20s));
  command.out.Publish(1.0, Time(15s));
  EXPECT_EQ(drive.in.Read().timestamp(), Time(15s)) << "who knows better says so";
  internal::BeginModule();
  command.out.Publish(1.0);
  EXPECT_EQ(drive.in.Read().timestamp(), Time(20s)) << "another module has read nothing";
}

}  // namespace
}  // namespace runnel::test
