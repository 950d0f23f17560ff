#include "bench/core/suite.h"

#include <algorithm>
#include <iostream>
#include <regex>
#include <utility>

#include "bench/core/support/core_probe.h"
#include "bench/core/workloads/workloads.h"
#include "bench/report/quietness.h"

namespace runnel::bench {

namespace {

// The library takes its options from a command line only.
void InitializeLibrary(const Settings& settings) {
  std::vector<std::string> options = {"runnel_bench", "--benchmark_enable_random_interleaving=true",
                                      "--benchmark_repetitions=" + std::to_string(settings.repetitions),
                                      "--benchmark_min_time=" + std::to_string(settings.seconds_per_case)};
  std::vector<char*> arguments;
  for (std::string& option : options) arguments.push_back(option.data());
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
}

std::string NameOf(const Workload& workload, const std::string& subject) { return workload.name + "/" + subject; }

// How often the cases of a group are repeated again, as long as the machine is not quiet.
constexpr int kMostRounds = 3;

constexpr const char* kProbe = "core probe";

// Runs a repetition between two looks at the core: what happens to it in the midst seldom begins and ends
// there. With several threads, one looks.
Suite::Run Probed(Suite::Run run) {
  return [run = std::move(run)](benchmark::State& state) {
    const bool looks = state.thread_index() == 0;
    const double before = looks ? ProbeCore() : 0;
    run(state);
    if (looks) state.counters[kProbe] = std::max(before, ProbeCore());
  };
}

double ValueOf(const benchmark::BenchmarkReporter::Run& run, const Quantity& quantity) {
  if (quantity.name == TimeQuantity().name) {
    return run.GetAdjustedRealTime() * static_cast<double>(run.threads);
  }
  const auto counter = run.counters.find(quantity.name);
  return counter == run.counters.end() ? 0 : counter->second.value;
}

}  // namespace

class Suite::Collector final : public benchmark::BenchmarkReporter {
 public:
  explicit Collector(Suite& suite) : suite_(suite) {}
  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override {
    if (!runs.empty()) suite_.Collect(runs.front().run_name.function_name, runs);
  }

 private:
  Suite& suite_;
};

Suite::Suite(Settings settings, Results& results) : settings_(std::move(settings)), results_(results) {
  InitializeLibrary(settings_);
}

void Suite::RunGroup(const std::string& group, AddCases add) {
  group_ = group;
  cases_.clear();
  numbers_.clear();
  Start({kBaselineWorkload});
  AddFetchAdd(*this);
  add(*this);
  const std::vector<std::string> names = WantedNames();
  has_run_ = has_run_ || !names.empty();
  if (settings_.list) {
    for (const std::string& name : names) std::cout << name << '\n';
  } else if (!names.empty()) {
    std::cerr << "measuring: " << group << std::endl;
    RunCases();
  }
  benchmark::ClearRegisteredBenchmarks();
}

void Suite::RunCases() {
  Collector collector(*this);
  const int rounds = settings_.quick ? 1 : kMostRounds;
  for (int round = 0; round < rounds && !IsQuietEnough(); ++round) {
    benchmark::RunSpecifiedBenchmarks(&collector, "(" + kFetchAdd + ")|" + settings_.filter);
  }
  for (Case& each : cases_) {
    for (Measurement& measurement : each.measurements) results_.Add(std::move(measurement));
  }
}

bool Suite::IsQuietEnough() const {
  bool has_run = false;
  for (const Case& each : cases_) {
    for (const Measurement& measurement : each.measurements) {
      has_run = true;
      if (!bench::IsQuietEnough(measurement, quickest_probe_)) return false;
    }
  }
  return has_run;
}

void Suite::Start(Workload workload) { workload_ = std::move(workload); }

benchmark::internal::Benchmark* Suite::Add(Role role, const std::string& subject, Run run) {
  return Register(role, subject, std::move(run))->UseRealTime();
}

benchmark::internal::Benchmark* Suite::AddTimed(Role role, const std::string& subject, Run run) {
  return Register(role, subject, std::move(run))->UseManualTime()->Iterations(1);
}

void Suite::AddProcess(Role role, const std::string& subject, Run run) {
  Register(role, subject, std::move(run), false)->UseRealTime()->Iterations(1);
}

benchmark::internal::Benchmark* Suite::Register(Role role, const std::string& subject, Run run, bool is_probed) {
  const std::string name = NameOf(workload_, subject);
  numbers_[name] = cases_.size();
  cases_.push_back({workload_, {role, subject}});
  return benchmark::RegisterBenchmark(name.c_str(), is_probed ? Probed(std::move(run)) : std::move(run));
}

std::vector<std::string> Suite::WantedNames() const {
  const std::regex filter(settings_.filter, std::regex::extended);
  std::vector<std::string> names;
  for (const Case& each : cases_) {
    const std::string name = NameOf(each.workload, each.subject.name);
    if (each.subject.name != kFetchAdd && std::regex_search(name, filter)) names.push_back(name);
  }
  return names;
}

void Suite::Collect(const std::string& name, const std::vector<benchmark::BenchmarkReporter::Run>& runs) {
  const auto found = numbers_.find(name);
  // The library hands in its own sums as well, after the repetitions.
  if (found == numbers_.end() || runs.front().run_type != runs.front().RT_Iteration) return;
  Case& which = cases_[found->second];
  const bool is_first = which.measurements.empty();
  for (std::size_t i = 0; i < which.workload.quantities.size(); ++i) {
    const Quantity& quantity = which.workload.quantities[i];
    if (is_first) {
      which.measurements.push_back({group_, which.workload, which.subject, quantity, {}});
    }
    Measurement& measurement = which.measurements[i];
    measurement.best_counts = settings_.best;
    for (const auto& run : runs) {
      if (run.error_occurred) measurement.error = run.error_message;
      if (run.error_occurred) continue;
      measurement.samples.push_back(ValueOf(run, quantity));
      const auto probe = run.counters.find(kProbe);
      if (probe == run.counters.end()) continue;
      measurement.probes.push_back(probe->second.value);
      quickest_probe_ = std::min(quickest_probe_, measurement.probes.back());
    }
  }
}

}  // namespace runnel::bench
