#include <array>
#include <atomic>
#include <numeric>
#include <string>
#include <thread>
#include <vector>

#include "core/channel/input_queue.h"
#include "tests/core/port/port_fixture.h"
#include "tests/support/threads.h"
#include "tests/support/wait_until.h"

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

// A reader that has begun to take must not be in the way of what comes later.
TEST_F(QueuePortTest, DropOldestKeepsTheNewestOfALongQueueThatHasBeenBegun) {
  auto& sender = MakeSender<int>();
  auto& receiver = MakeReceiver<int>();
  Connect(sender.out, receiver.in, {.queue = 1024, .on_full = OnFull::kDropOldest});
  int sent = 0;
  for (int i = 0; i < 100; ++i) sender.out.Publish(++sent);
  EXPECT_EQ(*receiver.in.Take(), 1);
  for (int i = 0; i < 5000; ++i) EXPECT_EQ(sender.out.Publish(++sent), PublishStatus::kPublished);
  std::vector<int> newest(1024);
  std::iota(newest.begin(), newest.end(), sent - 1024 + 1);
  EXPECT_EQ(TakeAll(receiver.in), newest);
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
  EXPECT_EQ(receiver.in.Drain([&](const Lease<Scan>& scan) { EXPECT_EQ(scan->number, next++); }), 20u);
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

TEST_F(QueuePortTest, TypesThatOwnMemoryPassThroughEachKindOfQueue) {
  auto& sender = MakeSender<Scan>();
  for (const OnFull on_full : {OnFull::kDropOldest, OnFull::kDropNewest, OnFull::kRefuse}) {
    auto& receiver = MakeReceiver<Scan>("receiver" + std::to_string(static_cast<int>(on_full)));
    Connect(sender.out, receiver.in, {.queue = 4, .on_full = on_full});
    (void)TakeAll(receiver.in);
    sender.out.Publish(Scan{{1.0f, 2.0f}, 1});
    sender.out.Publish(Scan{{3.0f}, 2});
    const auto first = receiver.in.Take();
    const auto second = receiver.in.Take();
    ASSERT_TRUE(first && second);
    EXPECT_THAT(first->ranges, ElementsAre(1.0f, 2.0f));
    EXPECT_THAT(second->ranges, ElementsAre(3.0f));
    EXPECT_FALSE(receiver.in.Take());
  }
}

struct Block {
  std::array<std::uint64_t, 16> words{};
};
void Describe(TypeBuilder<Block>& type) { type.Name("test::Block"); }

TEST_F(QueuePortTest, LeaseOfAQueuedCopyLivesOnAndCopies) {
  auto& sender = MakeSender<Block>();
  auto& receiver = MakeReceiver<Block>();
  Connect(sender.out, receiver.in, {.queue = 2, .on_full = OnFull::kRefuse});
  Block block;
  block.words.fill(7);
  sender.out.Publish(block);
  Lease<Block> taken = receiver.in.Take();
  ASSERT_TRUE(taken);
  block.words.fill(8);
  for (int i = 0; i < 100; ++i) {
    sender.out.Publish(block);
    (void)receiver.in.Take();
  }
  Lease<Block> copy = taken;
  const Lease<Block> moved = std::move(taken);
  EXPECT_THAT(moved->words, testing::Each(7u));
  copy = receiver.in.Read();
  EXPECT_THAT(copy->words, testing::Each(8u));
  copy = moved;
  EXPECT_THAT(copy->words, testing::Each(7u));
  EXPECT_EQ(copy.sequence(), 1u);
}

TEST_F(QueuePortTest, PublisherCanAskBeforeItIsRefused) {
  for (const bool two_sources : {false, true}) {
    const std::string number = two_sources ? "2" : "1";
    auto& sender = MakeSender<int>("sender" + number);
    auto& receiver = MakeReceiver<int>("receiver" + number);
    Connect(sender.out, receiver.in, {.queue = 2, .on_full = OnFull::kRefuse});
    auto& other = MakeSender<int>("other" + number);
    if (two_sources) Connect(other.out, receiver.in);
    EXPECT_FALSE(other.out.WouldRefuse());
    for (int i = 1; i <= 2; ++i) {
      EXPECT_FALSE(sender.out.WouldRefuse());
      sender.out.Publish(i);
    }
    EXPECT_TRUE(sender.out.WouldRefuse());
    EXPECT_EQ(receiver.in.dropped(), 0u);
    EXPECT_EQ(*receiver.in.Take(), 1);
    EXPECT_FALSE(sender.out.WouldRefuse());
  }
}

TEST_F(QueuePortTest, OnlyQueuesThatRefuseWouldRefuse) {
  auto& sender = MakeSender<int>();
  auto& receiver = MakeReceiver<int>();
  Connect(sender.out, receiver.in, {.queue = 1, .on_full = OnFull::kDropNewest});
  sender.out.Publish(1);
  EXPECT_FALSE(sender.out.WouldRefuse());
}

// The publisher tries again whenever it is refused: nothing is lost, and all comes in order.
TEST_F(QueuePortTest, NothingIsLostBetweenTwoThreadsIfThePublisherTriesAgain) {
  constexpr std::uint64_t kCount = 20000;
  auto& sender = MakeSender<Block>();
  auto& receiver = MakeReceiver<Block>();
  Connect(sender.out, receiver.in, {.queue = 8, .on_full = OnFull::kRefuse});
  std::uint64_t wrong = 0;
  RunTogether(2, [&](unsigned index) {
    for (std::uint64_t i = 1; i <= kCount; ++i) {
      if (index == 0) {
        Block block;
        block.words.fill(i);
        test::YieldUntil("there is room", [&] { return sender.out.Publish(block) != PublishStatus::kRefused; });
        continue;
      }
      Lease<Block> lease;
      test::YieldUntil("there is a value", [&] { return static_cast<bool>(lease = receiver.in.Take()); });
      for (const std::uint64_t word : lease->words) wrong += word != i;
    }
  });
  EXPECT_EQ(wrong, 0u);
  EXPECT_FALSE(receiver.in.Take());
}

// Connected while the source publishes at full speed: each value once, none out of order, and none
// missing from the first one on.
TEST_F(QueuePortTest, ConnectingUnderLoadNeitherLosesNorRepeats) {
  auto& sender = MakeSender<Block>();
  auto& receiver = MakeReceiver<Block>();
  std::atomic<bool> done{false};
  std::atomic<std::uint64_t> taken{0};
  // More than is published while the reader waits for a processor: a connection forgets at its end what its queue dropped.
  const ConnectOptions long_queue{.queue = 1 << 15, .on_full = OnFull::kDropNewest};
  std::uint64_t disorder = 0, missed = 0;
  RunTogether(3, [&](unsigned index) {
    if (index == 0) {
      Block block;
      for (std::uint64_t i = 1; !done; ++i) {
        block.words.fill(i);
        sender.out.Publish(block);
        if (i % 64 == 0) std::this_thread::yield();
      }
    } else if (index == 1) {
      for (int round = 0; round < 200; ++round) {
        Connect(sender.out, receiver.in, long_queue);
        std::this_thread::yield();
        ASSERT_TRUE(Port::Disconnect(sender.out, receiver.in));
      }
      // The last connection stays until the reader has had its turn.
      Connect(sender.out, receiver.in, long_queue);
      WaitUntil("a value has been taken", [&] { return taken > 0; });
      done = true;
    } else {
      std::uint64_t last = 0;
      while (!done) {
        const Lease<Block> lease = receiver.in.Take();
        if (!lease) {
          std::this_thread::yield();
          continue;
        }
        ++taken;
        // A new connection begins with the last value, which the one before may have delivered.
        disorder += lease->words[0] < last || lease->words[0] != lease->words[15];
        last = lease->words[0];
        if (receiver.in.dropped() == 0) missed += lease.missed();
      }
    }
  });
  EXPECT_EQ(disorder, 0u);
  EXPECT_EQ(missed, 0u);
}

}  // namespace
}  // namespace runnel::test
