#pragma once

#include <cstddef>
#include <string>

#include "bench/report/measurement.h"

namespace runnel::bench {

/// How much of a run had the machine to itself.
struct Quietness {
  std::size_t repetitions = 0;
  std::size_t quiet = 0;
  std::size_t cases = 0;
  std::size_t disturbed_cases = 0;  ///< of which too few repetitions were quiet: all of theirs count

  /// Ends with a line end; empty if nothing was probed.
  [[nodiscard]] std::string ToString() const;
};

/// Whether `measurement` has enough samples at which the core was about as quick as at `quickest`, the
/// shortest of all probes.
[[nodiscard]] bool IsQuietEnough(const Measurement& measurement, double quickest);

/// Leaves out the repetitions before or after which the core was slower than it can be, where enough
/// others are left. What is left out is chosen by the probe, not by what was measured.
Quietness KeepQuiet(Results& results);

}  // namespace runnel::bench
