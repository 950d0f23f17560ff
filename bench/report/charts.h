#pragma once

#include <string>
#include <vector>

#include "bench/report/measurement.h"

namespace runnel::bench {

/// Who did one thing, how well: a bar each, the best first.
[[nodiscard]] std::string BarChart(const std::vector<const Measurement*>& measurements);

/// The same quantity of a family of workloads against what differs among them: a line for each
/// subject.
[[nodiscard]] std::string LineChart(const std::vector<const Measurement*>& measurements);

/// A chart for each quantity of each workload or family, as SVG files in `folder` (which is made),
/// and an index.html that shows them all. Throws std::runtime_error if they cannot be written.
void WriteCharts(const std::string& folder, const Results& results);

}  // namespace runnel::bench
