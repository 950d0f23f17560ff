#pragma once

#include <cstdint>

#include "modules/simulation/algorithm/random.h"

namespace runnel {

/// Normally distributed numbers, the same for the same seed with every
/// standard library, which std::normal_distribution does not promise.
///
/// The polar method of Marsaglia and Bray (1964).
///
/// Threads: not thread-safe. Allocation: none.
class GaussianNoise {
 public:
  explicit GaussianNoise(std::uint64_t seed) : random_(seed) {}

  /// With mean 0. A deviation of 0 gives exactly 0 (and draws no number); it is never negative.
  double operator()(double standard_deviation);

 private:
  Random random_;
  double spare_ = 0.0;
  bool has_spare_ = false;
};

}  // namespace runnel
