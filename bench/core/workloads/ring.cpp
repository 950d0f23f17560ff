// A control loop: five components in a ring, each reads a 4x4 matrix of doubles, adds 1 to every
// element and publishes it. One figure is one cycle of all five.

#include <array>
#include <chrono>
#include <cstring>
#include <memory>
#include <thread>

#include "bench/core/rivals/atomic_shared_pointer.h"
#include "bench/core/rivals/bare_copy.h"
#include "bench/core/rivals/boost_queues.h"
#include "bench/core/rivals/moodycamel_queue.h"
#include "bench/core/rivals/mutex_shared_pointer.h"
#include "bench/core/rivals/mutex_value.h"
#include "bench/core/rivals/seqlock.h"
#include "bench/core/rivals/triple_buffer.h"
#include "bench/core/support/payloads.h"
#include "bench/core/support/star.h"
#include "bench/core/workloads/workloads.h"
#include "core/module/module.h"
#include "plugins/scheduling/scheduler.h"
#include "plugins/timing/tick_clock.h"

namespace runnel::bench {

namespace {

constexpr std::size_t kStages = 5;

// In place, too. By pairs, as the compiler makes of it what it likes else, now this and now that.
void AddOne(const Matrix4& from, Matrix4& to) {
  using Pair [[gnu::vector_size(16)]] = double;
  for (std::size_t i = 0; i < from.elements.size(); i += 2) {
    Pair pair;
    std::memcpy(&pair, &from.elements[i], sizeof(pair));
    pair += 1;
    std::memcpy(&to.elements[i], &pair, sizeof(pair));
  }
}

class Stage final : public Module {
 public:
  using Module::Module;
  Input<Matrix4> in{this, "in"};
  Output<Matrix4> out{this, "out"};
  [[gnu::always_inline]] void Step() {
    auto loan = out.Loan();
    const auto read = in.Read();
    AddOne(read ? *read : kNothing, *loan);
    out.Publish(std::move(loan));
  }

 private:
  static constexpr Matrix4 kNothing{};

  void Update() override { Step(); }
};

struct Ring {
  Ring() {
    for (std::size_t i = 0; i < kStages; ++i) {
      stages[i] = &runtime.Create<Stage>(runtime.root(), "stage" + std::to_string(i));
    }
    for (std::size_t i = 0; i < kStages; ++i) {
      MustSucceed(Port::Connect(stages[i]->out, stages[(i + 1) % kStages]->in));
    }
    MustSucceed(runtime.MakeReady(runtime.root()));
  }

