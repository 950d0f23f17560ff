#include <atomic>
#include <thread>

#include "core/port/cycle.h"
#include "plugins/testing/guards.h"
#include "tests/core/port/stop_fixture.h"

namespace runnel::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST_F(StopTest, ADrivingInputHasItsSafeValueWhoeverPublishes) {
  auto& sender = MakeSender<double>();
  auto& wheels = MakeReceiver<double>("wheels", Drives());
  auto& display = MakeReceiver<double>("display", {.unit = "m/s"});
  Connect(sender.out, wheels.in);
  Connect(sender.out, display.in);
  sender.out.Publish(3.0);
  EXPECT_EQ(wheels.in.Read().value_or(-1), 3.0);
  EXPECT_FALSE(wheels.in.is_stopped());
  Press();
  const auto stopped = wheels.in.Read();
  EXPECT_TRUE(stopped.is_new());
  EXPECT_EQ(*stopped, 0.0);
  EXPECT_TRUE(wheels.in.is_stopped());
  EXPECT_FALSE(wheels.in.Read().is_new()) << "once for each press";
  sender.out.Publish(4.0);
  EXPECT_EQ(wheels.in.Get(), 0.0);
  EXPECT_EQ(wheels.in.Peek().value_or(-1), 0.0);
  double shown = -1;
  wheels.in.VisitLatest([&](const void* value, ValueTimes) { shown = *static_cast<const double*>(value); });
  EXPECT_EQ(shown, 0.0) << "what is shown is what is read";
  EXPECT_EQ(display.in.Get(), 4.0) << "what does not drive goes on";
}

TEST_F(StopTest, NothingFromBeforeTheReleaseMoves) {
  auto& sender = MakeSender<double>();
  auto& wheels = MakeReceiver<double>("wheels", Drives());
  Connect(sender.out, wheels.in);
  sender.out.Publish(3.0);
  Press();
  sender.out.Publish(4.0);
  Release();
  EXPECT_EQ(wheels.in.Get(), 0.0) << "published while it was stopped";
  sender.out.Publish(5.0, At(10));
  EXPECT_EQ(wheels.in.Get(), 0.0) << "made of a measurement from before";
  EXPECT_TRUE(wheels.in.is_stopped());
  sender.out.Publish(6.0);
  EXPECT_EQ(wheels.in.Get(), 6.0);
  EXPECT_FALSE(wheels.in.is_stopped());
}

TEST_F(StopTest, AValueStampedAheadFromBeforeTheReleaseDoesNotCount) {
  auto& sender = MakeSender<double>();
  auto& wheels = MakeReceiver<double>("wheels", Drives());
  Connect(sender.out, wheels.in);
  Press();
  sender.out.Publish(4.0, At(1000));
  Release();
  EXPECT_EQ(wheels.in.Get(), 0.0);
}

TEST_F(StopTest, APersonsValueARulesAndTheEdgesComeAfterIt) {
  auto& sender = MakeSender<double>();
  auto& wheels = MakeReceiver<double>("wheels", Drives());
  Connect(sender.out, wheels.in);
  sender.out.Publish(1.0);
  Set(wheels.in, 2.0, Port::Setter::kRule);
  EXPECT_EQ(wheels.in.Get(), 2.0);
  Set(wheels.in, 3.0);
  EXPECT_EQ(wheels.in.Get(), 3.0);
  Set(wheels.in, 2.5, Port::Setter::kRule);
  EXPECT_EQ(wheels.in.Get(), 3.0) << "a rule takes nothing away from a person";
  Press();
  EXPECT_EQ(wheels.in.Get(), 0.0);
  Set(wheels.in, 3.5);
  EXPECT_EQ(wheels.in.Get(), 0.0);
  Release();
  EXPECT_EQ(wheels.in.Get(), 0.0) << "a value by hand from before the release is a command from before it";
  Set(wheels.in, 4.0);
  EXPECT_EQ(wheels.in.Get(), 4.0);
  EXPECT_TRUE(wheels.in.Release(Port::Setter::kRule));
  EXPECT_EQ(wheels.in.Get(), 4.0);
  EXPECT_FALSE(wheels.in.Release(Port::Setter::kRule));
  EXPECT_TRUE(wheels.in.Release());
  sender.out.Publish(5.0);
  EXPECT_EQ(wheels.in.Get(), 5.0);
}

