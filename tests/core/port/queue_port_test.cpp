#include "tests/core/port/port_fixture.h"

namespace runnel::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using QueuePortTest = PortTest;

TEST_F(QueuePortTest, EachValueIsTakenOnceInOrder) {
  auto& sender = MakeSender<int>();
  auto& receiver = MakeReceiver<int>();
  Connect(sender.out, receiver.in, {.queue = 4});
  EXPECT_FALSE(receiver.in.Take());
  for (int i = 1; i <= 3; ++i) sender.out.Publish(i);
  const auto first = receiver.in.Take();
  EXPECT_EQ(*first, 1);
  EXPECT_EQ(first.freshness(), Freshness::kNew);
  EXPECT_EQ(first.sequence(), 1u);
  EXPECT_THAT(TakeAll(receiver.in), ElementsAre(2, 3));
  EXPECT_FALSE(receiver.in.Take());
}

TEST_F(QueuePortTest, TakingAndReadingDoNotDisturbEachOther) {
  auto& sender = MakeSender<int>();
  auto& receiver = MakeReceiver<int>();
  Connect(sender.out, receiver.in, {.queue = 4});
  sender.out.Publish(1);
  sender.out.Publish(2);
  EXPECT_EQ(*receiver.in.Read(), 2);
  EXPECT_THAT(TakeAll(receiver.in), ElementsAre(1, 2));
  EXPECT_EQ(receiver.in.Read().freshness(), Freshness::kOld);
}

TEST_F(QueuePortTest, WithoutAQueueThereIsNothingToTake) {
  auto& sender = MakeSender<int>();
  auto& receiver = MakeReceiver<int>();
  Connect(sender.out, receiver.in);
  sender.out.Publish(1);
  EXPECT_FALSE(receiver.in.Take());
  EXPECT_EQ(receiver.in.dropped(), 0u);
}

TEST_F(QueuePortTest, DropOldestKeepsTheNewestAndCounts) {
  auto& sender = MakeSender<int>();
  auto& receiver = MakeReceiver<int>();
  Connect(sender.out, receiver.in, {.queue = 3, .on_full = OnFull::kDropOldest});
  for (int i = 1; i <= 8; ++i) EXPECT_EQ(sender.out.Publish(i), PublishStatus::kPublished);
  EXPECT_EQ(receiver.in.dropped(), 5u);
  EXPECT_THAT(TakeAll(receiver.in), ElementsAre(6, 7, 8));
}

TEST_F(QueuePortTest, DropNewestKeepsWhatItHasAndCounts) {
  auto& sender = MakeSender<int>();
  auto& receiver = MakeReceiver<int>();
  Connect(sender.out, receiver.in, {.queue = 3, .on_full = OnFull::kDropNewest});
  for (int i = 1; i <= 8; ++i) EXPECT_EQ(sender.out.Publish(i), PublishStatus::kPublished);
  EXPECT_EQ(receiver.in.dropped(), 5u);
  EXPECT_THAT(TakeAll(receiver.in), ElementsAre(1, 2, 3));
  EXPECT_EQ(*receiver.in.Read(), 8);  // the latest value is there nevertheless
}

TEST_F(QueuePortTest, RefusingQueueTellsThePublisher) {
  auto& sender = MakeSender<int>();
  auto& receiver = MakeReceiver<int>();
  Connect(sender.out, receiver.in, {.queue = 2, .on_full = OnFull::kRefuse});
  EXPECT_EQ(sender.out.Publish(1), PublishStatus::kPublished);
  EXPECT_EQ(sender.out.Publish(2), PublishStatus::kPublished);
  EXPECT_EQ(sender.out.Publish(3), PublishStatus::kRefused);
  EXPECT_EQ(receiver.in.dropped(), 1u);
  EXPECT_EQ(*receiver.in.Take(), 1);
  EXPECT_EQ(sender.out.Publish(4), PublishStatus::kPublished);
  EXPECT_THAT(TakeAll(receiver.in), ElementsAre(2, 4));
}

TEST_F(QueuePortTest, TakeTellsHowManyOfTheSourceWereLostBetween) {
  auto& sender = MakeSender<int>();
  auto& receiver = MakeReceiver<int>();
  Connect(sender.out, receiver.in, {.queue = 2});
  sender.out.Publish(1);
  EXPECT_EQ(receiver.in.Take().missed(), 0u);
  for (int i = 2; i <= 6; ++i) sender.out.Publish(i);
  const auto lease = receiver.in.Take();
  EXPECT_EQ(*lease, 5);
  EXPECT_EQ(lease.missed(), 3u);
  EXPECT_EQ(receiver.in.Take().missed(), 0u);
}

TEST_F(QueuePortTest, NewConnectionDeliversTheLastValueOnce) {
  auto& sender = MakeSender<int>();
  auto& receiver = MakeReceiver<int>();
  sender.out.Publish(1);
  sender.out.Publish(2);
  Connect(sender.out, receiver.in, {.queue = 4});
  sender.out.Publish(3);
  EXPECT_THAT(TakeAll(receiver.in), ElementsAre(2, 3));
}

TEST_F(QueuePortTest, LongerQueueTakesOverWhatWaits) {
  auto& sender = MakeSender<int>("first");
  auto& second = MakeSender<int>("second");
  auto& receiver = MakeReceiver<int>();
  Connect(sender.out, receiver.in, {.queue = 2});
  sender.out.Publish(1);
  sender.out.Publish(2);
  Connect(second.out, receiver.in, {.queue = 8});
  sender.out.Publish(3);
  second.out.Publish(40);
  EXPECT_THAT(TakeAll(receiver.in), ElementsAre(1, 2, 3, 40));
}

TEST_F(QueuePortTest, PoolHasRoomForAllThatMayWait) {
  auto& sender = MakeSender<Scan>("sender", {.pool = {.buffers = 2, .may_grow = false}});
  auto& receiver = MakeReceiver<Scan>();
  Connect(sender.out, receiver.in, {.queue = 20});
  for (int i = 0; i < 20; ++i) {
    ASSERT_EQ(sender.out.Publish(Scan{{}, i}), PublishStatus::kPublished);
  }
  int next = 0;
  EXPECT_EQ(receiver.in.Drain([&](const Lease<Scan>& scan) { EXPECT_EQ(scan->number, next++); }),
            20u);
}

TEST_F(QueuePortTest, DisconnectedInputHasNothingToTake) {
  auto& sender = MakeSender<Scan>();
  auto& receiver = MakeReceiver<Scan>();
  Connect(sender.out, receiver.in, {.queue = 4});
  sender.out.Publish(Scan{});
  ASSERT_TRUE(Port::Disconnect(sender.out, receiver.in));
  EXPECT_FALSE(receiver.in.Take());
  EXPECT_FALSE(receiver.in.Read());
  EXPECT_THAT(receiver.in.incoming(), IsEmpty());
}

}  // namespace
}  // namespace runnel::test
