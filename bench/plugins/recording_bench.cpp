// What a publisher pays for being recorded: publishing a number and a scan of 181 ranges alone, with a
// recorder of another port, and recorded. A hundred at once, then a pause in which the recorder catches up;
// what it drops all the same is shown, as a part of all.
#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <benchmark/benchmark.h>

#include "core/element/runtime.h"
#include "core/lockfree/thread_epoch.h"
#include "core/port/cycle.h"
#include "core/port/output.h"
#include "modules/types/measurements.h"
#include "plugins/recording/recorder.h"

namespace runnel {
namespace {

class Box final : public FrameworkElement {
 public:
  explicit Box(const Placement& placement) : FrameworkElement(placement) {}
};

std::string File() { return (std::filesystem::temp_directory_path() / "recording_bench.mcap").string(); }

// A hundred publications are timed, as in a cycle; then the recorder has time to catch up.
template <typename T, typename Publish>
void Measure(benchmark::State& state, const Publish& publish) {
  constexpr int kAtOnce = 100;
  Runtime runtime;
  auto& box = runtime.Create<Box>(runtime.root(), "box");
  Output<T> output(box, "out");
  Output<T> other(box, "other");
  std::filesystem::remove(File());
  std::unique_ptr<Recorder> recorder;
  if (state.range(0) != 0) {
    auto started =
        Recorder::Start(runtime, nullptr, {.file = File(), .ports = {state.range(0) == 1 ? "other" : "out"}});
    if (!started) return state.SkipWithError(started.error().ToString().c_str());
    recorder = std::move(*started);
  }
  std::uint64_t count = 0;
  for (auto each : state) {
    const auto begin = std::chrono::steady_clock::now();
    {
      const EpochGuard guard;
      const CycleScope cycle({Time(Duration(static_cast<std::int64_t>(++count)))});
      for (int i = 0; i < kAtOnce; ++i) publish(output);
    }
    const auto end = std::chrono::steady_clock::now();
    state.SetIterationTime(std::chrono::duration<double>(end - begin).count() / kAtOnce);
    std::this_thread::sleep_for(std::chrono::milliseconds(6));
  }
  if (recorder) {
    const RecordingStatus status = recorder->status();
    state.counters["dropped"] = static_cast<double>(status.dropped) / static_cast<double>(count) / kAtOnce;
  }
  recorder.reset();
  std::filesystem::remove(File());
}

void PublishNumber(benchmark::State& state) {
  double number = 0;
  Measure<double>(state, [&](Output<double>& output) { output.Publish(number += 0.1); });
}
void PublishScan(benchmark::State& state) {
  Measure<RangeScan>(state, [](Output<RangeScan>& output) {
    auto loan = output.Loan();
    loan->ranges.resize(181, 2.5f);
    output.Publish(std::move(loan));
  });
}
// 0: nobody records; 1: another port is recorded; 2: this one.
BENCHMARK(PublishNumber)->DenseRange(0, 2)->UseManualTime()->Iterations(1000);
BENCHMARK(PublishScan)->DenseRange(0, 2)->UseManualTime()->Iterations(1000);

}  // namespace
}  // namespace runnel
