#pragma once

#include <string>

#include "bench/report/measurement.h"

namespace runnel::bench {

/// What the other figures are compared with.
[[nodiscard]] std::string BaselineTable(const Results& results);
/// Runnel beside its bars and its best rivals, and one line that counts.
[[nodiscard]] std::string MainTable(const Results& results);
/// Every case that was measured, with the range of its repetitions.
[[nodiscard]] std::string CaseTable(const Results& results);
/// What could not be measured, a line each; empty if all could.
[[nodiscard]] std::string Failures(const Results& results);

}  // namespace runnel::bench
