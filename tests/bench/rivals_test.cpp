// A rival that lost values or tore them would be no rival.

#include <atomic>
#include <memory>
#include <thread>

#include <gmock/gmock.h>

#include "bench/core/rivals/atomic_shared_pointer.h"
#include "bench/core/rivals/boost_queues.h"
#include "bench/core/rivals/moodycamel_queue.h"
#include "bench/core/rivals/mutex_ring.h"
#include "bench/core/rivals/mutex_shared_pointer.h"
#include "bench/core/rivals/mutex_value.h"
#include "bench/core/rivals/seqlock.h"
#include "bench/core/rivals/shared_pool.h"
#include "bench/core/rivals/triple_buffer.h"
#include "bench/core/support/payloads.h"
#include "bench/core/support/waiting.h"

namespace runnel::bench {
namespace {

constexpr int kMessages = 20'000;
constexpr int kValues = 500'000;  // enough for writer and reader to be at work together

Message Numbered(std::uint64_t number) {
  Message message{};
  message.number = number;
  message.content.fill(number);
  return message;
}

bool IsWhole(const Message& message) {
  for (const std::uint64_t word : message.content) {
    if (word != message.number) return false;
  }
  return true;
}

template <typename Cell>
class NewestValue : public ::testing::Test {};
#if defined(__SANITIZE_THREAD__)
// It reports a race within libstdc++'s atomic<shared_ptr>, and does not know moodycamel's fences.
using Cells =
    ::testing::Types<MutexValue<Message>, MutexSharedPointer<Message>, Seqlock<Message>, TripleBuffer<Message>>;
#else
using Cells = ::testing::Types<MutexValue<Message>, MutexSharedPointer<Message>, AtomicSharedPointer<Message>,
                               Seqlock<Message>, TripleBuffer<Message>>;
#endif
TYPED_TEST_SUITE(NewestValue, Cells);

TYPED_TEST(NewestValue, IsTakenOnceWholeAndNeverOlder) {
  const auto cell = std::make_unique<TypeParam>();
  Message message{};
  EXPECT_FALSE(cell->Take(message));
  const std::jthread writer([&] {
    for (std::uint64_t number = 1; number <= kValues; ++number) cell->Write(Numbered(number));
  });
  for (std::uint64_t last = 0; last < kValues; last = message.number) {
    for (Waiting waiting; !cell->Take(message);) waiting.Pause();
    ASSERT_TRUE(IsWhole(message));
    ASSERT_GT(message.number, last);
  }
  EXPECT_FALSE(cell->Take(message));
}

template <typename Queue>
class MessageQueue : public ::testing::Test {};
#if defined(RUNNEL_BENCH_HAS_MOODYCAMEL) && !defined(__SANITIZE_THREAD__)
using Queues = ::testing::Types<BoostSpscQueue<Message, 64>, BoostQueue<Message, 64>, MutexRing<Message, 64>,
                                MoodycamelQueue<Message, 64>>;
#else
using Queues = ::testing::Types<BoostSpscQueue<Message, 64>, BoostQueue<Message, 64>, MutexRing<Message, 64>>;
#endif
TYPED_TEST_SUITE(MessageQueue, Queues);

TYPED_TEST(MessageQueue, HandsOverEachMessageOnceAndInOrder) {
  const auto queue = std::make_unique<TypeParam>();
  const std::jthread producer([&] {
    PatientWaiting waiting;
    for (std::uint64_t number = 0; number < kMessages; ++number) {
      while (!queue->Push(Numbered(number))) waiting.Pause();
      waiting.Succeeded();
    }
  });
  PatientWaiting waiting;
  for (std::uint64_t number = 0; number < kMessages; ++number) {
    Message message{};
    while (!queue->Take(message)) waiting.Pause();
    waiting.Succeeded();
    ASSERT_EQ(message.number, number);
    ASSERT_TRUE(IsWhole(message));
  }
}

TEST(SharedPool, LendsOnlyWhatNobodyHolds) {
  SharedPool<int> pool(2, [] { return std::make_shared<int>(0); });
  auto first = pool.Loan();
  const auto second = pool.Loan();
  ASSERT_TRUE(first);
  ASSERT_TRUE(second);
  EXPECT_NE(first, second);
  EXPECT_FALSE(pool.Loan());
  const int* const address = first.get();
  first.reset();
  EXPECT_EQ(pool.Loan().get(), address);
}

}  // namespace
}  // namespace runnel::bench
