// What exchanging a module costs while it runs: how long its thread stands still, how long the whole
// change takes, and what the gaps in its outputs are, beside the same application left alone. Prints one
// table.
//
// The application: a module that publishes in each cycle of a periodic thread, replaced by one of the same
// type again and again, its port connected to ten inputs of another thread, one of them with a queue.

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

#include "core/element/runtime.h"
#include "core/module/group.h"
#include "core/module/module.h"
#include "core/plugin/module_registry.h"
#include "core/port/input.h"
#include "core/port/output.h"
#include "plugins/structure/structure_editor.h"

namespace runnel {
namespace {

using namespace std::chrono_literals;
using Microseconds = std::chrono::duration<double, std::micro>;

struct Progress {
  int count = 0;
};

// Whatever instance is running: when the cycles were, in the machine's time.
struct Beats {
  std::vector<std::chrono::steady_clock::time_point> at;
  std::atomic<std::size_t> count{0};
  void Note() {
    const std::size_t next = count.load(std::memory_order_relaxed);
    if (next == at.size()) return;
    at[next] = std::chrono::steady_clock::now();
    count.store(next + 1, std::memory_order_release);
  }
};
Beats beats;

class Worker final : public Module {
 public:
  explicit Worker(const Placement& placement) : Module(placement) { KeepState(progress_); }
  Output<std::vector<double>> out{this, "out"};

 private:
  void Update() override {
    beats.Note();
    auto loan = out.Loan();
    loan->assign(16, ++progress_.count);
    out.Publish(std::move(loan));
  }
  Progress progress_;
};

class Listener final : public Module {
 public:
  using Module::Module;
  Input<std::vector<double>> in{this, "in"};
  std::atomic<int> last{0};
  std::atomic<int> missing{0};

 private:
  void Update() override {
    in.Drain([this](const auto& value) {
      const int now = static_cast<int>(value->front());
      if (now != last.load(std::memory_order_relaxed) + 1) ++missing;
      last.store(now, std::memory_order_relaxed);
    });
  }
};

[[noreturn]] void Fail(const std::string& why) {
  std::fprintf(stderr, "bench_handover: %s\n", why.c_str());
  std::exit(1);
}

struct Spread {
  double median = 0;
  double p99 = 0;
  double most = 0;
};

Spread SpreadOf(std::vector<double> values) {
  if (values.empty()) return {};
  std::ranges::sort(values);
  return {values[values.size() / 2], values[values.size() * 99 / 100], values.back()};
}

template <typename M>
void Register(ModuleRegistry& modules, const char* name) {
  (void)modules.Add({name, "", "bench", [](const Placement& placement) {
                       return std::unique_ptr<FrameworkElement>(std::make_unique<M>(placement));
                     }});
}

struct Figures {
  int swaps = 0;
  double seconds = 0;
  Spread still;
  Spread whole;
  Spread gap;
  int missing = 0;
};

Figures Measure(Duration period, int swaps, Duration pause, Duration alone) {
  Runtime runtime;
  ModuleRegistry modules;
  Register<Worker>(modules, "bench/worker");
  Register<Listener>(modules, "bench/listener");
  runtime.Create<Group>(runtime.root(), "app");
  (void)runtime.MakeReady(runtime.root());
  CreateThread(runtime, "worker", {.period = period});
  CreateThread(runtime, "listeners", {.period = 2ms});
  Scheduler scheduler(runtime);
  StructureEditor editor(runtime, modules, &scheduler);
  const auto must = [&](const ChangeSet& changes) {
    const ChangeOutcome outcome = editor.Apply(changes);
    if (!outcome) Fail(outcome.diagnostics.ToString());
    return outcome;
  };
  ChangeSet build{CreateModule{"/app/worker", "bench/worker"}, AssignToThread{"/app/worker", "worker"}};
  for (int i = 0; i < 10; ++i) {
    const std::string name = "/app/listener" + std::to_string(i);
    build.push_back(CreateModule{name, "bench/listener"});
    build.push_back(AssignToThread{name, "listeners"});
    build.push_back(ConnectPorts{"/app/worker/out", name + "/in", {.queue = i == 0 ? 10000u : 0u}});
  }
  must(build);
  beats.at.assign(1'000'000, {});
  beats.count = 0;
  if (!scheduler.Start()) Fail("the scheduler does not start");
  Figures figures;
  std::vector<double> still;
  std::vector<double> whole;
  const auto began = std::chrono::steady_clock::now();
  if (swaps == 0) std::this_thread::sleep_for(alone);
  for (int i = 0; i < swaps; ++i) {
    const auto before = std::chrono::steady_clock::now();
    const auto outcome = must({ReplaceModule{"/app/worker", "bench/worker", {}, 1}});
    whole.push_back(Microseconds(std::chrono::steady_clock::now() - before).count());
    still.push_back(Microseconds(outcome.hold_time).count());
    if (pause > Duration::zero()) std::this_thread::sleep_for(pause);
  }
  figures.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  std::this_thread::sleep_for(20ms);
  scheduler.Stop();
  std::vector<double> gaps;
  for (std::size_t i = 1; i < beats.count; ++i) {
    gaps.push_back(Microseconds(beats.at[i] - beats.at[i - 1]).count());
  }
  figures.swaps = swaps;
  figures.still = SpreadOf(still);
  figures.whole = SpreadOf(whole);
  figures.gap = SpreadOf(gaps);
  figures.missing = dynamic_cast<Listener&>(**runtime.root().Find("/app/listener0")).missing;
  return figures;
}

void Print(const char* what, Duration period, const Figures& figures) {
  std::printf("%-26s %8.1f %9.0f  %7.1f %7.1f %8.1f  %7.1f %7.1f %8.1f  %8.1f %8.1f %8.1f %5d\n", what,
              Microseconds(period).count(), figures.swaps / figures.seconds, figures.still.median, figures.still.p99,
              figures.still.most, figures.whole.median, figures.whole.p99, figures.whole.most, figures.gap.median,
              figures.gap.p99, figures.gap.most, figures.missing);
}

}  // namespace
}  // namespace runnel

int main() {
  using namespace runnel;
  using namespace std::chrono_literals;
  std::printf(
      "Times in us. A thread stands still while a module of it is exchanged; a gap is the time "
      "from "
      "one cycle\nto the next; lost: values that did not come out of the queue in order.\n\n");
  std::printf("%-26s %8s %9s  %24s  %24s  %26s %5s\n", "", "period", "swaps/s", "stands still", "whole change", "gap",
              "lost");
  std::printf("%-26s %8s %9s  %7s %7s %8s  %7s %7s %8s  %8s %8s %8s\n", "", "", "", "median", "p99", "max", "median",
              "p99", "max", "median", "p99", "max");
  for (const Duration period : {Duration(10ms), Duration(1ms), Duration(100us)}) {
    Print("left alone", period, Measure(period, 0, 0ms, 1s));
    Print("every 5 ms", period, Measure(period, 200, 5ms, 0s));
    Print("as fast as it can", period, Measure(period, 3000, 0ms, 0s));
  }
  return 0;
}
