#include "core/port/tap.h"

#include <atomic>
#include <thread>
#include <vector>

#include "core/types/type_of.h"
#include "tests/core/port/port_fixture.h"
#include "tests/support/threads.h"

namespace runnel::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

class TapTest : public PortTest {
 protected:
  template <typename T>
  std::unique_ptr<Tap> MakeTap(std::size_t room = Tap::kRoom) {
    return std::make_unique<Tap>(box, "tap" + std::to_string(++made), TypeOf<T>(), room);
  }

  Box& box = runtime.Create<Box>(runtime.root(), "recorder");
  int made = 0;
};

std::vector<int> TakeAllInts(Tap& tap) {
  std::vector<int> values;
  while (tap.Take(
      [&](const void* value, Time) { values.push_back(*static_cast<const int*>(value)); })) {
  }
  return values;
}

TEST_F(TapTest, EachValueOfAnUnknownTypeIsTakenOnceInOrderWithItsTime) {
  auto& sender = MakeSender<int>();
  const auto tap = MakeTap<int>();
  Connect(sender.out, *tap);
  std::vector<std::pair<int, Time>> taken;
  for (int i = 1; i <= 3; ++i) {
    clock.Set(Time(Duration(i * 10)));
    sender.out.Publish(i);
  }
  EXPECT_EQ(tap->waiting(), 3u);
  while (tap->Take([&](const void* value, Time stamp) {
    taken.emplace_back(*static_cast<const int*>(value), stamp);
  })) {
  }
  EXPECT_THAT(taken, ElementsAre(std::pair(1, Time(Duration(10))), std::pair(2, Time(Duration(20))),
                                 std::pair(3, Time(Duration(30)))));
}

TEST_F(TapTest, WhatTravelsInBuffersIsNotCopiedAndItsBufferIsKeptMeanwhile) {
  auto& sender = MakeSender<Scan>("sender", {.pool = {.buffers = 2}});
  const auto tap = MakeTap<Scan>();
  Connect(sender.out, *tap);
  std::vector<const void*> published;
  for (int i = 1; i <= 5; ++i) {
    auto loan = sender.out.Loan();
    loan->number = i;
    published.push_back(&*loan);
    sender.out.Publish(std::move(loan));
  }
  std::vector<const void*> taken;
  std::vector<int> numbers;
  while (tap->Take([&](const void* value, Time) {
    taken.push_back(value);
    numbers.push_back(static_cast<const Scan*>(value)->number);
  })) {
  }
  EXPECT_EQ(taken, published);
  EXPECT_THAT(numbers, ElementsAre(1, 2, 3, 4, 5));
  EXPECT_EQ(sender.out.growths(), 0u);  // connecting has reserved what can wait
}

TEST_F(TapTest, TakesValuesThatCanNeitherBeCopiedNorMoved) {
  auto& sender = runtime.Create<Sender<Sealed>>(runtime.root(), "sealed", OutputOptions{},
                                                [] { return Sealed(7); });
  const auto tap = MakeTap<Sealed>();
  Connect(sender.out, *tap);
  auto loan = sender.out.Loan();
  loan->number = 9;
  sender.out.Publish(std::move(loan));
  int number = 0;
  EXPECT_TRUE(tap->Take(
      [&](const void* value, Time) { number = static_cast<const Sealed*>(value)->number; }));
  EXPECT_EQ(number, 9);
}

TEST_F(TapTest, AConnectionDeliversTheNewestValueOnceAndAgainOnlyIfThereIsANewOne) {
  auto& sender = MakeSender<int>();
  const auto tap = MakeTap<int>();
  sender.out.Publish(1);
  sender.out.Publish(2);
  Connect(sender.out, *tap);
  sender.out.Publish(3);
  EXPECT_THAT(TakeAllInts(*tap), ElementsAre(2, 3));
  ASSERT_TRUE(Port::Disconnect(sender.out, *tap));
  Connect(sender.out, *tap);
  EXPECT_THAT(TakeAllInts(*tap), IsEmpty());
  ASSERT_TRUE(Port::Disconnect(sender.out, *tap));
  sender.out.Publish(4);
  Connect(sender.out, *tap);
  EXPECT_THAT(TakeAllInts(*tap), ElementsAre(4));
}

TEST_F(TapTest, WhatHasNoRoomIsCountedAndNotRefusedToThePublisher) {
  auto& sender = MakeSender<int>();
  auto& scans = MakeSender<Scan>("scans");
  const auto tap = MakeTap<int>(2);
  const auto scan_tap = MakeTap<Scan>(2);
  Connect(sender.out, *tap);
  Connect(scans.out, *scan_tap);
  for (int i = 1; i <= 5; ++i) {
    EXPECT_EQ(sender.out.Publish(i), PublishStatus::kPublished);
    EXPECT_EQ(scans.out.Publish(Scan{{}, i}), PublishStatus::kPublished);
    EXPECT_FALSE(sender.out.WouldRefuse());
  }
  EXPECT_THAT(TakeAllInts(*tap), ElementsAre(1, 2));
  EXPECT_EQ(tap->dropped(), 3u);
  EXPECT_EQ(scan_tap->dropped(), 3u);
  EXPECT_EQ(scan_tap->waiting(), 2u);
}

