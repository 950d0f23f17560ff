// What the structure of an application costs, against the size of the application: loading it from
// XML, and single changes while its threads publish at full speed. Prints one table.
//
// An application of n modules has n / 100 groups and 2 n connections: rings of ten modules, and a
// connection to each from some module before its ring. Every tenth of the first 1000 modules is run by a
// thread that runs as fast as it can, so at most 100 modules publish at full speed meanwhile; the others
// run every 20 ms.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/element/runtime.h"
#include "core/module/group.h"
#include "core/module/module.h"
#include "core/port/input.h"
#include "core/port/output.h"
#include "plugins/application_files/application_builder.h"
#include "plugins/application_tags/application_tags.h"
#include "plugins/application_tags/run_description.h"
#include "plugins/scheduling/scheduler.h"

namespace runnel {
namespace {

using Milliseconds = std::chrono::duration<double, std::milli>;
using Microseconds = std::chrono::duration<double, std::micro>;

class Stage final : public Module {
 public:
  using Module::Module;
  Input<double> near{this, "near"};
  Input<double> far{this, "far"};
  Output<double> out{this, "out"};

 private:
  void Update() override { out.Publish(near.Get() + far.Get()); }
};

constexpr int kGroupSize = 100;

std::string NameOf(int module) {
  return "group" + std::to_string(module / kGroupSize) + "/stage" + std::to_string(module);
}

std::string ApplicationText(int modules) {
  std::string text =
      "<application name=\"large\">\n"
      "  <thread name=\"slow\" period=\"20ms\"/>\n"
      "  <thread name=\"fast\" activation=\"free_running\"/>\n";
  for (int first = 0; first < modules; first += kGroupSize) {
    text += "  <group name=\"group" + std::to_string(first / kGroupSize) + "\" thread=\"slow\">\n";
    for (int i = first; i < std::min(first + kGroupSize, modules); ++i) {
      const bool is_fast = i % 10 == 0 && i < 1000;
      text += "    <module name=\"stage" + std::to_string(i) + "\" type=\"bench/stage\"" +
              (is_fast ? " thread=\"fast\"/>\n" : "/>\n");
    }
    text += "  </group>\n";
  }
  const auto connect = [&](int from, int to, const char* input) {
    text += "  <connect from=\"" + NameOf(from) + "/out\" to=\"" + NameOf(to) + "/" + input + "\"/>\n";
  };
  for (int i = 0; i < modules; ++i) {
    // Rings of ten, each with a feedback that is cut, and a tie to some module that came before.
    connect(i % 10 == 0 ? std::min(i + 9, modules - 1) : i - 1, i, "near");
    connect(i < 10 ? 0 : static_cast<int>(7919LL * i % (i - i % 10)), i, "far");
  }
  return text + "</application>\n";
}

template <typename Unit, typename Do>
double Time(const Do& what) {
  const auto began = std::chrono::steady_clock::now();
  what();
  return Unit(std::chrono::steady_clock::now() - began).count();
}

[[noreturn]] void Fail(const std::string& why) {
  std::fprintf(stderr, "bench_structure: %s\n", why.c_str());
  std::exit(1);
}
void Must(const Result<void>& result) {
  if (!result) Fail(result.error().ToString());
}

struct Spread {
  double median = 0;
  double p99 = 0;
};

Spread SpreadOf(std::vector<double> values) {
  std::ranges::sort(values);
  return {values[values.size() / 2], values[values.size() * 99 / 100]};
}

struct Figures {
  double parse = 0;
  double build = 0;
  double start = 0;
  double processor = 0;  ///< of all three, which others on the machine do not lengthen
  std::vector<std::pair<std::string, Spread>> changes;
};

class Subject {
 public:
  explicit Subject(int modules) : modules_(modules) {
    (void)plugins_.modules().Add(
        {"bench/stage", "", "bench", [](const Placement& placement) -> std::unique_ptr<FrameworkElement> {
           return std::make_unique<Stage>(placement);
         }});
  }

  Figures Measure() {
    Load();
    MeasureChanges();
    scheduler_->Stop();
    return std::move(figures_);
  }

 private:
  void Load() {
    const std::string text = ApplicationText(modules_);
    const std::clock_t began = std::clock();
    std::unique_ptr<XmlDocument> document;
    figures_.parse = Time<Milliseconds>([&] {
      auto parsed = XmlDocument::Parse(text, "large.xml");
      if (!parsed) Fail(parsed.error().ToString());
      document = std::make_unique<XmlDocument>(std::move(*parsed));
    });
    figures_.build = Time<Milliseconds>([&] {
      const BuildOutcome outcome =
          BuildApplication(*document, "/", {runtime_, plugins_, tags_, configuration_}, BuildMode::kRun);
      if (outcome.application == nullptr) Fail(outcome.diagnostics.ToString());
      application_ = outcome.application;
    });
    figures_.start = Time<Milliseconds>([&] {
      scheduler_ = std::make_unique<Scheduler>(runtime_);
      Must(scheduler_->Start());
    });
    figures_.processor = 1e3 * static_cast<double>(std::clock() - began) / CLOCKS_PER_SEC;
  }

