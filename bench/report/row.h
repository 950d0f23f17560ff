#pragma once

#include <string>
#include <vector>

#include "bench/report/bars.h"
#include "bench/report/measurement.h"

namespace runnel::bench {

/// One line of the table: one figure of Runnel's, what it was to be, and the best of its rivals.
struct Row {
  const Measurement* runnel = nullptr;
  double in_f = 0;  ///< 0: not a time
  std::vector<Verdict> verdicts;
  const Measurement* best_rival = nullptr;  ///< nullptr: nobody else did the same
  double ratio = 0;                         ///< above 1: how many times better Runnel is
  std::string winner;
};

/// A row for each of Runnel's figures, in the order of measuring. They point into `results`.
[[nodiscard]] std::vector<Row> MakeRows(const Results& results);

}  // namespace runnel::bench
