#include "tests/core/port/port_fixture.h"
#include "tests/support/allocation_guard.h"
#include "tests/support/lock_probe.h"
#include "tests/support/system_call_probe.h"

namespace runnel::test {
namespace {

class CountingWaker final : public Waker {
 public:
  void Wake() noexcept override { ++wakes; }
  int wakes = 0;
};

// Within a cycle, as a module's Update() is; the clock of the machine is not asked then.
class RealTimePortTest : public PortTest {
 protected:
  // Runs `cycle` a few times to warm up, then a hundred times under watch.
  template <typename Body>
  void ExpectNothingOfTheSystem(const Body& body) {
    const CycleScope cycle({.now = Time(Duration(1))});
    for (int i = 0; i < 50; ++i) body();
    {
      const AllocationGuard allocations;
      const LockProbe locks;
      for (int i = 0; i < 100; ++i) body();
      EXPECT_EQ(allocations.allocations(), 0u);
      EXPECT_EQ(allocations.releases(), 0u);
      EXPECT_EQ(locks.locks(), 0u);
    }
    SystemCallProbe calls;
    for (int i = 0; i < 100; ++i) body();
    EXPECT_EQ(calls.Stop(), -1) << "a system call";
  }

  CountingWaker waker;
};

TEST_F(RealTimePortTest, SmallTypesNeitherAllocateNorLockNorCallTheSystem) {
  auto& sender = MakeSender<double>();
  auto& other = MakeSender<double>("other");
  auto& latest = MakeReceiver<double>("latest");
  auto& queued = MakeReceiver<double>("queued");
  Connect(sender.out, latest.in);
  Connect(other.out, latest.in);
  Connect(sender.out, queued.in, {.queue = 3});
  latest.in.SetWaker(&waker);
  double sum = 0;
  ExpectNothingOfTheSystem([&] {
    sender.out.Publish(1.0);
    other.out.Publish(2.0);
    for (int i = 0; i < 5; ++i) {
      auto loan = sender.out.Loan();
      *loan = 3.0;
      (void)sender.out.Publish(std::move(loan));
    }
    sum += *latest.in.Read() + *latest.in.Peek();
    sum += static_cast<double>(queued.in.Drain([](const Lease<double>&) {}));
  });
  EXPECT_EQ(sum, 250 * (3.0 + 3.0 + 3.0));
  latest.in.SetWaker(nullptr);
}

TEST_F(RealTimePortTest, TypesInBuffersNeitherAllocateNorLockNorCallTheSystem) {
  auto& sender = MakeSender<Scan>();
  auto& latest = MakeReceiver<Scan>("latest");
  auto& queued = MakeReceiver<Scan>("queued");
  auto& dropping = MakeReceiver<Scan>("dropping");
  auto& proxy =
      runtime.Create<ProxyPort>(runtime.root(), "proxy", Port::Direction::kInput, TypeOf<Scan>());
  Connect(sender.out, proxy);
  Connect(proxy, latest.in);
  Connect(sender.out, queued.in, {.queue = 3, .on_full = OnFull::kRefuse});
  Connect(sender.out, dropping.in, {.queue = 2, .on_full = OnFull::kDropOldest});
  latest.in.SetWaker(&waker);
  const Scan model{{1, 2, 3, 4}, 1};
  Lease<Scan> kept;
  ExpectNothingOfTheSystem([&] {
    for (int i = 0; i < 5; ++i) {
      auto loan = sender.out.Loan();
      loan->ranges.assign(100, 1.0F);
      (void)sender.out.Publish(std::move(loan));
    }
    (void)sender.out.Publish(model);
    kept = latest.in.Read();
    (void)latest.in.Peek();
    (void)queued.in.Take();
    queued.in.Drain([](const Lease<Scan>&) {});
  });
  EXPECT_EQ(sender.out.growths(), 0u);
  EXPECT_EQ(kept->ranges.size(), 4u);
  latest.in.SetWaker(nullptr);
}

TEST_F(RealTimePortTest, ExhaustedFixedPoolDoesNotAllocateEither) {
  auto& sender = MakeSender<Scan>("sender", {.pool = {.buffers = 1, .may_grow = false}});
  const auto only = sender.out.Loan();
  ASSERT_TRUE(only);
  ExpectNothingOfTheSystem([&] { EXPECT_FALSE(sender.out.Loan()); });
}

}  // namespace
}  // namespace runnel::test