  Stage& At(int module) { return dynamic_cast<Stage&>(**application_->Find(NameOf(module % modules_))); }
  ThreadContainer& Thread(const char* name) {
    return dynamic_cast<ThreadContainer&>(**application_->Find(std::string("threads/") + name));
  }

  void MeasureEach(const std::string& what, const std::function<void(int round)>& change) {
    std::vector<double> times;
    for (int round = 0; round < kRounds; ++round) {
      times.push_back(Time<Microseconds>([&] { change(round); }));
    }
    figures_.changes.emplace_back(what, SpreadOf(std::move(times)));
  }

  void MeasureChanges() {
    MeasureEach("disconnect and connect again, as before", [&](int round) {
      Stage& to = At(17 * round);
      Port& from = *to.far.incoming().front();
      Must(Port::Disconnect(from, to.far));
      Must(Port::Connect(from, to.far));
    });
    auto& sink = runtime_.Create<Stage>(*application_, "sink");
    AssignThread(sink, Thread("slow"));
    Must(runtime_.MakeReady(sink));
    MeasureEach("connect and disconnect, to a module at the end", [&](int round) {
      Stage& from = At(17 * round);
      Must(Port::Connect(from.out, sink.near));
      Must(Port::Disconnect(from.out, sink.near));
    });
    MeasureEach("create, connect both ways, make ready", [&](int round) {
      auto& added = runtime_.Create<Stage>(*At(31 * round).parent(), "added" + std::to_string(round));
      Must(Port::Connect(At(31 * round).out, added.near));
      Must(Port::Connect(added.out, sink.far));
      Must(runtime_.MakeReady(added));
    });
    MeasureEach("delete it (waits for the end of the cycles)", [&](int round) {
      const auto found = At(31 * round).parent()->Find("added" + std::to_string(round));
      Must(runtime_.Delete(**found));
    });
    MeasureEach("assign to the other thread",
                [&](int round) { AssignThread(sink, Thread(round % 2 == 0 ? "fast" : "slow")); });
    MeasureEach("100 connections in one change scope", [&](int round) {
      const ChangeScope changes(runtime_);
      for (int i = 0; i < kGroupSize; ++i) {
        Port& from = At(round + 37 * i).out;
        if (round % 2 == 0) Must(Port::Connect(from, sink.far));
        if (round % 2 != 0) Must(Port::Disconnect(At(round - 1 + 37 * i).out, sink.far));
      }
    });
  }

  static constexpr int kRounds = 200;

  const int modules_;
  Runtime runtime_;
  PluginManager plugins_;
  XmlTagRegistry tags_ = ApplicationTags();
  Configuration configuration_;
  FrameworkElement* application_ = nullptr;
  std::unique_ptr<Scheduler> scheduler_;
  Figures figures_;
};

// An output with many inputs is no application, but connecting all of them shows what one costs.
double ConnectFan(int inputs, std::size_t queue) {
  Runtime runtime;
  auto& source = runtime.Create<Stage>(runtime.root(), "source");
  std::vector<Stage*> sinks;
  for (int i = 0; i < inputs; ++i) {
    sinks.push_back(&runtime.Create<Stage>(runtime.root(), "sink" + std::to_string(i)));
  }
  return Time<Microseconds>([&] {
           for (Stage* sink : sinks) Must(Port::Connect(source.out, sink->near, {.queue = queue}));
         }) /
         inputs;
}

void PrintTable() {
  const std::vector<int> sizes{100, 1000, 10000};
  std::vector<Figures> figures;
  for (const int size : sizes) {
    figures.push_back(Subject(size).Measure());
    std::fprintf(stderr, "measured %d modules\n", size);
  }
  std::printf("%-48s", "modules");
  for (const int size : sizes) std::printf("%20d", size);
  std::printf("\n\nloading, ms\n");
  const auto line = [&](const char* what, auto&& figure) {
    std::printf("  %-46s", what);
    for (const Figures& each : figures) std::printf("%20.1f", figure(each));
    std::printf("\n");
  };
  line("read the file", [](const Figures& each) { return each.parse; });
  line("build, connect, make ready", [](const Figures& each) { return each.build; });
  line("compile the schedules, start", [](const Figures& each) { return each.start; });
  line("together", [](const Figures& each) { return each.parse + each.build + each.start; });
  line("together, time of the processor", [](const Figures& each) { return each.processor; });
  std::printf("\none change while the threads run, us: median (99 %%)\n");
  for (std::size_t i = 0; i < figures.front().changes.size(); ++i) {
    std::printf("  %-46s", figures.front().changes[i].first.c_str());
    for (const Figures& each : figures) {
      const Spread& spread = each.changes[i].second;
      std::printf("%10.1f (%7.1f)", spread.median, spread.p99);
    }
    std::printf("\n");
  }
  std::printf("\nconnecting n inputs to one output, us each\n");
  for (const std::size_t queue : {0, 4}) {
    std::printf("  %-46s", queue == 0 ? "newest value" : "with queues");
    for (const int size : sizes) std::printf("%20.2f", ConnectFan(size, queue));
    std::printf("\n");
  }
}

}  // namespace
}  // namespace runnel

int main() { runnel::PrintTable(); }
