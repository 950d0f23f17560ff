#include "core/port/probe_port.h"

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

class ProbePortTest : public PortTest {
 protected:
  template <typename T>
  std::unique_ptr<ProbePort> MakeProbe(std::size_t capacity = ProbePort::kCapacity) {
    return std::make_unique<ProbePort>(box, "probe" + std::to_string(++made), TypeOf<T>(), capacity);
  }

  Box& box = runtime.Create<Box>(runtime.root(), "recorder");
  int made = 0;
};

std::vector<int> TakeAllInts(ProbePort& probe) {
  std::vector<int> values;
  while (probe.Take([&](const void* value, Time) { values.push_back(*static_cast<const int*>(value)); })) {
  }
  return values;
}

TEST_F(ProbePortTest, EachValueOfAnUnknownTypeIsTakenOnceInOrderWithItsTime) {
  auto& sender = MakeSender<int>();
  const auto probe = MakeProbe<int>();
  Connect(sender.out, *probe);
  std::vector<std::pair<int, Time>> taken;
  for (int i = 1; i <= 3; ++i) {
    clock.Set(Time(Duration(i * 10)));
    sender.out.Publish(i);
  }
  EXPECT_EQ(probe->waiting(), 3u);
  while (probe->Take(
      [&](const void* value, Time timestamp) { taken.emplace_back(*static_cast<const int*>(value), timestamp); })) {
  }
  EXPECT_THAT(taken, ElementsAre(std::pair(1, Time(Duration(10))), std::pair(2, Time(Duration(20))),
                                 std::pair(3, Time(Duration(30)))));
}

TEST_F(ProbePortTest, WhatTravelsInBuffersIsNotCopiedAndItsBufferIsKeptMeanwhile) {
  auto& sender = MakeSender<Scan>("sender", {.pool = {.buffers = 2}});
  const auto probe = MakeProbe<Scan>();
  Connect(sender.out, *probe);
  std::vector<const void*> published;
  for (int i = 1; i <= 5; ++i) {
    auto loan = sender.out.Loan();
    loan->number = i;
    published.push_back(&*loan);
    sender.out.Publish(std::move(loan));
  }
  std::vector<const void*> taken;
  std::vector<int> numbers;
  while (probe->Take([&](const void* value, Time) {
    taken.push_back(value);
    numbers.push_back(static_cast<const Scan*>(value)->number);
  })) {
  }
  EXPECT_EQ(taken, published);
  EXPECT_THAT(numbers, ElementsAre(1, 2, 3, 4, 5));
  EXPECT_EQ(sender.out.growths(), 0u);  // connecting has reserved what can wait
}

TEST_F(ProbePortTest, TakesValuesThatCanNeitherBeCopiedNorMoved) {
  auto& sender = runtime.Create<Sender<Sealed>>(runtime.root(), "sealed", OutputOptions{}, [] { return Sealed(7); });
  const auto probe = MakeProbe<Sealed>();
  Connect(sender.out, *probe);
  auto loan = sender.out.Loan();
  loan->number = 9;
  sender.out.Publish(std::move(loan));
  int number = 0;
  EXPECT_TRUE(probe->Take([&](const void* value, Time) { number = static_cast<const Sealed*>(value)->number; }));
  EXPECT_EQ(number, 9);
}

TEST_F(ProbePortTest, AConnectionDeliversTheNewestValueOnceAndAgainOnlyIfThereIsANewOne) {
  auto& sender = MakeSender<int>();
  const auto probe = MakeProbe<int>();
  sender.out.Publish(1);
  sender.out.Publish(2);
  Connect(sender.out, *probe);
  sender.out.Publish(3);
  EXPECT_THAT(TakeAllInts(*probe), ElementsAre(2, 3));
  ASSERT_TRUE(Port::Disconnect(sender.out, *probe));
  Connect(sender.out, *probe);
  EXPECT_THAT(TakeAllInts(*probe), IsEmpty());
  ASSERT_TRUE(Port::Disconnect(sender.out, *probe));
  sender.out.Publish(4);
  Connect(sender.out, *probe);
  EXPECT_THAT(TakeAllInts(*probe), ElementsAre(4));
}

TEST_F(ProbePortTest, WhatHasNoRoomIsCountedAndNotRefusedToThePublisher) {
  auto& sender = MakeSender<int>();
  auto& scans = MakeSender<Scan>("scans");
  const auto probe = MakeProbe<int>(2);
  const auto scan_probe = MakeProbe<Scan>(2);
  Connect(sender.out, *probe);
  Connect(scans.out, *scan_probe);
  for (int i = 1; i <= 5; ++i) {
    EXPECT_EQ(sender.out.Publish(i), PublishStatus::kPublished);
    EXPECT_EQ(scans.out.Publish(Scan{{}, i}), PublishStatus::kPublished);
    EXPECT_FALSE(sender.out.WouldRefuse());
  }
  EXPECT_THAT(TakeAllInts(*probe), ElementsAre(1, 2));
  EXPECT_EQ(probe->dropped(), 3u);
  EXPECT_EQ(scan_probe->dropped(), 3u);
  EXPECT_EQ(scan_probe->waiting(), 2u);
}

