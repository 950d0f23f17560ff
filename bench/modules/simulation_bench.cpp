// How many times faster than real time a whole application runs: world, laser, adaptor, planner,
// drive and referee in one thread, from the first cycle to the verdict. The baseline is the physics
// alone, in the same world and with the same steps.

#include <stdexcept>

#include <benchmark/benchmark.h>

#include "core/base/error.h"
#include "modules/simulation/algorithm/physics_world.h"
#include "modules/simulation/world_file/world_file.h"
#include "tests/integration/application_run.h"

namespace runnel {
namespace {

constexpr const char* kWorld = "one_obstacle.xml";

void CountTimesRealTime(benchmark::State& state, double simulated_seconds) {
  state.counters["times_real_time"] = benchmark::Counter(simulated_seconds, benchmark::Counter::kIsRate);
}

void RunToVerdict(benchmark::State& state, const char* application) {
  double simulated = 0.0;
  for (auto _ : state) {
    const auto run = test::RunApplication(
        {.name = application, .arguments = {std::string("world=" RUNNEL_XML "/worlds/") + kWorld, "picture="}});
    if (!run.outcome || run.outcome->verdict != "reached") {
      state.SkipWithError("the goal was not reached");
      return;
    }
    simulated += ToSeconds(run.duration);
  }
  CountTimesRealTime(state, simulated);
}
BENCHMARK_CAPTURE(RunToVerdict, laser, "bug_demo.xml")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(RunToVerdict, infrared, "bug_infrared.xml")->Unit(benchmark::kMillisecond);

void BaselinePhysicsAlone(benchmark::State& state) {
  Diagnostics diagnostics;
  const auto world = ReadWorldFile(std::string(RUNNEL_XML "/worlds/") + kWorld, diagnostics);
  if (!world) throw std::runtime_error(diagnostics.ToString());
  PhysicsWorld physics(*world);
  constexpr double kPeriod = 0.05;
  double simulated = 0.0;
  for (auto _ : state) {
    physics.SetWheelSpeeds({4, 5});  // in circles
    physics.Advance(kPeriod);
    simulated += kPeriod;
  }
  CountTimesRealTime(state, simulated);
}
BENCHMARK(BaselinePhysicsAlone);

}  // namespace
}  // namespace runnel
