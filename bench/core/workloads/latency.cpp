// How long a message of 128 bytes is on its way from the thread that publishes it to one that polls
// for it: from before publishing until the reader has its copy.

#include <memory>
#include <thread>

#include "bench/core/rivals/boost_queues.h"
#include "bench/core/rivals/mutex_value.h"
#include "bench/core/rivals/seqlock.h"
#include "bench/core/rivals/triple_buffer.h"
#include "bench/core/support/latency_meter.h"
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

template <typename Transport>
void RunPolled(benchmark::State& state, std::uint64_t messages) {
  for (auto _ : state) {
    const auto transport = std::make_unique<Transport>();
    LatencyMeter meter(messages);
    {
      const PinnedThread first_core(0);
      const std::jthread reader([&] {
        const PinnedThread second_core(1);
        const InACycle cycle;
        Message message;
        for (std::uint64_t i = 0; i < meter.messages(); ++i) {
          for (Waiting waiting; !transport->Take(message);) waiting.Pause();
          meter.Received(message);
        }
      });
      const InACycle cycle;
      meter.SendAll([&](const Message& message) { transport->Write(message); },
                    [](std::uint64_t number) { Idle(500 + static_cast<unsigned>(number * 7 % 16) * 20); });
    }
    state.counters["p50"] = meter.Percentile(0.5);
    state.counters["p99"] = meter.Percentile(0.99);
  }
}

template <typename Transport>
void AddPolled(Suite& suite, Role role, const std::string& name) {
  const std::uint64_t messages = suite.settings().quick ? 10'000 : 50'000;
  suite.Add(role, name, [messages](benchmark::State& state) { RunPolled<Transport>(state, messages); })->Iterations(1);
}

}  // namespace

void AddLatency(Suite& suite) {
  suite.Start({.name = "one-way latency of 128 B, polled", .quantities = {{"p50", "ns"}, {"p99", "ns"}}});
  AddPolled<RunnelPort>(suite, Role::kRunnel, "Read");
  AddPolled<Seqlock<Message>>(suite, Role::kRival, Seqlock<Message>::kName);
  AddPolled<TripleBuffer<Message>>(suite, Role::kRival, TripleBuffer<Message>::kName);
  AddPolled<MutexValue<Message>>(suite, Role::kRival, MutexValue<Message>::kName);
  using Spsc = BoostSpscQueue<Message>;
  AddPolled<Spsc>(suite, Role::kRival, Spsc::kName);
}

}  // namespace runnel::bench
