// Inputs whose reader sleeps until something comes. Long time-outs are there only against hanging:
// a lost wake-up shows as a Wait() that returns false after half a minute.

#include <atomic>
#include <chrono>
#include <functional>
#include <thread>

#include "core/base/check.h"
#include "plugins/real_time_check/sanitizer.h"
#include "plugins/testing/guards.h"
#include "tests/core/port/port_fixture.h"
#include "tests/support/threads.h"

namespace runnel::test {
namespace {

using std::chrono::milliseconds;

constexpr Duration kLong = std::chrono::seconds(30);
constexpr int kRounds = RUNNEL_UNDER_SANITIZER ? 1000 : 5000;

class WaitingPortTest : public PortTest {
 protected:
  // Runs `act` in another thread, a while after `wait` has begun: most of the time, it sleeps then.
  template <typename Act>
  static void ActWhileAsleep(const Act& act, const std::function<void()>& wait) {
    std::thread actor([&] {
      std::this_thread::sleep_for(milliseconds(5));
      act();
    });
    wait();
    actor.join();
  }
};

TEST_F(WaitingPortTest, ReturnsAtOnceIfThereIsSomethingNew) {
  auto& sender = MakeSender<int>();
  auto& receiver = MakeReceiver<int>();
  Connect(sender.out, receiver.in);
  EXPECT_FALSE(receiver.in.Wait(Duration(0)));
  sender.out.Publish(1);
  EXPECT_TRUE(receiver.in.Wait(Duration(0)));
  EXPECT_TRUE(receiver.in.Wait(kLong));
  (void)receiver.in.Peek();
  EXPECT_TRUE(receiver.in.Wait(Duration(-1))) << "peeking does not mark as read";
  EXPECT_TRUE(receiver.in.Read().is_new());
  EXPECT_FALSE(receiver.in.Wait(Duration(0)));
}

TEST_F(WaitingPortTest, GivesUpWhenTheTimeIsOverAndNotBefore) {
  auto& sender = MakeSender<int>();
  auto& receiver = MakeReceiver<int>();
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_FALSE(receiver.in.Wait(milliseconds(10))) << "nothing is connected";
  Connect(sender.out, receiver.in);
  EXPECT_FALSE(receiver.in.Wait(milliseconds(10)));
  EXPECT_GE(std::chrono::steady_clock::now() - begin, milliseconds(20));
}

TEST_F(WaitingPortTest, WakesForAPublication) {
  auto& sender = MakeSender<int>();
  auto& receiver = MakeReceiver<int>();
  Connect(sender.out, receiver.in);
  for (int i = 1; i <= 5; ++i) {
    ActWhileAsleep([&] { sender.out.Publish(i); }, [&] { EXPECT_TRUE(receiver.in.Wait(Duration::max())); });
    EXPECT_EQ(*receiver.in.Read(), i);
  }
}

TEST_F(WaitingPortTest, WakesForAValueInABuffer) {
  auto& sender = MakeSender<Scan>();
  auto& receiver = MakeReceiver<Scan>("receiver", {.waits = true});
  Connect(sender.out, receiver.in);
  ActWhileAsleep([&] { sender.out.Publish(Scan{{}, 7}); }, [&] { EXPECT_TRUE(receiver.in.Wait(kLong)); });
  EXPECT_EQ(receiver.in.Read()->number, 7);
}

TEST_F(WaitingPortTest, WakesWhenAnOutputThatHasAValueIsConnected) {
  auto& sender = MakeSender<int>();
  auto& receiver = MakeReceiver<int>();
  sender.out.Publish(1);
  ActWhileAsleep([&] { Connect(sender.out, receiver.in); }, [&] { EXPECT_TRUE(receiver.in.Wait(kLong)); });
  EXPECT_EQ(*receiver.in.Read(), 1);
}

TEST_F(WaitingPortTest, WakesForAQueueToo) {
  auto& sender = MakeSender<int>();
  auto& other = MakeSender<int>("other");
  auto& receiver = MakeReceiver<int>();
  sender.out.Publish(1);
  ActWhileAsleep([&] { Connect(sender.out, receiver.in, {.queue = 4, .on_full = OnFull::kRefuse}); },
                 [&] { EXPECT_TRUE(receiver.in.Wait(kLong)); });
  EXPECT_THAT(TakeAll(receiver.in), testing::ElementsAre(1));
  EXPECT_FALSE(receiver.in.Wait(milliseconds(1))) << "what has never been Read() does not count";
  ActWhileAsleep([&] { sender.out.Publish(2); }, [&] { EXPECT_TRUE(receiver.in.Wait(kLong)); });
  EXPECT_THAT(TakeAll(receiver.in), testing::ElementsAre(2));
  // The queue of several writers is another one.
  Connect(other.out, receiver.in, {.queue = 4});
  EXPECT_FALSE(receiver.in.Wait(milliseconds(1)));
  ActWhileAsleep([&] { other.out.Publish(3); }, [&] { EXPECT_TRUE(receiver.in.Wait(kLong)); });
  EXPECT_THAT(TakeAll(receiver.in), testing::ElementsAre(3));
}

TEST_F(WaitingPortTest, WakesForEachOfSeveralSources) {
  auto& first = MakeSender<int>("first");
  auto& second = MakeSender<int>("second");
  auto& receiver = MakeReceiver<int>();
  Connect(first.out, receiver.in);
  Connect(second.out, receiver.in);
  for (int i = 1; i <= 4; ++i) {
    auto& sender = i % 2 == 0 ? first : second;
    ActWhileAsleep([&] { sender.out.Publish(i); }, [&] { EXPECT_TRUE(receiver.in.Wait(kLong)); });
    EXPECT_TRUE(receiver.in.Peek().is_new());
    EXPECT_EQ(*receiver.in.Read(), i);
    EXPECT_FALSE(receiver.in.Wait(Duration(0)));
  }
}

TEST_F(WaitingPortTest, MustNotSleepInACycleOrAGuard) {
  auto& receiver = MakeReceiver<int>();
  {
    const CycleScope cycle({});
    EXPECT_THROW((void)receiver.in.Wait(Duration(0)), ProgrammingError);
  }
  {
    const EpochGuard guard;
    EXPECT_THROW((void)receiver.in.Wait(Duration(0)), ProgrammingError);
  }
  EXPECT_FALSE(receiver.in.Wait(Duration(0)));
}

TEST_F(WaitingPortTest, AnExecutorsWakerIsToldBesides) {
  auto& sender = MakeSender<int>();
  auto& receiver = MakeReceiver<int>();
  CountingWaker waker;
  receiver.in.SetWaker(&waker);
  Connect(sender.out, receiver.in);
  ActWhileAsleep([&] { sender.out.Publish(1); }, [&] { EXPECT_TRUE(receiver.in.Wait(kLong)); });
  EXPECT_EQ(waker.wakes, 1);
  receiver.in.SetWaker(nullptr);
  EXPECT_EQ(*receiver.in.Read(), 1);
  ActWhileAsleep([&] { sender.out.Publish(2); }, [&] { EXPECT_TRUE(receiver.in.Wait(kLong)); });
  EXPECT_EQ(waker.wakes, 1);
}

TEST_F(WaitingPortTest, PublishersDoNotCallTheSystemWhenNobodySleeps) {
  auto& sender = MakeSender<double>();
  auto& receiver = MakeReceiver<double>();
  Connect(sender.out, receiver.in);
  EXPECT_FALSE(receiver.in.Wait(milliseconds(1)));
  const CycleScope cycle({.now = Time(Duration(1))});
  for (int i = 0; i < 10; ++i) sender.out.Publish(1.0);
  {
    const AllocationGuard allocations;
    const LockProbe locks;
    for (int i = 0; i < 100; ++i) sender.out.Publish(1.0);
    EXPECT_EQ(allocations.allocations(), 0u);
    EXPECT_EQ(locks.locks(), 0u);
  }
  SystemCallProbe calls;
  for (int i = 0; i < 100; ++i) sender.out.Publish(1.0);
  EXPECT_EQ(calls.Stop(), -1);
}

TEST_F(WaitingPortTest, AnInputThatSaysThatItWaitsNeitherAllocatesNorLocksWhenItDoes) {
  auto& sender = MakeSender<double>();
  auto& receiver = MakeReceiver<double>("receiver", {.waits = true});
  Connect(sender.out, receiver.in);
  (void)ThisThread();  // registers it
  const AllocationGuard allocations;
  const LockProbe locks;
  EXPECT_FALSE(receiver.in.Wait(milliseconds(1)));
  EXPECT_EQ(allocations.allocations(), 0u);
  EXPECT_EQ(locks.locks(), 0u);
}

// A publisher that waits for all answers before it goes on: a lost wake-up stops it for good.
template <typename T, typename Make>
void PlayRounds(Sender<T>& sender, std::vector<Receiver<T>*> receivers, std::vector<Receiver<int>*> answers,
                std::vector<Sender<int>*> answerers, const Make& make) {
  const auto count = static_cast<unsigned>(receivers.size());
  std::atomic<int> lost{0}, wrong{0};
  RunTogether(count + 1, [&](unsigned index) {
    for (int round = 1; round <= kRounds && lost == 0; ++round) {
      if (index == count) {
        sender.out.Publish(make(round));
        for (auto* answer : answers) {
          if (!answer->in.Wait(kLong)) ++lost;
          if (*answer->in.Read() != round) ++wrong;
        }
      } else {
        if (!receivers[index]->in.Wait(kLong)) ++lost;
        (void)receivers[index]->in.Read();
        answerers[index]->out.Publish(round);
      }
    }
  });
  EXPECT_EQ(lost, 0);
  EXPECT_EQ(wrong, 0);
}

TEST_F(WaitingPortTest, NoWakeUpIsLostForAnyOfSeveralReaders) {
  auto& sender = MakeSender<Scan>();
  std::vector<Receiver<Scan>*> receivers;
  std::vector<Receiver<int>*> answers;
  std::vector<Sender<int>*> answerers;
  for (const std::string name : {"a", "b", "c"}) {
    receivers.push_back(&MakeReceiver<Scan>("receiver_" + name));
    answers.push_back(&MakeReceiver<int>("answer_" + name));
    answerers.push_back(&MakeSender<int>("answerer_" + name));
    Connect(sender.out, receivers.back()->in);
    Connect(answerers.back()->out, answers.back()->in);
  }
  PlayRounds(sender, receivers, answers, answerers, [](int n) { return Scan{{}, n}; });
}

// Each value is taken, whatever comes and goes beside.
template <typename Body>
void TakeAllOf(Sender<int>& sender, Receiver<int>& receiver, const Body& beside) {
  std::atomic<bool> done{false};
  std::atomic<int> lost{0};
  int taken = 0;
  RunTogether(3, [&](unsigned index) {
    if (index == 0) {
      for (int i = 1; i <= kRounds && lost == 0;) {
        if (sender.out.Publish(i) == PublishStatus::kPublished) ++i;
      }
    } else if (index == 1) {
      while (taken < kRounds && lost == 0) {
        if (!receiver.in.Wait(kLong)) ++lost;
        receiver.in.Drain([&](const Lease<int>& lease) {
          if (*lease > 0) ++taken;
        });
      }
      done = true;
    } else {
      while (!done) beside();
    }
  });
  EXPECT_EQ(lost, 0);
  EXPECT_EQ(taken, kRounds);
}

TEST_F(WaitingPortTest, NothingThatIsQueuedIsSleptOver) {
  auto& sender = MakeSender<int>();
  auto& receiver = MakeReceiver<int>();
  Connect(sender.out, receiver.in, {.queue = 2, .on_full = OnFull::kRefuse});
  TakeAllOf(sender, receiver, [] { std::this_thread::yield(); });
}

TEST_F(WaitingPortTest, NothingIsSleptOverWhileAnotherSourceComesAndGoes) {
  auto& sender = MakeSender<int>();
  auto& other = MakeSender<int>("other");
  auto& receiver = MakeReceiver<int>();
  const ConnectOptions options{.queue = 8, .on_full = OnFull::kRefuse};
  Connect(sender.out, receiver.in, options);
  TakeAllOf(sender, receiver, [&] {
    Connect(other.out, receiver.in, options);
    other.out.Publish(-1);
    EXPECT_TRUE(Port::Disconnect(other.out, receiver.in));
  });
}

TEST_F(WaitingPortTest, TheLatestValueIsFoundWhileConnectionsComeAndGo) {
  auto& sender = MakeSender<int>();
  auto& receiver = MakeReceiver<int>();
  std::atomic<bool> done{false};
  std::atomic<int> lost{0}, read{0};
  RunTogether(3, [&](unsigned index) {
    if (index == 0) {
      for (int i = 1; !done; ++i) {
        // Only once the one before has been seen: it is the connection, too, that has to wake.
        sender.out.Publish(i);
        while (!done && read < i) std::this_thread::yield();
      }
    } else if (index == 1) {
      for (int round = 0; round < kRounds / 5 && lost == 0; ++round) {
        if (!receiver.in.Wait(kLong)) ++lost;
        // May have been disconnected since.
        if (const auto lease = receiver.in.Read()) read = *lease;
      }
      done = true;
    } else {
      while (!done) {
        Connect(sender.out, receiver.in);
        std::this_thread::yield();
        EXPECT_TRUE(Port::Disconnect(sender.out, receiver.in));
      }
    }
  });
  EXPECT_EQ(lost, 0);
}

TEST_F(WaitingPortTest, AnInputGoesWhileItsSourcePublishes) {
  auto& sender = MakeSender<int>();
  std::atomic<bool> done{false};
  RunTogether(2, [&](unsigned index) {
    if (index == 0) {
      while (!done) sender.out.Publish(1);
      return;
    }
    for (int round = 0; round < kRounds / 10; ++round) {
      auto& receiver = MakeReceiver<int>("passing");
      Connect(sender.out, receiver.in);
      (void)receiver.in.Wait(Duration(1));
      EXPECT_TRUE(runtime.Delete(receiver));
    }
    done = true;
  });
}

}  // namespace
}  // namespace runnel::test
