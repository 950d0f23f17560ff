// Publishing and reading go on while connections and ports come and go. Most meaningful under
// ThreadSanitizer and AddressSanitizer.

#include <atomic>
#include <thread>

#include "plugins/real_time_check/sanitizer.h"
#include "tests/core/port/port_fixture.h"
#include "tests/support/threads.h"

namespace runnel::test {
namespace {

using PortThreadsTest = PortTest;

constexpr int kThreadRounds = RUNNEL_UNDER_SANITIZER ? 500 : 2000;

TEST_F(PortThreadsTest, ConnectingAndDisconnectingWhileOthersPublishAndRead) {
  auto& sender = MakeSender<Scan>();
  auto& receiver = MakeReceiver<Scan>();
  std::atomic<bool> stop{false};
  std::atomic<int> torn{0}, backward{0}, published{0}, read{0};
  RunTogether(3, [&](unsigned index) {
    if (index == 0) {
      for (int number = 1; !stop; ++number) {
        auto loan = sender.out.Loan();
        loan->ranges.assign(20, static_cast<float>(number));
        loan->number = number;
        (void)sender.out.Publish(std::move(loan));
        ++published;
      }
    } else if (index == 1) {
      int last_read = 0;
      while (!stop) {
        const auto check = [&](const Lease<Scan>& lease) {
          for (const float each : lease->ranges) {
            if (each != static_cast<float>(lease->number)) ++torn;
          }
          ++read;
        };
        if (const auto lease = receiver.in.Read()) {
          check(lease);
          if (lease->number < last_read) ++backward;
          last_read = lease->number;
        }
        receiver.in.Drain(check);
        (void)receiver.in.dropped();
        (void)receiver.in.publications();
      }
    } else {
      for (int i = 0; i < kThreadRounds || read == 0; ++i) {
        const std::size_t queue = static_cast<std::size_t>(i) % 4;
        EXPECT_TRUE(Port::Connect(sender.out, receiver.in, {.queue = queue}));
        std::this_thread::yield();
        EXPECT_TRUE(Port::Disconnect(sender.out, receiver.in));
      }
      stop = true;
    }
  });
  EXPECT_EQ(torn, 0);
  EXPECT_EQ(backward, 0);
  EXPECT_GT(published, 0);
}

TEST_F(PortThreadsTest, SmallTypesToo) {
  auto& sender = MakeSender<std::int64_t>();
  auto& receiver = MakeReceiver<std::int64_t>();
  std::atomic<bool> stop{false};
  std::atomic<int> backward{0}, read{0};
  RunTogether(3, [&](unsigned index) {
    if (index == 0) {
      for (std::int64_t number = 1; !stop; ++number) {
        sender.out.Publish(number);
        MaybeYield();
      }
    } else if (index == 1) {
      std::int64_t last = 0;
      while (!stop) {
        MaybeYield();
        const auto lease = receiver.in.Read();
        if (!lease) continue;
        if (*lease < last) ++backward;
        last = *lease;
        ++read;
        (void)receiver.in.Take();
      }
    } else {
      for (int i = 0; i < kThreadRounds || read == 0; ++i) {
        EXPECT_TRUE(Port::Connect(sender.out, receiver.in, {.queue = static_cast<std::size_t>(i) % 3}));
        std::this_thread::yield();
        EXPECT_TRUE(Port::Disconnect(sender.out, receiver.in));
      }
      stop = true;
    }
  });
  EXPECT_EQ(backward, 0);
}

// Viewers and networks show a value once for each count: of a count that is there before its value they would keep the one before.
TEST_F(PortThreadsTest, WhoFindsACountFindsThatValueOrALaterOne) {
  auto& sender = MakeSender<Scan>();
  constexpr int kMost = 100 * kThreadRounds;
  std::uint64_t early = 0;
  RunTogether(2, [&](unsigned index) {
    if (index == 0) {
      for (int number = 1; number <= kMost; ++number) {
        auto loan = sender.out.Loan();
        loan->number = number;
        (void)sender.out.Publish(std::move(loan));
      }
    } else {
      for (std::uint64_t count = 0; count < kMost;) {
        count = sender.out.publications();
        sender.out.VisitLatest([&](const void* value, ValueTimes) {
          if (static_cast<std::uint64_t>(static_cast<const Scan*>(value)->number) < count) ++early;
        });
      }
    }
  });
  EXPECT_EQ(early, 0U);
}

TEST_F(PortThreadsTest, InterfacePortsAreConnectedAnewWhileTwoSourcesPublish) {
  auto& a = MakeSender<Scan>("a");
  auto& b = MakeSender<Scan>("b");
  auto& proxy = runtime.Create<ProxyPort>(runtime.root(), "proxy", Port::Direction::kInput, TypeOf<Scan>());
  auto& receiver = MakeReceiver<Scan>();
  Connect(proxy, receiver.in, {.queue = 3});
  std::atomic<int> changing{2};
  std::atomic<int> torn{0}, read{0};
  RunTogether(5, [&](unsigned index) {
    if (index < 2) {
      auto& sender = index == 0 ? a : b;
      for (int number = 1; changing > 0; ++number) {
        (void)sender.out.Publish(Scan{std::vector<float>(5, static_cast<float>(number)), number});
        MaybeYield();
      }
    } else if (index == 2) {
      while (changing > 0) {
        const auto check = [&](const Lease<Scan>& scan) {
          if (scan->ranges.at(4) != static_cast<float>(scan->number)) ++torn;
          ++read;
        };
        if (const auto scan = receiver.in.Read()) check(scan);
        receiver.in.Drain(check);
        MaybeYield();
      }
    } else {
      auto& sender = index == 3 ? a : b;
      for (int i = 0; i < kThreadRounds / 2 || read == 0; ++i) {
        EXPECT_TRUE(Port::Connect(sender.out, proxy, {.queue = static_cast<std::size_t>(i) % 5}));
        MaybeYield();
        EXPECT_TRUE(Port::Disconnect(sender.out, proxy));
      }
      --changing;
    }
  });
  EXPECT_EQ(torn, 0);
}

TEST_F(PortThreadsTest, SendersAreDeletedWhileAReaderHoldsTheirValues) {
  auto& receiver = MakeReceiver<Scan>();
  std::atomic<bool> stop{false};
  std::atomic<int> torn{0}, read{0};
  RunTogether(2, [&](unsigned index) {
    if (index == 0) {
      while (!stop) {
        const auto lease = receiver.in.Read();
        const auto taken = receiver.in.Take();
        for (const auto* each : {&lease, &taken}) {
          if (!*each) continue;
          std::this_thread::yield();
          ++read;
          if ((*each)->ranges.size() != 10 || (*each)->ranges[9] != 1.0F) ++torn;
        }
      }
      return;
    }
    for (int i = 0; i < kThreadRounds / 2 || read == 0; ++i) {
      auto& sender = MakeSender<Scan>("sender", {.pool = {.buffers = 2}});
      sender.out.Publish(Scan{std::vector<float>(10, 1.0F), i});
      Connect(sender.out, receiver.in, {.queue = 2});
      sender.out.Publish(Scan{std::vector<float>(10, 1.0F), i});
      std::this_thread::yield();
      EXPECT_TRUE(runtime.Delete(sender));
    }
    stop = true;
  });
  EXPECT_EQ(torn, 0);
}

TEST_F(PortThreadsTest, ReceiversAreDeletedWhileASenderPublishes) {
  auto& sender = MakeSender<Scan>();
  std::atomic<bool> stop{false};
  std::atomic<int> published{0};
  RunTogether(2, [&](unsigned index) {
    if (index == 0) {
      while (!stop) {
        (void)sender.out.Publish(Scan{{1, 2, 3}, 1});
        ++published;
      }
      return;
    }
    for (int i = 0; i < kThreadRounds / 2 || published < 100; ++i) {
      auto& receiver = MakeReceiver<Scan>();
      Connect(sender.out, receiver.in, {.queue = 1 + static_cast<std::size_t>(i) % 3});
      (void)receiver.in.Take();
      EXPECT_TRUE(runtime.Delete(receiver));
    }
    stop = true;
  });
}

// Whatever the policy, each value is either taken, or waits, or is counted as dropped.
TEST_F(PortThreadsTest, NoValueIsLostUncounted) {
  for (const OnFull policy : {OnFull::kDropOldest, OnFull::kDropNewest, OnFull::kRefuse}) {
    for (const std::size_t room : {1u, 2u, 5u}) {
      Runtime other;
      auto& a = other.Create<Sender<int>>(other.root(), "a");
      auto& b = other.Create<Sender<int>>(other.root(), "b");
      auto& receiver = other.Create<Receiver<int>>(other.root(), "receiver");
      Connect(a.out, receiver.in, {.queue = room, .on_full = policy});
      Connect(b.out, receiver.in, {.queue = room, .on_full = policy});
      std::atomic<int> sending{2};
      std::uint64_t taken = 0;
      RunTogether(3, [&](unsigned index) {
        if (index < 2) {
          for (int i = 0; i < kThreadRounds; ++i) (void)(index == 0 ? a : b).out.Publish(i);
          --sending;
          return;
        }
        while (sending > 0) taken += receiver.in.Drain([](const Lease<int>&) {});
      });
      taken += receiver.in.Drain([](const Lease<int>&) {});
      EXPECT_EQ(taken + receiver.in.dropped(), 2u * kThreadRounds);
    }
  }
}

TEST_F(PortThreadsTest, WakerIsNotCalledAfterReadersHaveBeenWaitedFor) {
  class Mortal final : public Waker {
   public:
    void Wake() noexcept override {
      if (dead) ++late;
    }
    std::atomic<bool> dead{false};
    std::atomic<int> late{0};
  };
  auto& sender = MakeSender<int>();
  auto& receiver = MakeReceiver<int>();
  Connect(sender.out, receiver.in);
  std::atomic<bool> stop{false};
  std::atomic<int> late{0};
  RunTogether(2, [&](unsigned index) {
    if (index == 0) {
      while (!stop) {
        sender.out.Publish(1);
        MaybeYield();
      }
      return;
    }
    for (int i = 0; i < kThreadRounds; ++i) {
      Mortal waker;
      receiver.in.SetWaker(&waker);
      std::this_thread::yield();
      receiver.in.SetWaker(nullptr);
      WaitForReaders();
      waker.dead = true;
      late += waker.late;
    }
    stop = true;
  });
  EXPECT_EQ(late, 0);
}

}  // namespace
}  // namespace runnel::test
