#include <array>
#include <utility>

#include "plugins/testing/guards.h"
#include "tests/core/port/port_fixture.h"

namespace runnel::test {
namespace {

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
  auto& proxy = runtime.Create<ProxyPort>(runtime.root(), "proxy", Port::Direction::kInput, TypeOf<Scan>());
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

// In buffers, but copied in queues; one source each, so also the queue for one writer.
struct Wrench {
  std::array<double, 16> values{};
};
void Describe(TypeBuilder<Wrench>& type) { type.Name("test::Wrench"); }

TEST_F(RealTimePortTest, TypesInBuffersThatQueuesCopyNeitherAllocateNorLockNorCallTheSystem) {
  auto& sender = MakeSender<Wrench>();
  auto& latest = MakeReceiver<Wrench>("latest");
  auto& refusing = MakeReceiver<Wrench>("refusing");
  auto& dropping = MakeReceiver<Wrench>("dropping");
  Connect(sender.out, latest.in);
  Connect(sender.out, refusing.in, {.queue = 3, .on_full = OnFull::kRefuse});
  Connect(sender.out, dropping.in, {.queue = 2, .on_full = OnFull::kDropOldest});
  const Wrench model{{1, 2, 3}};
  double sum = 0;
  ExpectNothingOfTheSystem([&] {
    for (int i = 0; i < 5; ++i) (void)sender.out.Publish(model);
    auto loan = sender.out.Loan();
    *loan = model;
    (void)sender.out.Publish(std::move(loan));
    sum += latest.in.Get(Wrench{}).values[0] + latest.in.Read()->values[0];
    const Lease<Wrench> taken = refusing.in.Take();
    const Lease<Wrench> copy = taken;
    sum += copy->values[0];
    refusing.in.Drain([](const Lease<Wrench>&) {});
    dropping.in.Drain([](const Lease<Wrench>&) {});
  });
  EXPECT_EQ(sum, 250 * 3.0);
  EXPECT_EQ(sender.out.growths(), 0u);
}

// More than the thread has slots, so that some are counted; copied, moved, and outside of a guard.
TEST_F(RealTimePortTest, CopiesOfLeasesAndGetNeitherAllocateNorLockNorCallTheSystem) {
  auto& large = MakeSender<Scan>("large");
  auto& small = MakeSender<double>("small");
  auto& scans = MakeReceiver<Scan>("scans");
  auto& numbers = MakeReceiver<double>("numbers");
  Connect(large.out, scans.in);
  Connect(small.out, numbers.in);
  large.out.Publish(Scan{{1, 2, 3}, 1});
  small.out.Publish(4.0);
  double sum = 0;
  ExpectNothingOfTheSystem([&] {
    std::array<Lease<Scan>, 12> leases;
    for (auto& lease : leases) lease = scans.in.Peek();
    const Lease<Scan> copy = leases[0];
    const Lease<Scan> moved = std::move(leases[11]);
    sum += numbers.in.Get() + numbers.in.Get(0.0) + copy->ranges[0] + moved->ranges[0];
    const EpochGuard guard;  // as the executor holds one for the whole cycle
    sum += *numbers.in.Read() + numbers.in.Get();
    leases[1] = scans.in.Read();
    { const auto unpublished = large.out.Loan(); }
  });
  EXPECT_EQ(sum, 250 * (4.0 + 4.0 + 1.0 + 1.0 + 4.0 + 4.0));
}

// Whoever takes goes through the replaced queue and the new one.
TEST_F(RealTimePortTest, TakingFromReplacedQueuesNeitherAllocatesNorLocksNorCallsTheSystem) {
  auto& sender = MakeSender<Scan>();
  auto& other = MakeSender<Scan>("other");
  auto& receiver = MakeReceiver<Scan>();
  Connect(sender.out, receiver.in, {.queue = 3, .on_full = OnFull::kRefuse});
  Connect(other.out, receiver.in, {.queue = 4, .on_full = OnFull::kRefuse});
  ASSERT_EQ(receiver.in.replaced_queues(), 1u);
  const Scan model{{1, 2, 3, 4}, 1};
  std::size_t taken = 0;
  ExpectNothingOfTheSystem([&] {
    (void)sender.out.Publish(model);
    (void)other.out.Publish(model);
    taken += receiver.in.Drain([](const Lease<Scan>&) {});
  });
  EXPECT_EQ(taken, 500u);
}

TEST_F(RealTimePortTest, ForwardingAndPublishingInPlaceNeitherAllocateNorLockNorCallTheSystem) {
  struct Owner final : ValueOwner<Scan> {
    void TakeBack(const Scan&) noexcept override { ++back; }
    const Scan scan{{1, 2, 3}, 7};
    int back = 0;
  };
  const auto owner = std::make_shared<Owner>();
  auto& sender = MakeSender<Scan>();
  auto& next = MakeSender<Scan>("next");
  auto& numbers = MakeSender<double>("numbers");
  auto& receiver = MakeReceiver<Scan>("receiver");
  auto& last = MakeReceiver<Scan>("last");
  auto& number = MakeReceiver<double>("number");
  Connect(sender.out, receiver.in);
  Connect(next.out, last.in, {.queue = 2});
  Connect(numbers.out, number.in);
  int sum = 0;
  numbers.out.Publish(1.0, Time(Duration(1)));
  ExpectNothingOfTheSystem([&] {
    sender.out.PublishInPlace(owner->scan, owner, Time(Duration(1)));
    next.out.Forward(receiver.in.Read());
    sender.out.Publish(sender.out.Loan(), Time(Duration(1)));
    next.out.Forward(receiver.in.Read());
    last.in.Drain([&](const Lease<Scan>& lease) { sum += lease->number; });
    numbers.out.Forward(number.in.Read());
    numbers.out.Publish(1.0, Time(Duration(1)));
    next.out.ReleaseUnused();
    sender.out.ReleaseUnused();
  });
  EXPECT_EQ(sum, 250 * 7);
  EXPECT_GT(owner->back, 240);
  EXPECT_EQ(sender.out.growths(), 0u);
  EXPECT_EQ(next.out.growths(), 0u);
}

TEST_F(RealTimePortTest, ExhaustedFixedPoolDoesNotAllocateEither) {
  auto& sender = MakeSender<Scan>("sender", {.pool = {.buffers = 1, .may_grow = false}});
  const auto only = sender.out.Loan();
  ASSERT_TRUE(only);
  ExpectNothingOfTheSystem([&] { EXPECT_FALSE(sender.out.Loan()); });
}

}  // namespace
}  // namespace runnel::test
