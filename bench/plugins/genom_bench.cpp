// The same codel, in C, called by hand; as a periodic task of the engine that runs components of GenoM3; as a module, beside
// an ordinary module that does the same; and as a process without Runnel.

#include <benchmark/benchmark.h>
#include <pulse_module.cpp>  // made from pulse.gen

#include "bench/plugins/genom/standalone_client.h"
#include "core/element/runtime.h"
#include "core/module/executable.h"
#include "core/port/cycle.h"

namespace runnel {
namespace {

constexpr Duration kPeriod = std::chrono::milliseconds(1);

class Smoother final : public Module {
 public:
  using Module::Module;
  Input<double> wanted{this, "wanted"};
  Output<double> smooth{this, "smooth"};

 private:
  void Update() override {
    if (const auto now = wanted.Read()) level_ += 0.1 * (*now - level_);
    smooth.Publish(level_);
  }
  double level_ = 0;
};

// Ports without a middleware.
struct Numbers {
  double wanted = 1;
  double smooth = 0;
};
Numbers& Of(genom_context self) { return *static_cast<Numbers*>(self->data); }
const pulse_wanted kWanted = {[](genom_context self) -> const double* { return &Of(self).wanted; },
                              [](genom_context) -> genom_event { return genom_ok; }};
const pulse_smooth kSmooth = {[](genom_context self) -> double* { return &Of(self).smooth; },
                              [](genom_context) -> genom_event { return genom_ok; }};
pulse_ids ids{0, 0.1};

void CodelByHand(benchmark::State& state) {
  Numbers numbers;
  const genom_context_iface context{&numbers, nullptr, nullptr};
  double level = 0;
  for (auto _ : state) benchmark::DoNotOptimize(pulse_step(&kWanted, 0.1, &level, &kSmooth, &context));
}

// A component with one task whose codel is the same; with and without one of another task that it excludes.
void TaskOfTheEngine(benchmark::State& state) {
  using namespace genom_execution;
  const bool excludes = state.range(0) != 0;
  static const CodelTable kCodels[] = {{"step",
                                        [](const Invocation& call) -> genom_event {
                                          auto& of = *static_cast<pulse_ids*>(call.ids);
                                          return pulse_step(&kWanted, of.gain, &of.level, &kSmooth,
                                                            reinterpret_cast<genom_context>(call.context));
                                        }},
                                       {"other", [](const Invocation&) -> genom_event { return pulse_ether; }}};
  static const Transition kTransitions[] = {{pulse_pause_start, 0, true}};
  static const StateTable kStates[] = {{"start", 0, kTransitions}};
  static const TaskTable kTasks[] = {{.name = "beat", .period = kPeriod, .machine = {kStates, 0, kNowhere}}};
  static const Conflict kConflicts[] = {{0, 1}};
  ComponentTable component{.name = "pulse", .codels = kCodels, .tasks = kTasks};
  if (excludes) component.conflicts = kConflicts;
  Numbers numbers;
  Engine engine(component, {.ids = &ids, .glue = &numbers});
  Time now{};
  for (auto _ : state) {
    now += kPeriod;
    benchmark::DoNotOptimize(engine.RunControl());
    benchmark::DoNotOptimize(engine.RunTask(0, now));
  }
}

template <typename M>
void CyclesOf(benchmark::State& state) {
  Runtime runtime;
  M& module = runtime.Create<M>(runtime.root(), "module");
  Output<double> source(runtime.root(), "source");
  Port& wanted = dynamic_cast<Port&>(*module.FindChild("input")->FindChild("wanted"));
  if (!Port::Connect(source, wanted)) state.SkipWithError("cannot be connected");
  if (!runtime.MakeReady(module)) state.SkipWithError("cannot be prepared");
  const std::vector<Task> tasks = module.template FindAnnotation<Executable>()->tasks();
  Time now{};
  for (auto _ : state) {
    now += kPeriod;
    const CycleScope cycle({now, kPeriod});
    source.Publish(1.0);
    for (const Task& task : tasks) task.run();
  }
}

// As many periods in one request, in the time of the request: the socket counts for nothing.
void PeriodsOfTheProcess(benchmark::State& state) {
  constexpr int kPeriods = 100'000;
  bench::StandaloneClient pulse(RUNNEL_PULSE_STANDALONE);
  pulse.Ask(R"({"put": {"wanted": 1.0}})");
  while (state.KeepRunningBatch(kPeriods)) {
    const std::string heard = pulse.Ask(R"({"step": 100, "every": 0.001})");
    if (!heard.starts_with(R"({"done")")) return state.SkipWithError(heard.c_str());
  }
}

BENCHMARK(CodelByHand);
BENCHMARK(TaskOfTheEngine)->ArgName("excludes")->Arg(0)->Arg(1);
BENCHMARK(CyclesOf<Smoother>);
BENCHMARK(CyclesOf<PulseComponent>);
BENCHMARK(PeriodsOfTheProcess)->UseRealTime();

}  // namespace
}  // namespace runnel
