#include "core/port/cycle.h"

#include <thread>

#include "tests/core/port/port_fixture.h"

namespace runnel::test {
namespace {

using namespace std::chrono_literals;
using CycleTest = PortTest;

TEST_F(CycleTest, ValuesOfOneCycleBearItsTimeHoweverLateTheyArePublished) {
  auto& sender = MakeSender<int>();
  auto& pooled = MakeSender<Scan>("pooled");
  auto& receiver = MakeReceiver<int>();
  auto& scans = MakeReceiver<Scan>("scans");
  Connect(sender.out, receiver.in);
  Connect(pooled.out, scans.in);
  const CycleScope cycle({.now = Time(5s), .period = 20ms});
  clock.Advance(7s);
  sender.out.Publish(1);
  pooled.out.Publish(Scan{});
  EXPECT_EQ(receiver.in.Read().timestamp(), Time(5s));
  EXPECT_EQ(scans.in.Read().timestamp(), Time(5s));
}

TEST_F(CycleTest, OutsideOfCyclesTheRuntimesClockCounts) {
  auto& sender = MakeSender<int>();
  auto& receiver = MakeReceiver<int>();
  Connect(sender.out, receiver.in);
  clock.Advance(3s);
  sender.out.Publish(1);
  EXPECT_EQ(receiver.in.Read().timestamp(), Time(3s));
}

TEST_F(CycleTest, CyclesMayBeNestedAndBelongToTheirThread) {
  EXPECT_EQ(CurrentCycle(), nullptr);
  {
    const CycleScope outer({.now = Time(1s)});
    {
      const CycleScope inner({.now = Time(2s)});
      EXPECT_EQ(CurrentCycle()->now, Time(2s));
    }
    EXPECT_EQ(CurrentCycle()->now, Time(1s));
    std::thread([] { EXPECT_EQ(CurrentCycle(), nullptr); }).join();
  }
  EXPECT_EQ(CurrentCycle(), nullptr);
}

TEST_F(CycleTest, AThreadOfTheUsersOwnOpensOneForItself) {
  auto& sender = MakeSender<int>();
  auto& receiver = MakeReceiver<int>();
  Connect(sender.out, receiver.in);
  std::thread([&] {
    {
      const OwnCycle cycle(Time(5s), 20ms);
      EXPECT_TRUE(EpochGuard::HeldByThisThread());
      EXPECT_EQ(CurrentCycle()->period, 20ms);
      sender.out.Publish(1, Time(4s));
    }
    EXPECT_EQ(CurrentCycle(), nullptr);
    EXPECT_FALSE(EpochGuard::HeldByThisThread());
  }).join();
  const auto read = receiver.in.Read();
  EXPECT_EQ(read.publication_time(), Time(5s));
  EXPECT_EQ(read.timestamp(), Time(4s));
}

}  // namespace
}  // namespace runnel::test