TEST_F(TapTest, InputsWithQueuesAndTapsDoNotDisturbEachOther) {
  auto& sender = MakeSender<Scan>();
  auto& receiver = MakeReceiver<Scan>();
  const auto tap = MakeTap<Scan>(1);
  Connect(sender.out, receiver.in, {.queue = 4, .on_full = OnFull::kRefuse});
  Connect(sender.out, *tap);
  for (int i = 1; i <= 4; ++i) {
    EXPECT_EQ(sender.out.Publish(Scan{{}, i}), PublishStatus::kPublished);
  }
  EXPECT_EQ(sender.out.Publish(Scan{{}, 5}), PublishStatus::kRefused);
  std::vector<int> numbers;
  receiver.in.Drain([&](const Lease<Scan>& lease) { numbers.push_back(lease->number); });
  EXPECT_THAT(numbers, ElementsAre(1, 2, 3, 4));
  EXPECT_TRUE(tap->Take([](const void*, Time) {}));
  EXPECT_FALSE(tap->Take([](const void*, Time) {}));
}

TEST_F(TapTest, WhatWaitsOutlivesItsPublisherAndIsGivenBackWithTheTap) {
  auto tap = MakeTap<Scan>();
  {
    auto& sender = MakeSender<Scan>();
    Connect(sender.out, *tap);
    sender.out.Publish(Scan{{1, 2, 3}, 7});
    ASSERT_TRUE(runtime.Delete(sender));
  }
  int number = 0;
  std::size_t ranges = 0;
  EXPECT_TRUE(tap->Take([&](const void* value, Time) {
    number = static_cast<const Scan*>(value)->number;
    ranges = static_cast<const Scan*>(value)->ranges.size();
  }));
  EXPECT_EQ(number, 7);
  EXPECT_EQ(ranges, 3u);
}

TEST_F(TapTest, GoesOnWhereAnotherOutputTakesOver) {
  auto& first = MakeSender<int>("first");
  auto& second = MakeSender<int>("second");
  const auto tap = MakeTap<int>();
  Connect(first.out, *tap);
  first.out.Publish(1);
  second.out.TakeOver(first.out);
  second.out.Publish(2);
  first.out.Publish(9);
  EXPECT_THAT(TakeAllInts(*tap), ElementsAre(1, 2));
}

TEST_F(TapTest, TakesFromSeveralSources) {
  auto& first = MakeSender<int>("first");
  auto& second = MakeSender<int>("second");
  const auto tap = MakeTap<int>();
  Connect(first.out, *tap);
  Connect(second.out, *tap);
  first.out.Publish(1);
  second.out.Publish(2);
  first.out.Publish(3);
  EXPECT_THAT(TakeAllInts(*tap), ElementsAre(1, 2, 3));
  EXPECT_EQ(tap->publications(), 3u);
}

TEST_F(TapTest, WakesWhoWaits) {
  auto& sender = MakeSender<int>();
  const auto tap = MakeTap<int>();
  Connect(sender.out, *tap);
  EXPECT_FALSE(tap->Wait(Duration::zero()));
  std::thread publisher([&] { sender.out.Publish(5); });
  EXPECT_TRUE(tap->Wait(std::chrono::seconds(20)));
  publisher.join();
  EXPECT_THAT(TakeAllInts(*tap), ElementsAre(5));
}

TEST_F(TapTest, LosesAndRepeatsNothingWhileItIsConnectedAgainAndAgain) {
  constexpr int kValues = 20000;
  auto& sender = MakeSender<Scan>("sender", {.pool = {.buffers = 64}});
  const auto tap = MakeTap<Scan>(64);
  Connect(sender.out, *tap);
  std::atomic<bool> is_over{false};
  std::thread publisher([&] {
    for (int i = 1; i <= kValues; ++i) sender.out.Publish(Scan{{}, i});
    is_over = true;
  });
  int last = 0;
  int taken = 0;
  const auto take = [&] {
    while (tap->Take([&](const void* value, Time) {
      const int number = static_cast<const Scan*>(value)->number;
      EXPECT_GT(number, last);
      last = number;
      ++taken;
    })) {
    }
  };
  const auto connect_again = [&] {
    take();
    ASSERT_TRUE(Port::Disconnect(sender.out, *tap));
    take();
    Connect(sender.out, *tap);
  };
  while (!is_over) connect_again();
  publisher.join();
  connect_again();
  take();
  EXPECT_EQ(last, kValues);  // a new connection brings the newest
  EXPECT_LE(static_cast<std::uint64_t>(taken) + tap->dropped(), 2u * kValues);
  EXPECT_GT(taken, 0);
}

}  // namespace
}  // namespace runnel::test
