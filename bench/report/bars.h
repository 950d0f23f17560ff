#pragma once

#include <string>
#include <vector>

#include "bench/report/measurement.h"

namespace runnel::bench {

/// What Runnel has set itself: a figure, as a multiple of another figure of the same run.
struct Bar {
  enum class Kind { kAtMost, kAtLeast };
  /// What is multiplied; without a workload it is f.
  struct Reference {
    std::string workload = {};
    std::string subject = {};
    std::string shown = "f";
  };

  std::string workload;
  std::string subject;
  Kind kind = Kind::kAtMost;
  double limit = 1;
  Reference reference = {};
  std::string quantity = "time";
};

/// All of them.
[[nodiscard]] const std::vector<Bar>& Bars();

struct Verdict {
  std::string bar;  ///< in words
  bool is_known = false;
  bool is_met = false;
};

/// Whether `measurement` keeps `bar`; unknown if the reference was not measured.
[[nodiscard]] Verdict Judge(const Bar& bar, const Measurement& measurement, const Results& results);

}  // namespace runnel::bench