TEST_F(ProbePortTest, InputsWithQueuesAndProbesDoNotDisturbEachOther) {
  auto& sender = MakeSender<Scan>();
  auto& receiver = MakeReceiver<Scan>();
  const auto probe = MakeProbe<Scan>(1);
  Connect(sender.out, receiver.in, {.queue = 4, .on_full = OnFull::kRefuse});
  Connect(sender.out, *probe);
  for (int i = 1; i <= 4; ++i) {
    EXPECT_EQ(sender.out.Publish(Scan{{}, i}), PublishStatus::kPublished);
  }
  EXPECT_EQ(sender.out.Publish(Scan{{}, 5}), PublishStatus::kRefused);
  std::vector<int> numbers;
  receiver.in.Drain([&](const Lease<Scan>& lease) { numbers.push_back(lease->number); });
  EXPECT_THAT(numbers, ElementsAre(1, 2, 3, 4));
  EXPECT_TRUE(probe->Take([](const void*, Time) {}));
  EXPECT_FALSE(probe->Take([](const void*, Time) {}));
}

TEST_F(ProbePortTest, WhatWaitsOutlivesItsPublisherAndIsGivenBackWithTheProbe) {
  auto probe = MakeProbe<Scan>();
  {
    auto& sender = MakeSender<Scan>();
    Connect(sender.out, *probe);
    sender.out.Publish(Scan{{1, 2, 3}, 7});
    ASSERT_TRUE(runtime.Delete(sender));
  }
  int number = 0;
  std::size_t ranges = 0;
  EXPECT_TRUE(probe->Take([&](const void* value, Time) {
    number = static_cast<const Scan*>(value)->number;
    ranges = static_cast<const Scan*>(value)->ranges.size();
  }));
  EXPECT_EQ(number, 7);
  EXPECT_EQ(ranges, 3u);
}

TEST_F(ProbePortTest, GoesOnWhereAnotherOutputTakesOver) {
  auto& first = MakeSender<int>("first");
  auto& second = MakeSender<int>("second");
  const auto probe = MakeProbe<int>();
  Connect(first.out, *probe);
  first.out.Publish(1);
  second.out.TakeOver(first.out);
  second.out.Publish(2);
  first.out.Publish(9);
  EXPECT_THAT(TakeAllInts(*probe), ElementsAre(1, 2));
}

TEST_F(ProbePortTest, TakesFromSeveralSources) {
  auto& first = MakeSender<int>("first");
  auto& second = MakeSender<int>("second");
  const auto probe = MakeProbe<int>();
  Connect(first.out, *probe);
  Connect(second.out, *probe);
  first.out.Publish(1);
  second.out.Publish(2);
  first.out.Publish(3);
  EXPECT_THAT(TakeAllInts(*probe), ElementsAre(1, 2, 3));
  EXPECT_EQ(probe->publications(), 3u);
}

TEST_F(ProbePortTest, WakesWhoWaits) {
  auto& sender = MakeSender<int>();
  const auto probe = MakeProbe<int>();
  Connect(sender.out, *probe);
  EXPECT_FALSE(probe->Wait(Duration::zero()));
  std::thread publisher([&] { sender.out.Publish(5); });
  EXPECT_TRUE(probe->Wait(std::chrono::seconds(20)));
  publisher.join();
  EXPECT_THAT(TakeAllInts(*probe), ElementsAre(5));
}

TEST_F(ProbePortTest, LosesAndRepeatsNothingWhileItIsConnectedAgainAndAgain) {
  constexpr int kValues = 20000;
  auto& sender = MakeSender<Scan>("sender", {.pool = {.buffers = 64}});
  const auto probe = MakeProbe<Scan>(64);
  Connect(sender.out, *probe);
  std::atomic<bool> is_over{false};
  std::thread publisher([&] {
    for (int i = 1; i <= kValues; ++i) sender.out.Publish(Scan{{}, i});
    is_over = true;
  });
  int last = 0;
  int taken = 0;
  const auto take = [&] {
    while (probe->Take([&](const void* value, Time) {
      const int number = static_cast<const Scan*>(value)->number;
      EXPECT_GT(number, last);
      last = number;
      ++taken;
    })) {
    }
  };
  const auto connect_again = [&] {
    take();
    ASSERT_TRUE(Port::Disconnect(sender.out, *probe));
    take();
    Connect(sender.out, *probe);
  };
  while (!is_over) connect_again();
  publisher.join();
  connect_again();
  take();
  EXPECT_EQ(last, kValues);  // a new connection brings the newest
  EXPECT_LE(static_cast<std::uint64_t>(taken) + probe->dropped(), 2u * kValues);
  EXPECT_GT(taken, 0);
}

}  // namespace
}  // namespace runnel::test
