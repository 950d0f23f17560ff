// What the cycle executors add to what the modules of a cycle do: five modules that do nothing, and
// five in a ring that each read and publish a 4x4 matrix, run by hand, freely in a real thread, and
// on the simulated clock. Each figure is beside one uncontended atomic fetch_add, `f`, and the time
// is the processor's, so that what else runs on the machine takes as little part as can be.

#include <array>
#include <atomic>
#include <chrono>
#include <ctime>
#include <string>
#include <thread>

#include <benchmark/benchmark.h>

#include "core/lockfree/thread_epoch.h"
#include "core/module/module.h"
#include "core/port/cycle.h"
#include "core/port/input.h"
#include "core/port/output.h"
#include "plugins/scheduling/scheduler.h"
#include "plugins/timing/trace_track.h"

namespace runnel {

struct Matrix4 {
  double elements[16];
};
inline void Describe(TypeBuilder<Matrix4>& type) { type.Name("bench/Matrix4"); }

namespace {

using namespace std::chrono_literals;

constexpr int kModules = 5;

class Idle final : public Module {
 public:
  using Module::Module;
  void Run() { Update(); }

 private:
  void Update() override { ++runs_; }
  std::uint64_t runs_ = 0;
};

class Stage final : public Module {
 public:
  using Module::Module;
  Input<Matrix4> in{this, "in"};
  Output<Matrix4> out{this, "out"};
  void Run() { Update(); }

 private:
  void Update() override {
    const auto read = in.Read();
    Matrix4 matrix = read ? *read : Matrix4{};
    matrix.elements[0] += 1;
    out.Publish(matrix);
  }
};

void Connect(std::array<Idle*, kModules>&) {}
void Connect(std::array<Stage*, kModules>& ring) {
  for (int i = 0; i < kModules; ++i) {
    (void)Port::Connect(ring[i]->out, ring[(i + 1) % kModules]->in);
  }
}

template <typename T>
struct Application {
  explicit Application(SchedulerOptions::ClockKind clock, CycleTracer* tracer = nullptr)
      : scheduler(runtime, {.clock = clock, .tracer = tracer}) {
    for (int i = 0; i < kModules; ++i) {
      modules[i] = &runtime.Create<T>(runtime.root(), "module" + std::to_string(i));
    }
    Connect(modules);
    (void)runtime.MakeReady(runtime.root());
  }

  Runtime runtime;
  std::array<T*, kModules> modules{};
  ThreadContainer& thread =
      CreateThread(runtime, "main", {.activation = ThreadOptions::Activation::kFreeRunning, .period = 1ms});
  Scheduler scheduler;
};

void FetchAdd(benchmark::State& state) {
  std::atomic<int> number{0};
  for (auto _ : state) benchmark::DoNotOptimize(number.fetch_add(1));
}
BENCHMARK(FetchAdd)->Name("f");

template <typename T>
void ByHand(benchmark::State& state) {
  Application<T> application(SchedulerOptions::ClockKind::kSimulated);
  for (auto _ : state) {
    const EpochGuard guard;
    const CycleScope scope({Time(1ms), 1ms});
    for (T* module : application.modules) {
      benchmark::DoNotOptimize(module);
      module->Run();
    }
  }
}

template <typename T>
void SimulatedSteps(benchmark::State& state) {
  Application<T> application(SchedulerOptions::ClockKind::kSimulated);
  for (auto _ : state) application.scheduler.Step();
}

template <typename T>
void SimulatedRun(benchmark::State& state) {
  Application<T> application(SchedulerOptions::ClockKind::kSimulated);
  constexpr int kCycles = 1000;
  Time end{};
  while (state.KeepRunningBatch(kCycles)) {
    end += kCycles * 1ms;
    application.scheduler.RunUntil(end);
  }
}

// Notes what cycles do, and lets it go at once.
class Discarding final : public CycleTracer {
 public:
  TraceTrack& TrackOf(std::uint64_t, const std::string&) override { return track_; }
  std::unique_ptr<TracedElement> Watch(FrameworkElement& element) override {
    auto traced = std::make_unique<TracedElement>();
    if (auto* const stage = dynamic_cast<Stage*>(&element)) traced->ports = {{&stage->out, 1, 0}};
    return traced;
  }
  std::uint64_t NumberOf(const std::string&) override { return 1; }
  void OnHold(const std::string&, Time, Time) noexcept override {}
  void Empty() {
    track_.events().consume_all([](const TraceEvent&) {});
  }

 private:
  TraceTrack track_{65'536};
};

template <typename T>
void TracedRun(benchmark::State& state) {
  Discarding tracer;
  Application<T> application(SchedulerOptions::ClockKind::kSimulated, &tracer);
  constexpr int kCycles = 1000;
  Time end{};
  while (state.KeepRunningBatch(kCycles)) {
    end += kCycles * 1ms;
    application.scheduler.RunUntil(end);
    tracer.Empty();
  }
}

double ProcessorTime() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// The thread that measures sleeps, so that the process's time is that of the thread that runs.
template <typename T>
void FreeRunning(benchmark::State& state) {
  Application<T> application(SchedulerOptions::ClockKind::kReal);
  (void)application.scheduler.Start();
  std::this_thread::sleep_for(20ms);
  for (auto _ : state) {
    const auto cycles = application.thread.statistics().cycles;
    const double began = ProcessorTime();
    std::this_thread::sleep_for(20ms);
    const double ended = ProcessorTime();
    const auto done = static_cast<double>(application.thread.statistics().cycles - cycles);
    state.SetIterationTime((ended - began) / done);
  }
  application.scheduler.Stop();
}

BENCHMARK(ByHand<Idle>)->Name("idle/by_hand");
BENCHMARK(FreeRunning<Idle>)->Name("idle/free_running")->UseManualTime()->Iterations(10);
BENCHMARK(SimulatedSteps<Idle>)->Name("idle/simulated_steps");
BENCHMARK(SimulatedRun<Idle>)->Name("idle/simulated_run");
BENCHMARK(TracedRun<Idle>)->Name("idle/simulated_run_traced");
BENCHMARK(ByHand<Stage>)->Name("ring/by_hand");
BENCHMARK(FreeRunning<Stage>)->Name("ring/free_running")->UseManualTime()->Iterations(10);
BENCHMARK(SimulatedSteps<Stage>)->Name("ring/simulated_steps");
BENCHMARK(SimulatedRun<Stage>)->Name("ring/simulated_run");
BENCHMARK(TracedRun<Stage>)->Name("ring/simulated_run_traced");

}  // namespace
}  // namespace runnel
