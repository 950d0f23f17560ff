// Values that readers have made when they read, while everything else changes.

#include <atomic>
#include <stdexcept>
#include <thread>

#include "core/base/check.h"
#include "plugins/real_time_check/sanitizer.h"
#include "tests/core/port/pull_fixture.h"
#include "tests/support/threads.h"

namespace runnel::test {
namespace {

constexpr int kPullRounds = RUNNEL_UNDER_SANITIZER ? 1000 : 5000;
using PullThreadsTest = PullTest;

// Two readers pull, a third one reads what is pushed, the publisher publishes, and somebody changes
// strategies and providers. What a provider refers to goes when SetProvider() has returned.
template <typename T, typename Number, typename Make>
void ChangeUnderFire(Sender<T>& sender, const std::vector<Receiver<T>*>& receivers, const Number& number_of,
                     const Make& make) {
  constexpr int kGone = -1;
  std::atomic<bool> stop{false};
  std::atomic<int> torn{0}, backward{0}, after_its_end{0}, together{0}, running{0};
  std::atomic<int> refused_silently{0}, pulled{0};
  std::atomic<int> last{0};
  const auto count = static_cast<unsigned>(receivers.size());
  RunTogether(count + 2, [&](unsigned index) {
    if (index < count) {
      std::uint64_t last_sequence = 0;
      while (!stop) {
        MaybeYield();
        const auto lease = receivers[index]->in.Read();
        if (!lease) continue;
        if (number_of(*lease) == kGone) ++torn;
        if (lease.sequence() < last_sequence) ++backward;
        last_sequence = lease.sequence();
      }
    } else if (index == count) {
      while (!stop) {
        MaybeYield();
        const auto status = sender.out.Publish(make(++last));
        if (status != PublishStatus::kPublished && status != PublishStatus::kBusy) {
          ++refused_silently;
        }
      }
    } else {
      for (int round = 0; round < kPullRounds / 5 || pulled == 0; ++round) {
        const auto alive = std::make_unique<std::atomic<bool>>(true);
        sender.out.SetProvider([&, alive = alive.get()](T& value) {
          if (++running != 1) ++together;
          MaybeYield();
          if (!*alive) ++after_its_end;
          value = make(++last);
          ++pulled;
          --running;
          return true;
        });
        receivers[0]->in.SetStrategy(round % 2 == 0 ? Strategy::kPull : Strategy::kPush);
        std::this_thread::yield();
        if (round % 3 == 0) {
          EXPECT_TRUE(Port::Disconnect(sender.out, receivers[0]->in));
          EXPECT_TRUE(Port::Connect(sender.out, receivers[0]->in, {.queue = 2}));
        }
        sender.out.SetProvider({});
        *alive = false;
      }
      stop = true;
    }
  });
  EXPECT_EQ(torn, 0);
  EXPECT_EQ(backward, 0);
  EXPECT_EQ(after_its_end, 0);
  EXPECT_EQ(together, 0);
  EXPECT_EQ(refused_silently, 0);
  EXPECT_GT(pulled, 0);
  EXPECT_EQ(sender.out.pull_failures(), 0u);
}

TEST_F(PullThreadsTest, SmallTypesArePulledAndPushedWhileAllChanges) {
  auto& sender = MakeSender<std::array<int, 8>>("sender", kPullable);
  std::vector<Receiver<std::array<int, 8>>*> receivers;
  for (const char* name : {"a", "b", "c"}) {
    receivers.push_back(&MakeReceiver<std::array<int, 8>>(name, name[0] == 'c' ? InputOptions{} : kPulls));
    Connect(sender.out, receivers.back()->in);
  }
  ChangeUnderFire(
      sender, receivers,
      [](const auto& value) {
        for (const int each : value) {
          if (each != value[0]) return -1;
        }
        return value[0];
      },
      [](int number) {
        std::array<int, 8> value;
        value.fill(number);
        return value;
      });
}

TEST_F(PullThreadsTest, ValuesInBuffersArePulledAndPushedWhileAllChanges) {
  auto& sender = MakeSender<Scan>("sender", kPullable);
  std::vector<Receiver<Scan>*> receivers;
  for (const char* name : {"a", "b", "c"}) {
    receivers.push_back(&MakeReceiver<Scan>(name, name[0] == 'c' ? InputOptions{} : kPulls));
    Connect(sender.out, receivers.back()->in);
  }
  ChangeUnderFire(
      sender, receivers,
      [](const Scan& value) {
        for (const float each : value.ranges) {
          if (each != static_cast<float>(value.number)) return -1;
        }
        return value.number;
      },
      [](int number) {
        return Scan{std::vector<float>(20, static_cast<float>(number)), number};
      });
}

TEST_F(PullThreadsTest, AnOutputGoesWhileOthersPullFromIt) {
  auto& receiver = MakeReceiver<int>("receiver", kPulls);
  std::atomic<bool> stop{false};
  std::atomic<int> after_its_end{0};
  RunTogether(2, [&](unsigned index) {
    if (index == 0) {
      while (!stop) (void)receiver.in.Read();
      return;
    }
    for (int round = 0; round < kPullRounds / 10; ++round) {
      auto& sender = MakeSender<int>("passing", kPullable);
      std::atomic<bool> alive{true};
      sender.out.SetProvider([&](int& value) {
        if (!alive) ++after_its_end;
        return value = 1, true;
      });
      Connect(sender.out, receiver.in);
      std::this_thread::yield();
      EXPECT_TRUE(runtime.Delete(sender));
      alive = false;
    }
    stop = true;
  });
  EXPECT_EQ(after_its_end, 0);
}

}  // namespace
}  // namespace runnel::test
