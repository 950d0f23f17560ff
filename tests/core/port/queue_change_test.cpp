// An input's queue is replaced when a second source comes or goes, or a longer one is asked for.
// Connections that stay lose nothing by it, and nothing is overtaken.

#include <array>
#include <atomic>
#include <cstring>
#include <functional>
#include <thread>
#include <utility>

#include "core/channel/queued_value.h"
#include "plugins/real_time_check/sanitizer.h"
#include "tests/core/port/port_fixture.h"
#include "tests/support/threads.h"

namespace runnel::test {
namespace {

using testing::ElementsAre;

/// A plain value, of which queues have copies. No other type has its size, so what is done below when one
/// is put into a queue is done to no other.
struct Interrupting {
  int number = 0;
  std::array<int, 16> more{};  // too large to travel without a buffer
  static inline std::function<void()> interrupt;
};
void Describe(TypeBuilder<Interrupting>& type) { type.Name("test::Interrupting"); }
static_assert(!kIsInlined<Interrupting> && kLiesInQueuesAsCopy<Interrupting>);

}  // namespace
}  // namespace runnel::test

// Calls what it is told when a value is put into a queue.
namespace runnel::internal {
using test::Interrupting;
template <>
QueuedCopy<sizeof(Interrupting), alignof(Interrupting)>::QueuedCopy(Content copied, const Publication& of,
                                                                    std::uint64_t from) noexcept
    : source(from), timestamp(of.timestamp), publication_time(of.publication_time), own_sequence(of.sequence) {
  std::memcpy(value, copied, sizeof value);
  if (Interrupting::interrupt) std::exchange(Interrupting::interrupt, nullptr)();
}
}  // namespace runnel::internal

