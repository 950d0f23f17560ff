#include "bench/report/quietness.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "bench/report/text.h"

namespace runnel::bench {

namespace {

double QuickestProbe(const Results& results) {
  double quickest = std::numeric_limits<double>::max();
  for (const Measurement& each : results.all()) {
    for (const double probe : each.probes) quickest = std::min(quickest, probe);
  }
  return quickest;
}

// A core that is shared is a third slower or more; one that is not, a hundredth.
constexpr double kMostSlowness = 1.1;

// Of a few samples, a third.
constexpr std::size_t kEnough = 3;

bool IsQuiet(double probe, double quickest) { return probe <= kMostSlowness * quickest; }

std::size_t CountQuiet(const Measurement& measurement, double quickest) {
  const auto quiet =
      std::ranges::count_if(measurement.probes, [quickest](double probe) { return IsQuiet(probe, quickest); });
  return static_cast<std::size_t>(quiet);
}

void KeepQuiet(Measurement& measurement, double quickest) {
  measurement.quiet = CountQuiet(measurement, quickest);
  measurement.is_disturbed = !IsQuietEnough(measurement, quickest);
  if (measurement.is_disturbed) return;
  std::vector<double> quiet;
  for (std::size_t i = 0; i < measurement.samples.size(); ++i) {
    if (IsQuiet(measurement.probes[i], quickest)) quiet.push_back(measurement.samples[i]);
  }
  measurement.samples = std::move(quiet);
}

}  // namespace

bool IsQuietEnough(const Measurement& measurement, double quickest) {
  const std::size_t enough = std::min(kEnough, (measurement.probes.size() + 2) / 3);
  return CountQuiet(measurement, quickest) >= enough;
}

Quietness KeepQuiet(Results& results) {
  const double quickest = QuickestProbe(results);
  Quietness quietness;
  for (Measurement& each : results.all()) {
    if (each.samples.empty() || each.probes.size() != each.samples.size()) continue;
    quietness.repetitions += each.samples.size();
    KeepQuiet(each, quickest);
    quietness.quiet += each.quiet;
    ++quietness.cases;
    quietness.disturbed_cases += each.is_disturbed ? 1 : 0;
  }
  return quietness;
}

std::string Quietness::ToString() const {
  if (repetitions == 0) return "";
  const double share = 100.0 * static_cast<double>(quiet) / static_cast<double>(repetitions);
  std::string text =
      "quiet: " + Rounded(share) + " % of " + std::to_string(repetitions) + " repetitions, and the others are left out";
  if (disturbed_cases > 0) {
    text += "; but for " + std::to_string(disturbed_cases) + " of " + std::to_string(cases) +
            " cases, marked ~, that had too few quiet ones";
  }
  return text + "\n";
}

}  // namespace runnel::bench
