// What a call costs beside publishing: a number there and a number back, in one thread as in a cycle; the same by
// ports, two publications and two reads; one way; and a virtual call under a mutex, which does nothing else.

#include <functional>
#include <mutex>

#include <benchmark/benchmark.h>

#include "core/element/runtime.h"
#include "core/module/module.h"
#include "core/port/cycle.h"
#include "core/port/input.h"
#include "core/port/output.h"
#include "plugins/services/client.h"
#include "plugins/services/service.h"

namespace runnel {
namespace {

class Server final : public Module {
 public:
  using Module::Module;
  Input<double> question{this, "question"};
  Output<double> answer{this, "answer"};
  Service<double(double)> half{this, "half", [](Server&, double value) { return value / 2; }};

 private:
  void Update() override {}
};
class Asker final : public Module {
 public:
  using Module::Module;
  Output<double> question{this, "question"};
  Input<double> answer{this, "answer"};
  Client<double(double)> half{this, "half", {.timeout = std::chrono::hours(1)}};

 private:
  void Update() override {}
};

struct Pair {
  Pair() {
    (void)Port::Connect(asker.question, server.question);
    (void)Port::Connect(server.answer, asker.answer);
    (void)Port::Connect(server.half.port(), asker.half.port());
  }
  Runtime runtime;
  Server& server = runtime.Create<Server>(runtime.root(), "server");
  Asker& asker = runtime.Create<Asker>(runtime.root(), "asker");
};

void Publish(benchmark::State& state) {
  Pair pair;
  const OwnCycle cycle(pair.runtime.clock().Now());
  for (auto _ : state) pair.asker.question.Publish(1.0);
}
void QuestionAndAnswerByPorts(benchmark::State& state) {
  Pair pair;
  const OwnCycle cycle(pair.runtime.clock().Now());
  double sum = 0;
  for (auto _ : state) {
    pair.asker.question.Publish(1.0);
    pair.server.answer.Publish(pair.server.question.Get() / 2);
    sum += pair.asker.answer.Get();
  }
  benchmark::DoNotOptimize(sum);
}
void CallBack(benchmark::State& state) {
  Pair pair;
  const OwnCycle cycle(pair.runtime.clock().Now());
  double sum = 0;
  for (auto _ : state) {
    (void)pair.asker.half.Call([&sum](const CallOutcome<double>& outcome) { sum += *outcome; }, 1.0);
    pair.server.half.Serve();
    pair.asker.half.Deliver();
  }
  benchmark::DoNotOptimize(sum);
}
void OneWay(benchmark::State& state) {
  Pair pair;
  const OwnCycle cycle(pair.runtime.clock().Now());
  for (auto _ : state) {
    (void)pair.asker.half.Send(1.0);
    pair.server.half.Serve();
  }
}
void NothingToServe(benchmark::State& state) {
  Pair pair;
  const OwnCycle cycle(pair.runtime.clock().Now());
  for (auto _ : state) pair.server.half.Serve();
}
// FINROC's way in process: the function runs in the caller's thread, and guards itself.
void FunctionUnderAMutex(benchmark::State& state) {
  std::mutex mutex;
  std::function<double(double)> half = [](double value) { return value / 2; };
  benchmark::DoNotOptimize(half);
  double sum = 0;
  for (auto _ : state) {
    const std::lock_guard lock(mutex);
    sum += half(1.0);
  }
  benchmark::DoNotOptimize(sum);
}

BENCHMARK(Publish);
BENCHMARK(QuestionAndAnswerByPorts);
BENCHMARK(CallBack);
BENCHMARK(OneWay);
BENCHMARK(NothingToServe);
BENCHMARK(FunctionUnderAMutex);

}  // namespace
}  // namespace runnel