namespace runnel::test {
namespace {

class QueueChangeTest : public PortTest {
 protected:
  template <typename T>
  static void PublishNumber(Output<T>& output, int number) {
    auto loan = output.Loan();
    loan->number = number;
    (void)output.Publish(std::move(loan));
  }
  // Publishes `number` from `sender`, and calls `interrupt` when the value is being put into the queue of
  // an input that is connected before `later`, which does not have it yet.
  template <typename Interrupt>
  void PublishInterrupted(Sender<Interrupting>& sender, Receiver<Interrupting>& later, int number,
                          Interrupt&& interrupt) {
    auto& first = MakeReceiver<Interrupting>("first");
    Connect(sender.out, first.in, {.queue = 1});
    Connect(sender.out, later.in, {.queue = 4, .on_full = OnFull::kRefuse});
    Interrupting::interrupt = interrupt;
    PublishNumber(sender.out, number);
    ASSERT_FALSE(Interrupting::interrupt) << "the publication was not interrupted";
  }
  static std::vector<int> TakeNumbers(Input<Interrupting>& input) {
    std::vector<int> numbers;
    input.Drain([&](const Lease<Interrupting>& lease) { numbers.push_back(lease->number); });
    return numbers;
  }
};

// The publisher has found the queue; then this is replaced twice, and is empty each time; then the
// publisher puts its value in.
TEST_F(QueueChangeTest, ValueThatComesLateIntoAReplacedQueueIsNotLost) {
  auto& sender = MakeSender<Interrupting>();
  auto& receiver = MakeReceiver<Interrupting>();
  auto& other = MakeSender<Interrupting>("other");
  PublishInterrupted(sender, receiver, 1, [&] {
    for (int i = 0; i < 3; ++i) {
      Connect(other.out, receiver.in, {.queue = 4, .on_full = OnFull::kRefuse});
      ASSERT_TRUE(Port::Disconnect(other.out, receiver.in));
    }
    EXPECT_THAT(TakeNumbers(receiver.in), ElementsAre());
  });
  PublishNumber(sender.out, 2);
  EXPECT_THAT(TakeNumbers(receiver.in), ElementsAre(1, 2));
}

// What is kept for late publishers goes when there can be none any more.
TEST_F(QueueChangeTest, EmptyReplacedQueuesAreNotKept) {
  auto& sender = MakeSender<Scan>();
  auto& other = MakeSender<Scan>("other");
  auto& receiver = MakeReceiver<Scan>();
  Connect(sender.out, receiver.in, {.queue = 2, .on_full = OnFull::kRefuse});
  for (int i = 0; i < 100; ++i) {
    Connect(other.out, receiver.in, {.queue = 3});
    ASSERT_TRUE(Port::Disconnect(other.out, receiver.in));
    EXPECT_LE(receiver.in.replaced_queues(), 1u);
  }
}

TEST_F(QueueChangeTest, DropsOfAReplacedQueueStayCounted) {
  auto& sender = MakeSender<int>();
  auto& other = MakeSender<int>("other");
  auto& receiver = MakeReceiver<int>();
  Connect(sender.out, receiver.in, {.queue = 2, .on_full = OnFull::kRefuse});
  for (int i = 0; i < 5; ++i) sender.out.Publish(i);
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(receiver.in.dropped(), 3u);
    Connect(other.out, receiver.in, {.queue = 2, .on_full = OnFull::kRefuse});
    EXPECT_EQ(receiver.in.dropped(), 3u);
    ASSERT_TRUE(Port::Disconnect(other.out, receiver.in));
    (void)TakeAll(receiver.in);
  }
}

// What waits in the queue before takes its share of the room.
TEST_F(QueueChangeTest, PublisherThatAsksIsToldThatTheQueueBeforeLeavesNoRoom) {
  auto& sender = MakeSender<int>();
  auto& other = MakeSender<int>("other");
  auto& receiver = MakeReceiver<int>();
  Connect(sender.out, receiver.in, {.queue = 2, .on_full = OnFull::kRefuse});
  EXPECT_FALSE(sender.out.WouldRefuse());
  for (int i = 0; i < 2; ++i) EXPECT_EQ(sender.out.Publish(i), PublishStatus::kPublished);
  Connect(other.out, receiver.in, {.queue = 2, .on_full = OnFull::kRefuse});
  EXPECT_TRUE(sender.out.WouldRefuse());
  EXPECT_EQ(sender.out.Publish(2), PublishStatus::kRefused);
  EXPECT_EQ(TakeAll(receiver.in).size(), 2u);
  EXPECT_FALSE(sender.out.WouldRefuse());
  EXPECT_EQ(sender.out.Publish(3), PublishStatus::kPublished);
}

// Nobody reads while the queue is replaced many times: the values that wait do not pile up.
TEST_F(QueueChangeTest, ChangesDoNotMakeMoreValuesWaitThanThereIsRoomFor) {
  for (const OnFull on_full : {OnFull::kDropOldest, OnFull::kDropNewest, OnFull::kRefuse}) {
    const std::string name = std::to_string(static_cast<int>(on_full));
    auto& sender = MakeSender<Scan>("sender" + name);
    auto& other = MakeSender<Scan>("other" + name);
    auto& receiver = MakeReceiver<Scan>("receiver" + name);
    Connect(sender.out, receiver.in, {.queue = 3, .on_full = on_full});
    std::uint64_t published = 0;
    for (std::size_t i = 0; i < 50; ++i) {
      Connect(other.out, receiver.in, {.queue = 4 + i % 2, .on_full = on_full});
      for (int k = 0; k < 3; ++k, ++published) sender.out.Publish(Scan{{}, k});
      ASSERT_TRUE(Port::Disconnect(other.out, receiver.in));
      for (int k = 0; k < 3; ++k, ++published) sender.out.Publish(Scan{{}, k});
    }
    EXPECT_LE(receiver.in.replaced_queues(), 5u);
    const std::uint64_t taken = TakeAll(receiver.in).size();
    EXPECT_GE(taken, 3u);
    EXPECT_LE(taken, 8u);
    EXPECT_EQ(taken + receiver.in.dropped(), published);
    // The room is there again once they have been taken.
    for (int k = 0; k < 3; ++k) EXPECT_EQ(sender.out.Publish(Scan{}), PublishStatus::kPublished);
    EXPECT_EQ(TakeAll(receiver.in).size(), 3u);
  }
}

// One source stays; a second comes and goes, which replaces the queue each time.
template <typename T, typename Make, typename NumberOf>
void NothingIsLostOrOvertaken(Runtime& runtime, const Make& make, const NumberOf& number_of) {
  constexpr int kChanges = RUNNEL_UNDER_SANITIZER ? 500 : 1000;
  auto& stays = runtime.Create<Sender<T>>(runtime.root(), "stays");
  auto& comes = runtime.Create<Sender<T>>(runtime.root(), "comes");
  auto& receiver = runtime.Create<Receiver<T>>(runtime.root(), "receiver");
  const ConnectOptions options{.queue = 8, .on_full = OnFull::kRefuse};
  ASSERT_TRUE(Port::Connect(stays.out, receiver.in, options));
  std::atomic<bool> changing{true}, publishing{true};
  int accepted = 0, lost = 0, taken = 0;
  RunTogether(3, [&](unsigned index) {
    if (index == 0) {
      // A number that was refused is not published again, but the next one is its sequel.
      while (changing) {
        if (stays.out.Publish(make(accepted + 1)) == PublishStatus::kPublished) {
          ++accepted;
        } else {
          std::this_thread::yield();
        }
      }
      publishing = false;
    } else if (index == 1) {
      for (bool last = false; !last;) {
        last = !publishing;
        receiver.in.Drain([&](const Lease<T>& lease) {
          const int number = number_of(*lease);
          if (number != ++taken) ++lost;
          taken = number;
        });
      }
    } else {
      for (int i = 0; i < kChanges; ++i) {
        ASSERT_TRUE(Port::Connect(comes.out, receiver.in, options));
        MaybeYield();
        ASSERT_TRUE(Port::Disconnect(comes.out, receiver.in));
        MaybeYield();
      }
      changing = false;
    }
  });
  EXPECT_EQ(lost, 0);
  EXPECT_EQ(taken, accepted);
  EXPECT_GT(taken, 0);
}

TEST_F(QueueChangeTest, SmallValuesAreNeitherLostNorOvertaken) {
  NothingIsLostOrOvertaken<int>(
      runtime, [](int i) { return i; }, [](int i) { return i; });
}

TEST_F(QueueChangeTest, ValuesInBuffersAreNeitherLostNorOvertaken) {
  NothingIsLostOrOvertaken<Scan>(
      runtime,
      [](int i) {
        return Scan{{}, i};
      },
      [](const Scan& scan) { return scan.number; });
}

}  // namespace
}  // namespace runnel::test
