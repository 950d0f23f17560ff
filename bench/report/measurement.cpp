#include "bench/report/measurement.h"

#include <algorithm>

namespace runnel::bench {

double Measurement::Median() const {
  if (samples.empty()) return 0;
  std::vector<double> sorted = samples;
  std::ranges::sort(sorted);
  const std::size_t middle = sorted.size() / 2;
  return sorted.size() % 2 == 1 ? sorted[middle] : (sorted[middle - 1] + sorted[middle]) / 2;
}

double Measurement::Typical() const {
  if (!best_counts) return Median();
  return quantity.more_is_better ? Maximum() : Minimum();
}

double Measurement::Minimum() const { return samples.empty() ? 0 : *std::ranges::min_element(samples); }

double Measurement::Maximum() const { return samples.empty() ? 0 : *std::ranges::max_element(samples); }

const Measurement* Results::Find(const std::string& workload, const std::string& subject,
                                 const std::string& quantity) const {
  const auto found = std::ranges::find_if(all_, [&](const Measurement& each) {
    return each.workload.name == workload && each.subject.name == subject && each.quantity.name == quantity &&
           !each.samples.empty();
  });
  return found == all_.end() ? nullptr : &*found;
}

double Results::FetchAdd(const std::string& group) const {
  const auto found = std::ranges::find_if(
      all_, [&](const Measurement& each) { return each.group == group && each.subject.name == kFetchAdd; });
  return found == all_.end() ? 0 : found->Typical();
}

}  // namespace runnel::bench
