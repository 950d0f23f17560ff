// bin/runnel_bench: measures Runnel's ports beside their rivals, and says who wins.

#include <fstream>
#include <iostream>
#include <optional>
#include <stdexcept>

#include <CLI/CLI.hpp>

#include "bench/core/suite.h"
#include "bench/core/workloads/image_transport.h"
#include "bench/core/workloads/workloads.h"
#include "bench/report/charts.h"
#include "bench/report/comparison.h"
#include "bench/report/json_report.h"
#include "bench/report/peers.h"
#include "bench/report/quietness.h"
#include "bench/report/table.h"
#include "bench/report/text.h"

namespace runnel::bench {

namespace {

struct Options {
  Settings settings;
  bool all = false;
  std::string json;
  std::string charts;
  std::string compare;
  ImageTransport image_transport;
};

void Declare(CLI::App& app, Options& options) {
  app.add_option("--filter", options.settings.filter, "only cases whose \"workload/by\" this regular expression finds");
  app.add_flag("--list", options.settings.list, "print the names of the cases, and measure nothing");
  app.add_flag("--quick", options.settings.quick, "in less than a minute, and less exact");
  app.add_flag("--best", options.settings.best,
               "take the best repetition of each case, not the median: where others use the machine");
  app.add_option("--repetitions", options.settings.repetitions, "of each case; the median counts")
      ->check(CLI::PositiveNumber);
  app.add_option("--image-seconds", options.settings.seconds_per_image_case, "for each case of the image transport")
      ->check(CLI::PositiveNumber);
  app.add_flag("--all", options.all, "print every case, those of the rivals too");
  app.add_option("--json", options.json, "write everything that was measured to this file");
  app.add_option("--charts", options.charts, "draw charts into this folder");
  app.add_option("--compare", options.compare, "a file of an earlier run: print old and new")->check(CLI::ExistingFile);
  // For the processes that the image transport starts; their time is --image-seconds.
  app.add_option("--image-transport", options.image_transport.subject)->group("");
  app.add_option("--readers", options.image_transport.readers)->group("");
}

void HurryUp(const CLI::App& app, Settings& settings) {
  if (!settings.quick) return;
  settings.seconds_per_case = 0.01;
  if (app.count("--repetitions") == 0) settings.repetitions = 3;
  if (app.count("--image-seconds") == 0) settings.seconds_per_image_case = 0.6;
}

void RunAllGroups(Suite& suite) {
  suite.RunGroup("baselines", AddBaselines);
  suite.RunGroup("ring", AddRing);
  suite.RunGroup("publish", AddPublish);
  suite.RunGroup("get", AddGet);
  suite.RunGroup("image", AddImage);
  suite.RunGroup("lease", AddLease);
  suite.RunGroup("queue", AddQueue);
  suite.RunGroup("latency", AddLatency);
  suite.RunGroup("wake-up", AddWakeUp);
  suite.RunGroup("payload", AddPayload);
  suite.RunGroup("ports", AddManyPorts);
  suite.RunGroup("connecting", AddConnecting);
  suite.RunGroup("image transport", AddImageTransport);
}

void WriteFile(const std::string& file, const std::string& text) {
  std::ofstream stream(file);
  stream << text;
  if (!stream.flush()) throw std::runtime_error("cannot write " + file);
}

void Report(const Options& options, const Machine& machine, const Results& results, const Quietness& quietness) {
  if (options.all) std::cout << CaseTable(results) << '\n';
  std::cout << BaselineTable(results) << '\n' << MainTable(results) << Failures(results);
  const std::string peers = PeerTable(results);
  if (!peers.empty()) std::cout << '\n' << peers << '\n';
  std::cout << quietness.ToString() << "load now: " << Rounded(LoadAverage()) << '\n';
  if (!options.json.empty()) WriteFile(options.json, ToJson(machine, results));
  if (!options.charts.empty()) WriteCharts(options.charts, results);
}

int Run(int argc, char** argv) {
  CLI::App app("Measures Runnel's ports beside their rivals, on the same workloads in one program.");
  Options options;
  Declare(app, options);
  CLI11_PARSE(app, argc, argv);
  if (!options.image_transport.subject.empty()) {
    options.image_transport.seconds = options.settings.seconds_per_image_case;
    return RunImageTransport(options.image_transport);
  }
  HurryUp(app, options.settings);
  std::optional<EarlierRun> earlier;
  if (!options.compare.empty()) earlier.emplace(options.compare);
  const Machine machine = ThisMachine();
  if (!options.settings.list) std::cout << machine.ToString() << std::endl;
  Results results;
  Suite suite(options.settings, results);
  RunAllGroups(suite);
  if (!suite.has_run()) throw std::runtime_error("--filter finds no case: see --list");
  if (options.settings.list) return 0;
  const Quietness quietness = KeepQuiet(results);
  Report(options, machine, results, quietness);
  if (earlier) std::cout << '\n' << earlier->CompareWith(results);
  return Failures(results).empty() ? 0 : 1;
}

}  // namespace
}  // namespace runnel::bench

int main(int argc, char** argv) {
  try {
    return runnel::bench::Run(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "runnel_bench: " << error.what() << '\n';
    return 2;
  }
}
