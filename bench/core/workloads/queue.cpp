// Messages of 128 bytes from one thread to another, each of them once and in order, through a queue
// that holds 1024: a full queue refuses, and the producer tries again. The queue that drops the oldest, the
// usual one of connections, is filled as far as it goes and no farther, too, so that both do the same.

#include <atomic>
#include <memory>
#include <thread>

#include "bench/core/rivals/boost_queues.h"
#include "bench/core/rivals/moodycamel_queue.h"
#include "bench/core/rivals/mutex_ring.h"
#include "bench/core/support/payloads.h"
#include "bench/core/support/pinned_thread.h"
#include "bench/core/support/star.h"
#include "bench/core/support/waiting.h"
#include "bench/core/workloads/workloads.h"

namespace runnel::bench {

namespace {

constexpr std::uint64_t kMessagesPerRound = 100'000;
constexpr std::size_t kCapacity = 1024;
// How often the consumer of the queue that drops says how far it is: the line for that is the measurement's, not the
// queue's, and is to cost little.
constexpr std::uint64_t kToldAtOnce = 64;

template <OnFull kOnFull>
class RunnelQueue {
 public:
  static constexpr const char* kName = kOnFull == OnFull::kRefuse ? "queued input" : "queued input, drop oldest";

  bool Push(const Message& message) {
    if constexpr (kOnFull == OnFull::kRefuse) {
      if (star_.output().WouldRefuse()) return false;
    } else if (++sent_ - seen_taken_ > kCapacity) {
      // Nothing is lost as long as no more are on their way than the queue holds.
      seen_taken_ = taken_.load(std::memory_order_acquire);
      if (sent_ - seen_taken_ > kCapacity) return --sent_, false;
    }
    return star_.output().Publish(message) == PublishStatus::kPublished;
  }
  bool Take(Message& message) {
    const auto lease = star_.input(0).Take();
    if (lease) message = *lease;
    if constexpr (kOnFull != OnFull::kRefuse) {
      if (lease && ++taken_here_ % kToldAtOnce == 0) taken_.store(taken_here_, std::memory_order_release);
    }
    return lease.has_value();
  }

 private:
  Star<Message> star_{1, {.queue = kCapacity, .on_full = kOnFull}};
  // The producer's notes on a line of their own: the consumer looks into the star, the end of which would lie on theirs.
  alignas(64) std::uint64_t sent_ = 0;
  std::uint64_t seen_taken_ = 0;
  alignas(64) std::atomic<std::uint64_t> taken_{0};
  alignas(64) std::uint64_t taken_here_ = 0;  // the consumer's
};

// The thread that takes; tells when a round is complete, and whether nothing was lost.
template <typename Queue>
class Consumer {
 public:
  explicit Consumer(Queue& queue) : queue_(queue) {}

  void WaitFor(std::uint64_t taken) const {
    for (Waiting waiting; taken_.load(std::memory_order_acquire) < taken;) waiting.Pause();
  }
  [[nodiscard]] bool is_in_order() const { return is_in_order_; }

 private:
  void Run(const std::stop_token& stop) {
    const PinnedThread second_core(1);
    const InACycle cycle;
    Message message;
    PatientWaiting waiting;
    for (std::uint64_t taken = 0; !stop.stop_requested();) {
      if (!queue_.Take(message)) {
        waiting.Pause();
        continue;
      }
      waiting.Succeeded();
      if (message.number != taken) is_in_order_ = false;
      if (++taken % kMessagesPerRound == 0) taken_.store(taken, std::memory_order_release);
    }
  }

  Queue& queue_;
  std::atomic<std::uint64_t> taken_{0};
  std::atomic<bool> is_in_order_{true};
  std::jthread thread_{[this](const std::stop_token& stop) { Run(stop); }};
};

template <typename Queue>
void RunQueue(benchmark::State& state) {
  const auto queue = std::make_unique<Queue>();
  const PinnedThread first_core(0);
  Consumer<Queue> consumer(*queue);
  const InACycle cycle;
  Message message{};
  std::uint64_t sent = 0;
  PatientWaiting waiting;
  for (auto _ : state) {
    for (std::uint64_t i = 0; i < kMessagesPerRound; ++i) {
      message.number = sent++;
      while (!queue->Push(message)) waiting.Pause();
      waiting.Succeeded();
    }
    consumer.WaitFor(sent);
  }
  if (!consumer.is_in_order()) state.SkipWithError("messages were lost or came out of order");
  state.counters["throughput"] = benchmark::Counter(static_cast<double>(sent) * 1e-6, benchmark::Counter::kIsRate);
}

}  // namespace

void AddQueue(Suite& suite) {
  suite.Start({.name = "queue of 128 B, two threads", .quantities = {{"throughput", "M/s", true}}});
  suite.Add(Role::kRunnel, RunnelQueue<OnFull::kRefuse>::kName, RunQueue<RunnelQueue<OnFull::kRefuse>>);
  suite.Add(Role::kRunnel, RunnelQueue<OnFull::kDropOldest>::kName, RunQueue<RunnelQueue<OnFull::kDropOldest>>);
  using SpscQueue = BoostSpscQueue<Message, kCapacity>;
  suite.Add(Role::kRival, SpscQueue::kName, RunQueue<SpscQueue>);
#ifdef RUNNEL_BENCH_HAS_MOODYCAMEL
  using Moodycamel = MoodycamelQueue<Message, kCapacity>;
  suite.Add(Role::kRival, Moodycamel::kName, RunQueue<Moodycamel>);
#endif
  using Boost = BoostQueue<Message, kCapacity>;
  suite.Add(Role::kRival, Boost::kName, RunQueue<Boost>);
  using Ring = MutexRing<Message, kCapacity>;
  suite.Add(Role::kRival, Ring::kName, RunQueue<Ring>);
}

}  // namespace runnel::bench
