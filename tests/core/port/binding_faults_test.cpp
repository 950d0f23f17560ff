// Ports are connected, cut, held to limits, set by hand and exchanged, or not, wherever memory runs out: publishers reach
// those who are connected, and nobody who has gone.

#include <algorithm>
#include <chrono>
#include <functional>
#include <future>
#include <string>
#include <thread>
#include <vector>

#include "core/port/probe_port.h"
#include "plugins/testing/fault_injection.h"
#include "tests/core/port/port_fixture.h"

namespace runnel::test {
namespace {

using std::chrono::milliseconds;

const ConnectOptions kLongPart{.queue = 4, .part = "a_field_with_a_long_name"};

Result<void> SetByHand(Port& port, double number) {
  return port.PublishByHand([&](void* value) -> Result<void> {
    *static_cast<double*>(value) = number;
    return {};
  });
}

}  // namespace

struct Named {
  double a_field_with_a_long_name = 0;
};
inline void Describe(TypeBuilder<Named>& type) {
  type.Name("test::Named").Field("a_field_with_a_long_name", &Named::a_field_with_a_long_name);
}

namespace {

/// An output, an interface port for its values or a part of them, and an input of numbers: what connects them is converted.
class BindingFaultsTest : public PortTest {
 protected:
  struct Ports {
    Output<Named>& out;
    ProxyPort& between;
    Input<double>& in;
  };
  using Operation = std::function<void(const Ports&)>;
  enum class Then { kAgain, kGone };

  /// `operation` where its n-th allocation fails, for each n; then once more, or its source goes. At how many points. Also
  /// with some more behind the n-th that fail: what takes back waits for memory.
  std::size_t Endure(const Operation& prepare, const Operation& operation) {
    std::size_t points = 1000;
    for (const Then then : {Then::kAgain, Then::kGone}) {
      for (const std::size_t further : {0, 1, 3}) {
        points = std::min(points, Endure(prepare, operation, then, further));
      }
    }
    return points;
  }
  std::size_t Endure(const Operation& prepare, const Operation& operation, Then then, std::size_t further) {
    for (std::size_t nth = 1;; ++nth) {
      SCOPED_TRACE(std::to_string(nth) + " and " + std::to_string(further) + (then == Then::kGone ? ", gone" : ""));
      auto& sender = MakeSender<Named>();
      auto& other = MakeSender<double>("other");
      auto& between =
          runtime.Create<ProxyPort>(runtime.root(), "between", Port::Direction::kInput, TypeOf<double>(), "passes on");
      auto& receiver = MakeReceiver<double>();
      EXPECT_TRUE(runtime.MakeReady(runtime.root()));
      const Ports ports{sender.out, between, receiver.in};
      prepare(ports);
      Connect(other.out, receiver.in);
      FaultInjection injection(InjectedFault::kAllocation, nth, further);
      try {
        operation(ports);
      } catch (const std::bad_alloc&) {
      }
      injection.End();
      const bool has_struck = injection.has_struck();
      ExpectItFlows(ports);
      if (then == Then::kAgain) {
        operation(ports);
        ExpectItFlows(ports);
      } else {
        EXPECT_TRUE(runtime.Delete(sender));
      }
      // By those that stay nobody is reached who has gone.
      other.out.Publish(0);
      EXPECT_TRUE(Port::Disconnect(other.out, receiver.in));
      EXPECT_TRUE(runtime.Delete(receiver));
      if (then == Then::kAgain) sender.out.Publish(Named{++last_});
      EXPECT_TRUE(runtime.Delete(between));
      if (then == Then::kAgain) sender.out.Publish(Named{++last_});
      if (then == Then::kAgain) {
        EXPECT_TRUE(runtime.Delete(sender));
      }
      EXPECT_TRUE(runtime.Delete(other));
      WaitForReaders();
      if (!has_struck || HasFailure()) return nth - 1;
    }
  }

  void ExpectItFlows(const Ports& ports) {
    ports.out.Publish(Named{++last_});
    const auto leads = [](const Port& from, const Port& to) { return from.ConnectionTo(to) != nullptr; };
    const bool is_connected =
        leads(ports.out, ports.in) || (leads(ports.out, ports.between) && leads(ports.between, ports.in));
    const std::vector<double> taken = TakeAll(ports.in);
    const bool has_come = std::ranges::find(taken, last_) != taken.end();
    EXPECT_EQ(has_come, is_connected && !ports.in.is_set_by_hand()) << last_;
  }

  static void JoinDirectly(const Ports& ports) { (void)Port::Connect(ports.out, ports.in, kLongPart); }
  static void JoinFirst(const Ports& ports) { (void)Port::Connect(ports.out, ports.between, kLongPart); }
  static void JoinSecond(const Ports& ports) { (void)Port::Connect(ports.between, ports.in, {.queue = 2}); }
  static void Hold(const Ports& ports) {
    (void)ports.in.SetLimits({.default_value = -3.0, .minimum = -1e6, .maximum = 1e6});
  }
  static void Drive(const Ports& ports) { (void)ports.in.SetDriving(true, 0.0); }

