// How long a message of 128 bytes is on its way to a thread that sleeps until it comes. Runnel's
// reader is a module of a thread that runs when data comes.

#include <chrono>
#include <memory>
#include <thread>

#include "bench/core/rivals/waited_value.h"
#include "bench/core/support/latency_meter.h"
#include "bench/core/support/pinned_thread.h"
#include "bench/core/support/star.h"
#include "bench/core/workloads/workloads.h"
#include "core/module/module.h"
#include "plugins/scheduling/scheduler.h"

namespace runnel::bench {

namespace {

// Long enough for the reader to be asleep.
void PauseBetween(std::uint64_t) { std::this_thread::sleep_for(std::chrono::microseconds(100)); }

void Tell(benchmark::State& state, LatencyMeter& meter) {
  state.counters["p50"] = meter.Percentile(0.5);
  state.counters["p99"] = meter.Percentile(0.99);
}

class Listener final : public Module {
 public:
  Listener(const Placement& placement, LatencyMeter& meter) : Module(placement), meter_(meter) {}
  Input<Message> in{this, "in", {.trigger = true}};

 private:
  void Update() override {
    if (!is_pinned_) PinnedThread::Pin(1);
    is_pinned_ = true;
    if (const auto message = in.Read(); message.is_new()) meter_.Received(*message);
  }

  LatencyMeter& meter_;
  bool is_pinned_ = false;
};

void RunModule(benchmark::State& state, std::uint64_t messages) {
  for (auto _ : state) {
    LatencyMeter meter(messages);
    Runtime runtime;
    Scheduler scheduler(runtime);
    auto& sender = runtime.Create<Sender<Message>>(runtime.root(), "sender");
    auto& listener = runtime.Create<Listener>(runtime.root(), "listener", meter);
    MustSucceed(Port::Connect(sender.out, listener.in));
    CreateThread(runtime, "waiting", {.activation = ThreadOptions::Activation::kTrigger});
    MustSucceed(runtime.MakeReady(runtime.root()));
    MustSucceed(scheduler.Start());
    {
      const PinnedThread first_core(0);
      meter.SendAll([&](const Message& message) { sender.out.Publish(message); }, PauseBetween);
    }
    scheduler.Stop();
    Tell(state, meter);
  }
}

template <typename Transport>
void RunTransport(benchmark::State& state, std::uint64_t messages) {
  for (auto _ : state) {
    const auto transport = std::make_unique<Transport>();
    LatencyMeter meter(messages);
    {
      const PinnedThread first_core(0);
      const std::jthread reader([&] {
        const PinnedThread second_core(1);
        Message message;
        for (std::uint64_t i = 0; i < meter.messages(); ++i) {
          transport->WaitAndTake(message);
          meter.Received(message);
        }
      });
      meter.SendAll([&](const Message& message) { transport->Write(message); }, PauseBetween);
    }
    Tell(state, meter);
  }
}

template <typename Transport>
void AddTransport(Suite& suite, std::uint64_t messages) {
  suite
      .Add(Role::kRival, Transport::kName,
           [messages](benchmark::State& state) { RunTransport<Transport>(state, messages); })
      ->Iterations(1);
}

}  // namespace

void AddWakeUp(Suite& suite) {
  const std::uint64_t messages = suite.settings().quick ? 200 : 1000;
  suite.Start({.name = "one-way latency of 128 B, asleep", .quantities = {{"p50", "ns"}, {"p99", "ns"}}});
  suite.Add(Role::kRunnel, "triggered module", [messages](benchmark::State& state) { RunModule(state, messages); })
      ->Iterations(1);
  AddTransport<ConditionValue<Message>>(suite, messages);
  AddTransport<WaitedSeqlock<Message>>(suite, messages);
}

}  // namespace runnel::bench
