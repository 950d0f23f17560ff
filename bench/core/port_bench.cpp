// What publishing and reading cost, beside the same done with a mutex and with a shared pointer.

#include <memory>
#include <mutex>
#include <vector>

#include <benchmark/benchmark.h>

#include "core/element/runtime.h"
#include "core/lockfree/thread_epoch.h"
#include "core/module/module.h"
#include "core/port/cycle.h"
#include "core/port/input.h"
#include "core/port/output.h"

namespace runnel {

struct Matrix4 {
  double elements[16];
};
inline void Describe(TypeBuilder<Matrix4>& type) { type.Name("bench/Matrix4"); }

struct Image {
  std::vector<unsigned char> pixels;
};
inline void Describe(TypeBuilder<Image>& type) { type.Name("bench/Image"); }

namespace {

constexpr std::size_t kImageSize = 1920 * 1080 * 3;

template <typename T>
class Source final : public Module {
 public:
  using Module::Module;
  Output<T> out{this, "out"};

 private:
  void Update() override {}
};

template <typename T>
class Sink final : public Module {
 public:
  using Module::Module;
  Input<T> in{this, "in"};

 private:
  void Update() override {}
};

/// What an executor does once for all modules of a cycle.
struct InACycle {
  EpochGuard guard;
  CycleScope scope{Cycle{}};
};

/// One component of the control loop: reads a matrix, adds one, publishes it.
class Stage final : public Module {
 public:
  using Module::Module;
  Input<Matrix4> in{this, "in"};
  Output<Matrix4> out{this, "out"};
  void Step() {
    const auto read = in.Read();
    Matrix4 matrix = read ? *read : Matrix4{};
    matrix.elements[0] += 1;
    out.Publish(matrix);
  }

 private:
  void Update() override { Step(); }
};

/// One output connected to `count` inputs.
template <typename T>
struct Star {
  explicit Star(std::size_t count) : source(&runtime.Create<Source<T>>(runtime.root(), "source")) {
    for (std::size_t i = 0; i < count; ++i) {
      sinks.push_back(&runtime.Create<Sink<T>>(runtime.root(), "sink" + std::to_string(i)));
      if (!Port::Connect(source->out, sinks.back()->in)) throw std::runtime_error("not connected");
    }
  }
  Runtime runtime;
  Source<T>* source;
  std::vector<Sink<T>*> sinks;
};

std::size_t Inputs(const benchmark::State& state) {
  return static_cast<std::size_t>(state.range(0));
}

void PublishDouble(benchmark::State& state) {
  Star<double> star(Inputs(state));
  const InACycle cycle;
  double value = 0;
  for (auto _ : state) star.source->out.Publish(value += 1);
}
BENCHMARK(PublishDouble)->Arg(1)->Arg(7)->Arg(15);

void PublishMatrix(benchmark::State& state) {
  Star<Matrix4> star(Inputs(state));
  const InACycle cycle;
  Matrix4 value{};
  for (auto _ : state) {
    value.elements[0] += 1;
    star.source->out.Publish(value);
  }
}
BENCHMARK(PublishMatrix)->Arg(1)->Arg(7)->Arg(15);

void LoanAndPublishImage(benchmark::State& state) {
  Star<Image> star(Inputs(state));
  const InACycle cycle;
  for (auto _ : state) {
    auto loan = star.source->out.Loan();
    loan->pixels.resize(kImageSize);  // allocates once for each buffer of the pool
    loan->pixels[0] = 1;
    star.source->out.Publish(std::move(loan));
  }
}
BENCHMARK(LoanAndPublishImage)->Arg(1)->Arg(7)->Arg(15);

template <typename T>
void Read(benchmark::State& state) {
  Star<T> star(1);
  const InACycle cycle;
  star.source->out.Publish(T{});
  for (auto _ : state) benchmark::DoNotOptimize(star.sinks[0]->in.Read().has_value());
}
BENCHMARK(Read<double>);
BENCHMARK(Read<Matrix4>);
BENCHMARK(Read<Image>);

void ControlLoopOfFive(benchmark::State& state) {
  Runtime runtime;
  std::vector<Stage*> stages;
  for (int i = 0; i < 5; ++i) {
    stages.push_back(&runtime.Create<Stage>(runtime.root(), "stage" + std::to_string(i)));
  }
  for (std::size_t i = 0; i < 5; ++i) {
    if (!Port::Connect(stages[i]->out, stages[(i + 1) % 5]->in)) {
      throw std::runtime_error("not connected");
    }
  }
  for (auto _ : state) {
    const InACycle cycle;
    for (Stage* stage : stages) stage->Step();
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(ControlLoopOfFive);

// The baselines: the same work without a framework.

void BaselineMutexControlLoopOfFive(benchmark::State& state) {
  struct Slot {
    std::mutex mutex;
    Matrix4 value{};
  };
  std::vector<Slot> slots(5);
  for (auto _ : state) {
    for (std::size_t i = 0; i < 5; ++i) {
      Matrix4 matrix;
      {
        const std::lock_guard lock(slots[i].mutex);
        matrix = slots[i].value;
      }
      matrix.elements[0] += 1;
      const std::lock_guard lock(slots[(i + 1) % 5].mutex);
      slots[(i + 1) % 5].value = matrix;
    }
  }
  state.SetItemsProcessed(state.iterations());
}
BENCHMARK(BaselineMutexControlLoopOfFive);

void BaselineMutexSharedPointerPublish(benchmark::State& state) {
  struct Slot {
    std::mutex mutex;
    std::shared_ptr<double> value;
  };
  std::vector<Slot> slots(Inputs(state));
  for (auto _ : state) {
    auto value = std::make_shared<double>(1);
    for (Slot& slot : slots) {
      const std::lock_guard lock(slot.mutex);
      slot.value = value;
    }
  }
}
BENCHMARK(BaselineMutexSharedPointerPublish)->Arg(1)->Arg(7)->Arg(15);

}  // namespace
}  // namespace runnel
