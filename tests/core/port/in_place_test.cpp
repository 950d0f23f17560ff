// Values are published out of memory of the user's own.

#include <algorithm>
#include <atomic>
#include <optional>

#include "plugins/real_time_check/sanitizer.h"
#include "tests/core/port/forwarding_fixture.h"
#include "tests/support/threads.h"

namespace runnel::test {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using InPlaceTest = ForwardingTest;

TEST_F(InPlaceTest, WhatIsPublishedInPlaceComesBackWhenNobodyHoldsIt) {
  Ring ring;
  const Link a = MakeLink("a");
  clock.Set(Time(5s));
  a.sender.out.PublishInPlace(ring.scans[0], Of<Scan>(ring), Time(3s));
  Lease<Scan> kept = a.receiver.in.Read();
  EXPECT_EQ(&*kept, &ring.scans[0]);
  EXPECT_EQ(kept.timestamp(), Time(3s));
  EXPECT_EQ(kept.publication_time(), Time(5s));
  a.sender.out.PublishInPlace(ring.scans[1], Of<Scan>(ring));
  EXPECT_EQ(a.receiver.in.Read().timestamp(), Time(5s));
  a.sender.out.PublishInPlace(ring.scans[2], Of<Scan>(ring));
  a.sender.out.ReleaseUnused();
  EXPECT_THAT(ring.back, ElementsAre(1)) << "the first is held, the third is the newest";
  kept = {};
  EXPECT_THAT(ring.back, ElementsAre(1)) << "a reader gives nothing back itself";
  a.sender.out.ReleaseUnused();
  EXPECT_THAT(ring.back, ElementsAre(1, 0));
  a.sender.out.ReleaseUnused();
  EXPECT_THAT(ring.back, ElementsAre(1, 0));
  ASSERT_TRUE(runtime.Delete(a.sender));
  CollectRetired();
  EXPECT_THAT(ring.back, ElementsAre(1, 0, 2));
}

TEST_F(InPlaceTest, WhatIsPublishedInPlaceIsHeldByThoseWhoForwardIt) {
  Ring ring;
  const Link a = MakeLink("a");
  const Link b = MakeLink("b");
  a.sender.out.PublishInPlace(ring.scans[0], Of<Scan>(ring));
  b.sender.out.Forward(a.receiver.in.Read());
  a.sender.out.PublishInPlace(ring.scans[1], Of<Scan>(ring));
  a.sender.out.ReleaseUnused();
  EXPECT_THAT(ring.back, ElementsAre());
  EXPECT_EQ(&*b.receiver.in.Read(), &ring.scans[0]);
  Lease<Scan> kept = b.receiver.in.Read();
  ASSERT_TRUE(runtime.Delete(a.sender));
  EXPECT_THAT(ring.back, ElementsAre(1)) << "one is not held; the pool stays for the other";
  ASSERT_TRUE(runtime.Delete(b.sender));
  CollectRetired();
  EXPECT_THAT(ring.back, ElementsAre(1));
  kept = {};
  CollectRetired();
  EXPECT_THAT(ring.back, ElementsAre(1, 0));
}

TEST_F(InPlaceTest, AViewOfOtherMemoryIsHeldWithIt) {
  struct Driver final : ValueOwner<Frame> {
    void TakeBack(const Frame&) noexcept override { ++back; }
    const std::array<char, 100> memory{};
    const Frame frame{memory.data(), memory.size()};
    int back = 0;
  } driver;
  auto& camera = MakeSender<Frame>("camera");
  auto& viewer = MakeReceiver<Frame>("viewer");
  Connect(camera.out, viewer.in, {.queue = 3});
  camera.out.PublishInPlace(driver.frame, Of<Frame>(driver));
  camera.out.Publish(Frame{});
  std::optional queued = viewer.in.Take();
  EXPECT_EQ((*queued)->pixels, driver.memory.data());
  camera.out.ReleaseUnused();
  EXPECT_EQ(driver.back, 0);
  queued.reset();
  camera.out.ReleaseUnused();
  EXPECT_EQ(driver.back, 1);
}

TEST_F(InPlaceTest, TheOwnerLivesAsLongAsWhatItHasPublished) {
  struct Mortal final : ValueOwner<Scan> {
    explicit Mortal(bool& is_gone) : gone(is_gone) {}
    ~Mortal() override { gone = is_back; }
    void TakeBack(const Scan&) noexcept override { is_back = true; }
    const Scan scan{{}, 7};
    bool& gone;
    bool is_back = false;
  };
  bool gone = false;
  const Link a = MakeLink("a");
  auto owner = std::make_shared<Mortal>(gone);
  const Scan& scan = owner->scan;
  a.sender.out.PublishInPlace(scan, std::move(owner));
  Lease<Scan> kept = a.receiver.in.Read();
  ASSERT_TRUE(runtime.Delete(a.sender));
  CollectRetired();
  EXPECT_EQ(kept->number, 7);
  EXPECT_FALSE(gone);
  kept = {};
  CollectRetired();
  EXPECT_TRUE(gone) << "after it has got its value back";
}

// A provider that publishes while it is pulled is told that it cannot, and keeps what it has.
TEST_F(InPlaceTest, WhatCannotBePublishedNowStaysWithItsOwner) {
  Ring ring;
  const Link a = MakeLink("a", kFixed);
  auto& sender = MakeSender<Scan>("pullable", kPullable);
  auto& puller = MakeReceiver<Scan>("puller", kPulls);
  Connect(sender.out, puller.in);
  Publish(a.sender.out, 1);
  sender.out.SetProvider([&](Scan& scan) {
    EXPECT_EQ(sender.out.PublishInPlace(ring.scans[0], Of<Scan>(ring)), PublishStatus::kBusy);
    EXPECT_EQ(sender.out.Forward(a.receiver.in.Read()), PublishStatus::kBusy);
    scan.number = 9;
    return true;
  });
  EXPECT_EQ(puller.in.Read()->number, 9);
  sender.out.ReleaseUnused();
  EXPECT_THAT(ring.back, ElementsAre());
  Publish(a.sender.out, 2);
  EXPECT_TRUE(a.sender.out.Loan()) << "is not held any more";
}

// A driver writes into its ring as soon as it gets something back, a gate forwards, a reader looks.
TEST_F(InPlaceTest, NothingIsWrittenThatSomebodyLooksAt) {
  struct Driver final : ValueOwner<Scan> {
    void TakeBack(const Scan& scan) noexcept override {
      is_out[static_cast<std::size_t>(&scan - scans.data())] = false;
    }
    std::array<Scan, 4> scans;
    std::array<bool, 4> is_out{};
  };
  Driver driver;
  const Link in_place = MakeLink("in_place");
  const Link pooled = MakeLink("pooled");
  const Link gate = MakeLink("gate");
  const Link last = MakeLink("last");
  auto& queued = MakeReceiver<Scan>("queued");
  Connect(gate.sender.out, queued.in, {.queue = 3});
  std::atomic<bool> stop{false};
  std::atomic<int> torn{0};
  std::atomic<int> read{0};
  const int rounds = RUNNEL_UNDER_SANITIZER ? 2000 : 20000;
  const auto look = [&](const Lease<Scan>& lease) {
    if (!lease) return;
    for (const float each : lease->ranges) torn += each != static_cast<float>(lease->number);
    ++read;
  };
  RunTogether(4, [&](unsigned index) {
    if (index == 0) {
      for (int number = 1; number < rounds || read < 100; ++number) {
        Publish(pooled.sender.out, number);
        in_place.sender.out.ReleaseUnused();
        const auto free = std::ranges::find(driver.is_out, false);
        if (free == driver.is_out.end()) continue;
        *free = true;
        Scan& scan = driver.scans[static_cast<std::size_t>(free - driver.is_out.begin())];
        scan.number = number;
        scan.ranges.assign(20, static_cast<float>(number));
        in_place.sender.out.PublishInPlace(scan, Of<Scan>(driver));
      }
      stop = true;
    } else if (index == 1) {
      for (int i = 0; !stop; ++i) {
        const auto lease = (i % 3 == 0 ? pooled : in_place).receiver.in.Read();
        if (lease) gate.sender.out.Forward(lease);
      }
    } else if (index == 2) {
      while (!stop) {
        const auto lease = gate.receiver.in.Read();
        look(lease);
        if (lease) last.sender.out.Forward(lease);
      }
    } else {
      while (!stop) {
        look(last.receiver.in.Read());
        queued.in.Drain(look);
      }
    }
  });
  EXPECT_EQ(torn, 0);
  for (FrameworkElement* element :
       {static_cast<FrameworkElement*>(&last.sender), static_cast<FrameworkElement*>(&gate.sender),
        static_cast<FrameworkElement*>(&in_place.sender)}) {
    ASSERT_TRUE(runtime.Delete(*element));
  }
  CollectRetired();
  EXPECT_THAT(driver.is_out, testing::Each(false)) << "all have come back";
}

}  // namespace
}  // namespace runnel::test
