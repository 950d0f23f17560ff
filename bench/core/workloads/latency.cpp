// How long a message of 128 bytes is on its way from the thread that publishes it to one that polls
// for it: from before publishing until the reader has its copy. Each message waits until the one
// before has come and a little longer, so that the reader is polling again.

#include <algorithm>
#include <atomic>
#include <chrono>
#include <memory>
#include <thread>
#include <vector>

#include "bench/core/rivals/boost_queues.h"
#include "bench/core/rivals/mutex_value.h"
#include "bench/core/rivals/seqlock.h"
#include "bench/core/rivals/triple_buffer.h"
#include "bench/core/support/payloads.h"
#include "bench/core/support/pinned_thread.h"
#include "bench/core/support/star.h"
#include "bench/core/support/waiting.h"
#include "bench/core/workloads/workloads.h"

namespace runnel::bench {

namespace {

class RunnelPort {
 public:
  void Write(const Message& message) { star_.output().Publish(message); }
  bool Take(Message& message) {
    const auto lease = star_.input(0).Read();
    if (!lease.is_new()) return false;
    message = *lease;
    return true;
  }

 private:
  Star<Message> star_{1};
};

std::int64_t Now() {
  return std::chrono::steady_clock::now().time_since_epoch() / std::chrono::nanoseconds(1);
}

/// Waits for a message by asking again and again. A transport that can sleep until data comes gets
/// a second way of waiting here.
struct Polling {
  template <typename Transport>
  static void Receive(Transport& transport, Message& message) {
    for (Waiting waiting; !transport.Take(message);) waiting.Pause();
  }
};

double Percentile(std::vector<double>& samples, double share) {
  const auto nth = samples.begin() +
                   static_cast<std::ptrdiff_t>(share * static_cast<double>(samples.size() - 1));
  std::nth_element(samples.begin(), nth, samples.end());
  return *nth;
}

template <typename Transport, typename Way>
std::vector<double> MeasureLatencies(std::uint64_t messages) {
  const auto transport = std::make_unique<Transport>();
  std::vector<double> latencies;
  latencies.reserve(messages);
  alignas(64) std::atomic<std::uint64_t> received{0};
  const PinnedThread first_core(0);
  const std::jthread reader([&] {
    const PinnedThread second_core(1);
    const InACycle cycle;
    Message message;
    for (std::uint64_t i = 0; i < messages; ++i) {
      Way::Receive(*transport, message);
      const std::int64_t now = Now();
      latencies.push_back(static_cast<double>(now - message.sent));
      received.store(message.number, std::memory_order_release);
    }
  });
  const InACycle cycle;
  Message message{};
  for (message.number = 1; message.number <= messages; ++message.number) {
    Idle(500 + static_cast<unsigned>(message.number * 7 % 16) * 20);
    message.sent = Now();
    transport->Write(message);
    for (Waiting waiting; received.load(std::memory_order_acquire) < message.number;) {
      waiting.Pause();
    }
  }
  return latencies;
}

template <typename Transport, typename Way>
void RunLatency(benchmark::State& state, std::uint64_t messages) {
  for (auto _ : state) {
    std::vector<double> latencies = MeasureLatencies<Transport, Way>(messages);
    state.counters["p50"] = Percentile(latencies, 0.5);
    state.counters["p99"] = Percentile(latencies, 0.99);
  }
}

template <typename Transport>
void AddPolled(Suite& suite, Role role, const std::string& name) {
  const std::uint64_t messages = suite.settings().quick ? 10'000 : 50'000;
  suite
      .Add(role, name,
           [messages](benchmark::State& state) { RunLatency<Transport, Polling>(state, messages); })
      ->Iterations(1);
}

}  // namespace

void AddLatency(Suite& suite) {
  suite.Start(
      {.name = "one-way latency of 128 B, polled", .quantities = {{"p50", "ns"}, {"p99", "ns"}}});
  AddPolled<RunnelPort>(suite, Role::kRunnel, "Read");
  AddPolled<Seqlock<Message>>(suite, Role::kRival, Seqlock<Message>::kName);
  AddPolled<TripleBuffer<Message>>(suite, Role::kRival, TripleBuffer<Message>::kName);
  AddPolled<MutexValue<Message>>(suite, Role::kRival, MutexValue<Message>::kName);
  using Spsc = BoostSpscQueue<Message>;
  AddPolled<Spsc>(suite, Role::kRival, Spsc::kName);
}

}  // namespace runnel::bench
