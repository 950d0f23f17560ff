#pragma once

#include <array>
#include <cstdint>

namespace runnel {

/// Normally distributed numbers, the same for the same seed with every
/// standard library, which std::normal_distribution does not promise.
///
/// Blackman and Vigna's xoshiro256++ (2019), seeded by SplitMix64, and the polar method of
/// Marsaglia and Bray (1964).
///
/// Threads: not thread-safe. Allocation: none.
class GaussianNoise {
 public:
  explicit GaussianNoise(std::uint64_t seed);

  /// With mean 0. A deviation of 0 gives exactly 0 (and draws no number); it is never negative.
  double operator()(double standard_deviation);

 private:
  std::uint64_t NextBits();
  double NextSigned();  // uniform in [-1, 1)

  std::array<std::uint64_t, 4> state_;
  double spare_ = 0.0;
  bool has_spare_ = false;
};

}  // namespace runnel
