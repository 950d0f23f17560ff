#pragma once

#include <functional>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "bench/report/measurement.h"

namespace runnel::bench {

struct Settings {
  std::string filter = ".";  ///< regular expression for "workload/subject"
  bool quick = false;
  bool list = false;  ///< print the names of the cases instead of running them
  bool best = false;  ///< of the repetitions instead of the median
  int repetitions = 7;
  double seconds_per_case = 0.05;       ///< and repetition
  double seconds_per_image_case = 2.0;  ///< image transport, likewise
};

/// The cases of one group after the other, run by Google Benchmark: the repetitions of all cases of
/// a group in turns, in random order, so that what else the machine does hits all of them alike.
///
///     suite.Start({"ring of 5"});
///     suite.Add(Role::kRival, "seqlock", [](benchmark::State& state) { … });
class Suite {
 public:
  using Run = std::function<void(benchmark::State&)>;
  using AddCases = void (*)(Suite&);

  Suite(Settings settings, Results& results);

  [[nodiscard]] const Settings& settings() const noexcept { return settings_; }

  /// Has `add` make the cases of a group and runs those that the filter lets through.
  void RunGroup(const std::string& group, AddCases add);
  /// Whether the filter let anything through so far.
  [[nodiscard]] bool has_run() const noexcept { return has_run_; }

  /// What follows belongs to `workload`.
  void Start(Workload workload);
  /// Time is what an iteration takes on the clock; other quantities are the state's counters. With
  /// several threads, time is that of one thread's iteration.
  benchmark::internal::Benchmark* Add(Role role, const std::string& subject, Run run);
  /// `run` has other processes do the work, once: what goes on on this core meanwhile says nothing.
  void AddProcess(Role role, const std::string& subject, Run run);
  /// `run` says itself how long each iteration took.
  benchmark::internal::Benchmark* AddTimed(Role role, const std::string& subject, Run run);

 private:
  class Collector;
  struct Case {
    Workload workload;
    Subject subject;
    std::vector<Measurement> measurements = {};
  };

  benchmark::internal::Benchmark* Register(Role role, const std::string& subject, Run run, bool is_probed = true);
  [[nodiscard]] std::vector<std::string> WantedNames() const;
  void RunCases();
  // Whether all cases of the group have been measured often enough while the core was left alone.
  [[nodiscard]] bool IsQuietEnough() const;
  void Collect(const std::string& name, const std::vector<benchmark::BenchmarkReporter::Run>& runs);

  const Settings settings_;
  Results& results_;
  bool has_run_ = false;
  std::string group_;
  Workload workload_;
  std::vector<Case> cases_;                     // of the group, in the order of their making
  std::map<std::string, std::size_t> numbers_;  // of the cases, by name
  double quickest_probe_ = std::numeric_limits<double>::max();
};

}  // namespace runnel::bench
