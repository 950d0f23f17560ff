// Ports are connected, cut, held to limits and set by hand, or not, wherever memory runs out: publishers reach those
// who are connected, and nobody who has gone.

#include <algorithm>
#include <functional>
#include <string>

#include "plugins/testing/fault_injection.h"
#include "tests/core/port/port_fixture.h"

namespace runnel::test {
namespace {

Result<void> SetByHand(Port& port, double number) {
  return port.PublishByHand([&](void* value) -> Result<void> {
    *static_cast<double*>(value) = number;
    return {};
  });
}

/// An output of whole numbers, an interface port of theirs, and an input of others: what connects it is converted.
class BindingFaultsTest : public PortTest {
 protected:
  struct Ports {
    Output<int>& out;
    ProxyPort& between;
    Input<double>& in;
  };
  using Operation = std::function<void(const Ports&)>;

  /// `operation` once wherever its n-th allocation fails, and then once more. At how many points. Again with some more
  /// behind the n-th that fail: what takes back waits for memory.
  std::size_t Endure(const Operation& prepare, const Operation& operation) {
    return std::min(Endure(prepare, operation, 0), Endure(prepare, operation, 3));
  }
  std::size_t Endure(const Operation& prepare, const Operation& operation, std::size_t further) {
    for (std::size_t nth = 1;; ++nth) {
      SCOPED_TRACE(std::to_string(nth) + " and " + std::to_string(further));
      auto& sender = MakeSender<int>();
      auto& between =
          runtime.Create<ProxyPort>(runtime.root(), "between", Port::Direction::kInput, TypeOf<int>(), "passes on");
      auto& receiver = MakeReceiver<double>();
      EXPECT_TRUE(runtime.MakeReady(runtime.root()));
      const Ports ports{sender.out, between, receiver.in};
      prepare(ports);
      FaultInjection injection(InjectedFault::kAllocation, nth, further);
      try {
        operation(ports);
      } catch (const std::bad_alloc&) {
      }
      injection.End();
      const bool has_struck = injection.has_struck();
      ExpectItFlows(ports);
      operation(ports);
      ExpectItFlows(ports);
      // By those that stay nobody is reached who has gone.
      EXPECT_TRUE(runtime.Delete(receiver));
      sender.out.Publish(++last_);
      EXPECT_TRUE(runtime.Delete(between));
      sender.out.Publish(++last_);
      EXPECT_TRUE(runtime.Delete(sender));
      if (!has_struck || HasFailure()) return nth - 1;
    }
  }

  void ExpectItFlows(const Ports& ports) {
    ports.out.Publish(++last_);
    const auto leads = [](const Port& from, const Port& to) { return from.ConnectionTo(to) != nullptr; };
    const bool is_connected =
        leads(ports.out, ports.in) || (leads(ports.out, ports.between) && leads(ports.between, ports.in));
    const bool has_come = ports.in.Read().value_or(0) == last_;
    EXPECT_EQ(has_come, is_connected && !ports.in.is_set_by_hand()) << last_;
  }

  static void JoinDirectly(const Ports& ports) { (void)Port::Connect(ports.out, ports.in, {.queue = 4}); }
  static void JoinFirst(const Ports& ports) { (void)Port::Connect(ports.out, ports.between); }
  static void JoinSecond(const Ports& ports) { (void)Port::Connect(ports.between, ports.in); }

 private:
  int last_ = 0;
};

TEST_F(BindingFaultsTest, OneIsConnectedOrNot) {
  EXPECT_GT(Endure([](const Ports&) {}, JoinDirectly), 10u);
  EXPECT_GT(Endure(JoinFirst, JoinSecond), 10u);
  EXPECT_GT(Endure(JoinSecond, JoinFirst), 10u);
}

TEST_F(BindingFaultsTest, OneIsCutOrNot) {
  const auto join = [](const Ports& ports) { JoinFirst(ports), JoinSecond(ports); };
  EXPECT_GT(Endure(JoinDirectly, [](const Ports& ports) { (void)Port::Disconnect(ports.out, ports.in); }), 3u);
  EXPECT_GT(Endure(join, [](const Ports& ports) { (void)Port::Disconnect(ports.out, ports.between); }), 3u);
  EXPECT_GT(Endure(join, [](const Ports& ports) { (void)Port::Disconnect(ports.between, ports.in); }), 3u);
}

TEST_F(BindingFaultsTest, OneIsHeldToLimitsOrToOthersOrNot) {
  const auto hold = [](const Ports& ports) { (void)ports.in.SetLimits({.minimum = -1, .maximum = 1e6}); };
  EXPECT_GT(Endure(JoinDirectly, hold), 10u);
  EXPECT_GT(Endure([&](const Ports& ports) { JoinDirectly(ports), hold(ports); }, hold), 10u);
  EXPECT_GT(Endure([&](const Ports& ports) { JoinDirectly(ports), hold(ports); },
                   [](const Ports& ports) { (void)ports.in.SetLimits({}); }),
            3u);
}

TEST_F(BindingFaultsTest, OneIsSetByHandAndReleasedOrNot) {
  EXPECT_GT(Endure(JoinDirectly, [](const Ports& ports) { (void)SetByHand(ports.in, -5); }), 10u);
  const auto set = [](const Ports& ports) { JoinDirectly(ports), (void)SetByHand(ports.in, -5); };
  EXPECT_GT(Endure(set, [](const Ports& ports) { (void)ports.in.Release(); }), 3u);
}

TEST_F(BindingFaultsTest, OneIsStoppedByASafeValueOrNot) {
  const auto stop = [](const Ports& ports) { (void)ports.in.SetDriving(true, 0.0); };
  EXPECT_GT(Endure(JoinDirectly, stop), 10u);
}

}  // namespace
}  // namespace runnel::test