TEST_F(StopTest, AQueueGivesTheSafeValueOnceAndNothingFromBeforeTheRelease) {
  auto& sender = MakeSender<double>();
  auto& wheels = MakeReceiver<double>("wheels", Drives());
  Connect(sender.out, wheels.in, {.queue = 2, .on_full = OnFull::kDropNewest});
  sender.out.Publish(1.0);
  EXPECT_THAT(TakeAll(wheels.in), ElementsAre(1.0));
  sender.out.Publish(2.0);
  sender.out.Publish(3.0);
  Press();
  EXPECT_THAT(TakeAll(wheels.in), ElementsAre(0.0)) << "though the queue is full";
  sender.out.Publish(4.0);
  EXPECT_THAT(TakeAll(wheels.in), IsEmpty());
  sender.out.Publish(5.0);
  Release();
  sender.out.Publish(6.0);
  EXPECT_THAT(TakeAll(wheels.in), ElementsAre(6.0));
  Press();
  Release();
  EXPECT_THAT(TakeAll(wheels.in), ElementsAre(0.0)) << "a short press is not missed";
}

TEST_F(StopTest, APressWakesWhoWaits) {
  auto& sender = MakeSender<double>();
  auto& wheels = MakeReceiver<double>("wheels", Drives());
  auto& queued = MakeReceiver<double>("queued", Drives());
  Connect(sender.out, wheels.in);
  Connect(sender.out, queued.in, {.queue = 2});
  CountingWaker waker;
  wheels.in.SetWaker(&waker);
  Press();
  EXPECT_EQ(waker.wakes, 1);
  wheels.in.SetWaker(nullptr);
  Release();
  std::atomic<bool> has_taken{false};
  while (queued.in.Take()) {
  }
  std::thread reader(
      [&] { has_taken = queued.in.Wait(std::chrono::minutes(1)) && queued.in.Take().value_or(-1) == 0.0; });
  Press();
  reader.join();
  EXPECT_TRUE(has_taken);
  EXPECT_EQ(waker.wakes, 1) << "one that was taken off is not woken";
}

TEST_F(StopTest, TakesNoLockOfTheStructure) {
  auto& sender = MakeSender<double>();
  auto& wheels = MakeReceiver<double>("wheels", Drives());
  Connect(sender.out, wheels.in);
  sender.out.Publish(4.0);
  const std::lock_guard structure(runtime.structure_mutex());
  std::thread([&] { Press(); }).join();
  EXPECT_EQ(wheels.in.Get(), 0.0);
}

TEST_F(StopTest, ReadingUnderItNeitherAllocatesNorLocks) {
  auto& sender = MakeSender<std::string>();
  auto& reader = MakeReceiver<std::string>("reader");
  Connect(sender.out, reader.in);
  ASSERT_TRUE(reader.in.SetDriving(true, std::string("stand still, whoever wants what")));
  sender.out.Publish(std::string("drive on, as far as the road goes"));
  const OwnCycle cycle(clock.Now());
  for (const bool is_stopped : {false, true}) {
    if (is_stopped) Press();
    (void)reader.in.Read();
    const AllocationGuard allocations;
    const LockProbe locks;
    const auto read = reader.in.Read();
    EXPECT_EQ(read->front(), is_stopped ? 's' : 'd');
    EXPECT_EQ(allocations.allocations(), 0u);
    EXPECT_EQ(locks.locks(), 0u);
  }
}

TEST_F(StopTest, TellsWhoListensAndWhoChangedIt) {
  RobotStop& stop = runtime.robot_stop();
  EXPECT_EQ(stop.state().changes, 0u);
  std::vector<std::string> heard;
  {
    const auto listening = stop.signal()->Listen(
        [&] { heard.push_back((stop.in_force() ? "stopped by " : "released by ") + stop.state().by); });
    EXPECT_TRUE(stop.Press("a button"));
    EXPECT_FALSE(stop.Press("a page"));
    EXPECT_EQ(stop.state().since, At(10));
    EXPECT_TRUE(stop.Release("a terminal"));
    EXPECT_FALSE(stop.Release("a page"));
  }
  stop.Press("nobody");
  EXPECT_THAT(heard, ElementsAre("stopped by a button", "released by a terminal"));
  EXPECT_EQ(stop.state().changes, 3u);
}