 private:
  double last_ = 0;
};

TEST_F(BindingFaultsTest, OneIsConnectedOrNot) {
  const auto held_and_second = [](const Ports& ports) { Hold(ports), JoinSecond(ports); };
  EXPECT_GT(Endure([](const Ports&) {}, JoinDirectly), 10u);
  EXPECT_GT(Endure(Hold, JoinDirectly), 10u);
  EXPECT_GT(Endure(Drive, JoinDirectly), 10u);
  EXPECT_GT(Endure(JoinFirst, JoinSecond), 3u);
  EXPECT_GT(Endure(held_and_second, JoinFirst), 10u);
}

TEST_F(BindingFaultsTest, OneIsCutOrNot) {
  const auto join = [](const Ports& ports) { Hold(ports), JoinFirst(ports), JoinSecond(ports); };
  EXPECT_GT(Endure(JoinDirectly, [](const Ports& ports) { (void)Port::Disconnect(ports.out, ports.in); }), 3u);
  EXPECT_GT(Endure(join, [](const Ports& ports) { (void)Port::Disconnect(ports.out, ports.between); }), 3u);
  EXPECT_GT(Endure(join, [](const Ports& ports) { (void)Port::Disconnect(ports.between, ports.in); }), 3u);
}

TEST_F(BindingFaultsTest, OneIsHeldToLimitsOrToOthersOrNot) {
  const auto join_held = [](const Ports& ports) { JoinDirectly(ports), Hold(ports); };
  EXPECT_GT(Endure(JoinDirectly, Hold), 10u);
  EXPECT_GT(Endure(join_held, Hold), 10u);
  EXPECT_GT(Endure(join_held, [](const Ports& ports) { (void)ports.in.SetLimits({}); }), 3u);
}

TEST_F(BindingFaultsTest, OneIsSetByHandAndReleasedOrNot) {
  EXPECT_GT(Endure(JoinDirectly, [](const Ports& ports) { (void)SetByHand(ports.in, -5); }), 10u);
  const auto set = [](const Ports& ports) { JoinDirectly(ports), (void)SetByHand(ports.in, -5); };
  EXPECT_GT(Endure(set, [](const Ports& ports) { (void)ports.in.Release(); }), 3u);
}

TEST_F(BindingFaultsTest, OneIsStoppedByASafeValueOrNot) { EXPECT_GT(Endure(JoinDirectly, Drive), 10u); }

TEST_F(BindingFaultsTest, ADefaultIsReadAgainWhereItsPlaceWasLackingOnce) {
  for (std::size_t nth = 1;; ++nth) {
    SCOPED_TRACE(nth);
    auto& sender = MakeSender<double>();
    auto& receiver =
        MakeReceiver<double>("receiver", {.limits = {.default_value = 42.0, .minimum = -1, .maximum = 50}});
    EXPECT_TRUE(runtime.MakeReady(runtime.root()));
    Connect(sender.out, receiver.in);
    sender.out.Publish(1);
    FaultInjection injection(InjectedFault::kAllocation, nth);
    (void)Port::Disconnect(sender.out, receiver.in);
    injection.End();
    (void)Port::Disconnect(sender.out, receiver.in);
    EXPECT_EQ(receiver.in.Get(), 42.0);
    EXPECT_TRUE(runtime.Delete(receiver));
    EXPECT_TRUE(runtime.Delete(sender));
    if (!injection.has_struck() || HasFailure()) break;
  }
}

TEST_F(BindingFaultsTest, AnInputThatWaitsIsToldThoughItWasNotAtFirst) {
  for (std::size_t nth = 1;; ++nth) {
    SCOPED_TRACE(nth);
    auto& sender = MakeSender<double>();
    auto& receiver = MakeReceiver<double>();
    Connect(sender.out, receiver.in);
    FaultInjection injection(InjectedFault::kAllocation, nth);
    try {
      (void)receiver.in.Wait(Duration(1));
    } catch (const std::bad_alloc&) {
    }
    injection.End();
    // For ever, if nobody wakes it.
    auto waits = std::async(std::launch::async, [&] { return receiver.in.Wait(Duration::max()); });
    std::this_thread::sleep_for(milliseconds(2));
    sender.out.Publish(1);
    EXPECT_TRUE(waits.get());
    EXPECT_TRUE(runtime.Delete(receiver));
    sender.out.Publish(2);
    EXPECT_TRUE(runtime.Delete(sender));
    if (!injection.has_struck() || HasFailure()) break;
  }
}

/// An input with limits takes over from another one, with others: one of them drives. There or back.
class TakingOverFaultsTest : public BindingFaultsTest {
 protected:
  void Endure(bool goes_back, bool last_drives) {
    for (std::size_t nth = 1;; ++nth) {
      SCOPED_TRACE(nth);
      auto& sender = MakeSender<double>("sender", {.unit = "m/s"});
      auto& first = MakeReceiver<double>(
          "first", {.unit = "m/s", .limits = {.minimum = -5, .maximum = 5, .out_of_bounds = OutOfBounds::kClamp}});
      auto& last =
          MakeReceiver<double>("last", {.unit = "m/s",
                                        .limits = {.minimum = -8, .maximum = 8, .out_of_bounds = OutOfBounds::kClamp},
                                        .drives = last_drives});
      EXPECT_TRUE(runtime.MakeReady(runtime.root()));
      Connect(sender.out, first.in, {.queue = 3});
      if (goes_back) last.in.TakeOver(first.in);
      bool is_done = false;
      FaultInjection injection(InjectedFault::kAllocation, nth);
      try {
        goes_back ? first.in.TakeOver(last.in) : last.in.TakeOver(first.in);
        is_done = true;
      } catch (const std::bad_alloc&) {
      }
      injection.End();
      const bool is_last = goes_back != is_done;
      Input<double>& now = is_last ? last.in : first.in;
      EXPECT_EQ(first.in.limits().maximum, 5.0);
      EXPECT_EQ(last.in.limits().maximum, 8.0);
      EXPECT_EQ(now.is_driving(), is_last && last_drives);
      clock.Advance(milliseconds(1));  // later than the release of before
      sender.out.Publish(3);
      EXPECT_EQ(now.Get(), 3.0);
      (void)runtime.robot_stop().Press("a test");
      EXPECT_EQ(now.Get(), now.is_driving() ? 0.0 : 3.0);
      sender.out.Publish(9);
      EXPECT_EQ(now.Get(), now.is_driving() ? 0.0 : is_last ? 8.0 : 5.0);
      EXPECT_TRUE(runtime.robot_stop().Release("a test"));
      EXPECT_TRUE(runtime.Delete(first));
      EXPECT_TRUE(runtime.Delete(last));
      sender.out.Publish(1);
      EXPECT_TRUE(runtime.Delete(sender));
      if (!injection.has_struck() || HasFailure()) break;
    }
  }
};

TEST_F(TakingOverFaultsTest, OneThatDrivesTakesOverOrNot) { Endure(false, true); }
TEST_F(TakingOverFaultsTest, OneThatDrivesGivesBackOrNot) { Endure(true, true); }
TEST_F(TakingOverFaultsTest, OneThatDrivesNotTakesOverOrNot) { Endure(false, false); }

// A probe that goes while it is connected, in the destructor.
TEST_F(BindingFaultsTest, AProbeGoesWhereverMemoryIsShort) {
  for (std::size_t nth = 1;; ++nth) {
    SCOPED_TRACE(nth);
    CountingWaker waker;
    auto& sender = MakeSender<double>();
    auto probe = std::make_unique<ProbePort>(runtime.root(), "probe", TypeOf<double>());
    Connect(sender.out, *probe);
    probe->SetWaker(&waker);
    FaultInjection injection(InjectedFault::kAllocation, nth, 2);
    probe.reset();
    injection.End();
    sender.out.Publish(1);
    EXPECT_EQ(waker.wakes, 0);
    EXPECT_TRUE(runtime.Delete(sender));
    if (!injection.has_struck() || HasFailure()) break;
  }
}

// A STOP is in force whatever is short, and all who follow it are told.
TEST_F(BindingFaultsTest, StopNeedsNoMemory) {
  auto& sender = MakeSender<double>("sender", {.unit = "m/s"});
  auto& receiver = MakeReceiver<double>("receiver", {.unit = "m/s", .drives = true});
  EXPECT_TRUE(runtime.MakeReady(runtime.root()));
  Connect(sender.out, receiver.in);
  CountingWaker waker;
  receiver.in.SetWaker(&waker);
  int told = 0;
  const auto throws = runtime.robot_stop().signal()->Listen([] { throw std::bad_alloc(); });
  const auto counts = runtime.robot_stop().signal()->Listen([&] { ++told; });
  FaultInjection injection(InjectedFault::kAllocation, 1, 1000);
  const bool is_new = runtime.robot_stop().Press("somebody with a name that is too long to be within itself");
  injection.End();
  EXPECT_TRUE(is_new);
  EXPECT_TRUE(runtime.robot_stop().in_force());
  EXPECT_FALSE(runtime.robot_stop().state().by.empty());
  EXPECT_EQ(told, 1);
  EXPECT_GT(waker.wakes, 0);
  receiver.in.SetWaker(nullptr);
}

}  // namespace
}  // namespace runnel::test
