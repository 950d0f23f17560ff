#include "core/base/check.h"
#include "tests/core/port/port_fixture.h"

namespace runnel::test {
namespace {

using LatestValuePortTest = PortTest;

TEST_F(LatestValuePortTest, ReadTellsNoDataThenNewThenOld) {
  auto& sender = MakeSender<double>();
  auto& receiver = MakeReceiver<double>();
  EXPECT_EQ(receiver.in.Read().freshness(), Freshness::kNoData);
  Connect(sender.out, receiver.in);
  EXPECT_EQ(receiver.in.Read().freshness(), Freshness::kNoData);
  sender.out.Publish(1.5);
  const auto first = receiver.in.Read();
  EXPECT_EQ(first.freshness(), Freshness::kNew);
  EXPECT_EQ(*first, 1.5);
  EXPECT_EQ(receiver.in.Read().freshness(), Freshness::kOld);
  sender.out.Publish(1.5);  // the same value published again is new
  EXPECT_EQ(receiver.in.Read().freshness(), Freshness::kNew);
}

TEST_F(LatestValuePortTest, GetCopiesTheNewestValueAndMarksNothingAsRead) {
  auto& sender = MakeSender<double>();
  auto& receiver = MakeReceiver<double>();
  EXPECT_EQ(receiver.in.Get(), 0.0);
  EXPECT_EQ(receiver.in.Get(3.0), 3.0);
  Connect(sender.out, receiver.in);
  EXPECT_EQ(receiver.in.Get(3.0), 3.0);
  sender.out.Publish(1.5);
  EXPECT_EQ(receiver.in.Get(3.0), 1.5);
  EXPECT_EQ(receiver.in.Get(), 1.5);
  EXPECT_TRUE(receiver.in.Read().is_new());
}

TEST_F(LatestValuePortTest, EmptyLeaseCannotBeLookedAt) {
  auto& receiver = MakeReceiver<double>();
  const auto nothing = receiver.in.Read();
  EXPECT_FALSE(nothing);
  EXPECT_FALSE(nothing.is_new());
  EXPECT_THROW(*nothing, ProgrammingError);
  EXPECT_THROW((void)nothing.timestamp(), ProgrammingError);
  EXPECT_EQ(nothing.value_or(3.0), 3.0);
}

TEST_F(LatestValuePortTest, CountsWhatCameAndWentUnseen) {
  auto& sender = MakeSender<int>();
  auto& receiver = MakeReceiver<int>();
  Connect(sender.out, receiver.in);
  for (int i = 1; i <= 3; ++i) sender.out.Publish(i);
  EXPECT_EQ(receiver.in.Read().missed(), 0u);  // nothing had been read before
  for (int i = 4; i <= 8; ++i) sender.out.Publish(i);
  const auto lease = receiver.in.Read();
  EXPECT_EQ(*lease, 8);
  EXPECT_EQ(lease.sequence(), 8u);
  EXPECT_EQ(lease.missed(), 4u);
  EXPECT_EQ(receiver.in.Read().missed(), 0u);
  EXPECT_EQ(sender.out.publications(), 8u);
  EXPECT_EQ(receiver.in.publications(), 8u);
}

TEST_F(LatestValuePortTest, PeekDoesNotMarkAsRead) {
  auto& sender = MakeSender<int>();
  auto& receiver = MakeReceiver<int>();
  Connect(sender.out, receiver.in);
  sender.out.Publish(1);
  EXPECT_EQ(receiver.in.Peek().freshness(), Freshness::kNew);
  EXPECT_EQ(receiver.in.Read().freshness(), Freshness::kNew);
  EXPECT_EQ(receiver.in.Peek().freshness(), Freshness::kOld);
}

TEST_F(LatestValuePortTest, OneWhoConnectsLateReadsTheLastValue) {
  auto& sender = MakeSender<int>();
  sender.out.Publish(7);
  auto& receiver = MakeReceiver<int>();
  Connect(sender.out, receiver.in);
  EXPECT_EQ(*receiver.in.Read(), 7);
}

TEST_F(LatestValuePortTest, EachInputHasItsOwnFreshness) {
  auto& sender = MakeSender<int>();
  auto& first = MakeReceiver<int>("first");
  auto& second = MakeReceiver<int>("second");
  Connect(sender.out, first.in);
  Connect(sender.out, second.in);
  sender.out.Publish(1);
  EXPECT_TRUE(first.in.Read().is_new());
  EXPECT_TRUE(second.in.Read().is_new());
}

TEST_F(LatestValuePortTest, ValueOfALeaseStaysWhenNewerOnesCome) {
  auto& sender = MakeSender<int>();
  auto& receiver = MakeReceiver<int>();
  Connect(sender.out, receiver.in);
  sender.out.Publish(1);
  const auto lease = receiver.in.Read();
  for (int i = 2; i < 20; ++i) sender.out.Publish(i);
  EXPECT_EQ(*lease, 1);
}

TEST_F(LatestValuePortTest, SmallTypeIsLoanedAsAnEmptyValue) {
  auto& sender = MakeSender<int>();
  auto& receiver = MakeReceiver<int>();
  Connect(sender.out, receiver.in);
  auto loan = sender.out.Loan();
  EXPECT_EQ(*loan, 0);
  *loan = 5;
  EXPECT_EQ(sender.out.Publish(std::move(loan)), PublishStatus::kPublished);
  EXPECT_FALSE(loan.has_value());
  EXPECT_EQ(*receiver.in.Read(), 5);
  EXPECT_EQ(sender.out.Publish(std::move(loan)), PublishStatus::kNoBuffer);
}

TEST_F(LatestValuePortTest, ViewersVisitValuesWithoutMarkingThem) {
  auto& sender = MakeSender<int>();
  auto& receiver = MakeReceiver<int>();
  Connect(sender.out, receiver.in);
  const auto look = [](const Port& port) {
    int seen = -1;
    port.VisitLatest([&](const void* value, Time) { seen = *static_cast<const int*>(value); });
    return seen;
  };
  EXPECT_EQ(look(sender.out), -1);
  EXPECT_EQ(look(receiver.in), -1);
  sender.out.Publish(4);
  EXPECT_EQ(look(sender.out), 4);
  EXPECT_EQ(look(receiver.in), 4);
  EXPECT_TRUE(receiver.in.Read().is_new());
}

}  // namespace
}  // namespace runnel::test