TEST_F(StopTest, IsNotReleasedByWhoDoesNotKnowOfIt) {
  RobotStop& stop = runtime.robot_stop();
  const auto now = [] { return SteadyClock().Now(); };
  const Time before = now();
  stop.Press("a button");
  const auto first = stop.state().requests;
  EXPECT_FALSE(stop.Release("a page", {.asked = before}));
  const Time between = now();
  EXPECT_TRUE(stop.CheckIsKnown({.asked = between, .requests = first}));
  EXPECT_FALSE(stop.Press("a terminal")) << "while it is in force";
  EXPECT_FALSE(stop.Release("a page", {.asked = between}));
  const auto late = stop.Release("a page", {.requests = first});
  ASSERT_FALSE(late);
  EXPECT_EQ(late.error().message, "STOP was pressed or released after this was asked for");
  EXPECT_FALSE(stop.CheckIsKnown({.requests = first}));
  EXPECT_TRUE(stop.in_force());
  EXPECT_TRUE(stop.Release("a page", {.asked = now(), .requests = first + 1}));
  EXPECT_FALSE(stop.in_force());
  EXPECT_EQ(stop.Release("a page").error().message, "STOP is not in force");
}

// Whoever presses while another thread releases the STOP before: it is in force, unless the release knew of the press.
TEST_F(StopTest, AReleaseThatKnowsOfNoPressDoesNotEndIt) {
  RobotStop& stop = runtime.robot_stop();
  std::atomic<bool> ends{false};
  std::atomic<std::uint64_t> presses{0};
  std::uint64_t unknown = 0;
  std::thread releaser([&] {
    while (!ends) {
      const std::uint64_t known = presses;
      const auto state = stop.state();
      const std::uint64_t seen = presses;
      // Only of presses that are over is it known which the state knows of.
      if (known == seen && known % 2 == 0) (void)stop.Release("a terminal", {.requests = state.requests});
    }
  });
  for (int i = 0; i < 20'000; ++i) {
    ++presses;
    stop.Press("a button");
    if (!stop.in_force()) ++unknown;  // nobody can know of it yet
    ++presses;
  }
  ends = true;
  releaser.join();
  EXPECT_EQ(unknown, 0u);
}

// Readers, a publisher, connections that come and go, and presses from another thread.
TEST_F(StopTest, HoldsWhileAllElseGoesOn) {
  SteadyClock steady;
  runtime.set_clock(steady);
  auto& sender = MakeSender<Speeds>();
  auto& wheels = MakeReceiver<Speeds>("wheels", {.drives = true});
  auto& passer = MakeReceiver<Speeds>("passer");
  Connect(sender.out, wheels.in);
  std::atomic<bool> ends{false};
  std::atomic<std::uint64_t> presses{0};  // odd: pressed
  std::atomic<int> moved{0};
  std::thread publisher([&] {
    while (!ends) sender.out.Publish({1, 1});
  });
  std::thread reader([&] {
    while (!ends) {
      const std::uint64_t before = presses;
      const double forward = wheels.in.Get().forward;
      if (before % 2 == 1 && presses == before && forward != 0) ++moved;
    }
  });
  std::thread connector([&] {
    while (!ends) {
      Connect(sender.out, passer.in);
      ASSERT_TRUE(Port::Disconnect(sender.out, passer.in));
      Set(wheels.in, 2.0, Port::Setter::kRule);
      wheels.in.Release(Port::Setter::kRule);
    }
  });
  for (int i = 0; i < 300; ++i) {
    runtime.robot_stop().Press("a test");
    ++presses;
    std::this_thread::yield();
    ++presses;
    (void)runtime.robot_stop().Release("a test");
  }
  ends = true;
  publisher.join();
  reader.join();
  connector.join();
  EXPECT_EQ(moved, 0);
}

}  // namespace
}  // namespace runnel::test