  Runtime runtime;
  std::array<Stage*, kStages> stages{};
};

void RunRawPorts(benchmark::State& state) {
  Ring ring;
  for (auto _ : state) {
    const InACycle cycle;
#pragma GCC unroll 5  // as for the rivals below
    for (Stage* stage : ring.stages) stage->Step();
  }
}

void RunSimulated(benchmark::State& state) {
  Ring ring;
  Scheduler scheduler(ring.runtime, {.clock = SchedulerOptions::ClockKind::kSimulated});
  CreateThread(ring.runtime, "main");
  for (auto _ : state) scheduler.Step();
}

// The cycles that the thread has counted, over a window of time.
void RunThread(benchmark::State& state, std::chrono::milliseconds window) {
  using Clock = std::chrono::steady_clock;
  Ring ring;
  Scheduler scheduler(ring.runtime);
  auto& thread = CreateThread(ring.runtime, "free", {.activation = ThreadOptions::Activation::kFreeRunning});
  MustSucceed(scheduler.Start());
  std::this_thread::sleep_for(std::chrono::milliseconds(5));
  for (auto _ : state) {
    const auto start = Clock::now();
    const std::uint64_t before = thread.statistics().cycles;
    std::this_thread::sleep_for(window);
    const std::uint64_t cycles = thread.statistics().cycles - before;
    const std::chrono::duration<double> taken = Clock::now() - start;
    state.SetIterationTime(taken.count() / static_cast<double>(cycles > 0 ? cycles : 1));
  }
  scheduler.Stop();
}

// What one component does with what is not a port: each rival as it does best, in place if it can.
template <typename Cell>
void Pass(Cell& from, Cell& to) {
  Matrix4 matrix;
  from.Read(matrix);
  AddOne(matrix, matrix);
  to.Write(matrix);
}
void Pass(TripleBuffer<Matrix4>& from, TripleBuffer<Matrix4>& to) {
  AddOne(from.Front(), to.back());
  to.Publish();
}
template <typename PointerCell>
void PassPointer(PointerCell& from, PointerCell& to) {
  const auto lease = from.Lease();
  auto next = std::make_shared<Matrix4>();
  AddOne(*lease, *next);
  to.Write(std::move(next));
}
void Pass(MutexSharedPointer<Matrix4>& from, MutexSharedPointer<Matrix4>& to) { PassPointer(from, to); }
void Pass(AtomicSharedPointer<Matrix4>& from, AtomicSharedPointer<Matrix4>& to) { PassPointer(from, to); }

template <template <typename> class Cell>
void RunCells(benchmark::State& state) {
  auto cells = std::make_unique<std::array<Cell<Matrix4>, kStages>>();
  (*cells)[0].Write(Matrix4{});
  for (auto _ : state) {
#pragma GCC unroll 5  // else what the modulo costs is a good part of what the best rivals cost
    for (std::size_t i = 0; i < kStages; ++i) {
      Pass((*cells)[i], (*cells)[(i + 1) % kStages]);
      benchmark::ClobberMemory();
    }
  }
}

// The least that interchangeable modules with the time of their cycle can cost: objects that know each
// other by a pointer, one virtual call each, and one look at the scheduler's clock for all.
class BareModule {
 public:
  virtual ~BareModule() = default;
  virtual void Update() = 0;
};
class BareStage final : public BareModule {
 public:
  void Update() override { AddOne(*source, value); }
  const Matrix4* source = nullptr;
  Matrix4 value{};
};

void RunBareModules(benchmark::State& state) {
  std::array<std::unique_ptr<BareModule>, kStages> modules;
  std::array<BareStage*, kStages> stages{};
  for (std::size_t i = 0; i < kStages; ++i) {
    auto stage = std::make_unique<BareStage>();
    stages[i] = stage.get();
    modules[i] = std::move(stage);
  }
  for (std::size_t i = 0; i < kStages; ++i) stages[(i + 1) % kStages]->source = &stages[i]->value;
  TickClock clock;
  for (auto _ : state) {
    auto now = clock.Now();
    benchmark::DoNotOptimize(now);
    for (const auto& module : modules) {
      module->Update();
      benchmark::ClobberMemory();
    }
  }
}

template <typename T>
using SpscCell = BoostSpscQueue<T, 4>;
#ifdef RUNNEL_BENCH_HAS_MOODYCAMEL
template <typename T>
using MoodycamelCell = MoodycamelQueue<T, 32>;
#endif

template <template <typename> class Cell>
void AddCells(Suite& suite, Role role = Role::kRival) {
  suite.Add(role, Cell<Matrix4>::kName, RunCells<Cell>);
}

}  // namespace

void AddRing(Suite& suite) {
  suite.Start({"ring of 5, 4x4 double"});
  const std::chrono::milliseconds window(suite.settings().quick ? 20 : 100);
  suite.AddTimed(Role::kRunnel, "modules, thread", [window](benchmark::State& state) { RunThread(state, window); });
  suite.Add(Role::kRunnel, "modules, simulated time", RunSimulated);
  suite.Add(Role::kRunnel, "raw ports", RunRawPorts);
  AddCells<MutexValue>(suite);
  AddCells<MutexSharedPointer>(suite);
  AddCells<AtomicSharedPointer>(suite);
  AddCells<Seqlock>(suite);
  AddCells<TripleBuffer>(suite);
  AddCells<SpscCell>(suite);
#ifdef RUNNEL_BENCH_HAS_MOODYCAMEL
  AddCells<MoodycamelCell>(suite);
#endif
  AddCells<BareCopy>(suite, Role::kFloor);
  suite.Add(Role::kFloor, "virtual calls and a clock (one thread only)", RunBareModules);
}

}  // namespace runnel::bench
