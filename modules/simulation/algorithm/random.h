#pragma once

#include <array>
#include <cstdint>

namespace runnel {

/// Pseudo-random numbers, the same for the same seed with every standard library and compiler.
///
/// Blackman and Vigna's xoshiro256++ (2019), seeded by SplitMix64.
///
/// Threads: not thread-safe. Allocation: none.
class Random {
 public:
  explicit Random(std::uint64_t seed);

  [[nodiscard]] std::uint64_t NextBits();
  /// Uniform in [-1, 1).
  [[nodiscard]] double NextSigned() { return static_cast<double>(NextBits() >> 11) * 0x1.0p-52 - 1.0; }
  /// Uniform in [low, high).
  [[nodiscard]] double Between(double low, double high) { return low + (high - low) * (NextSigned() + 1.0) / 2.0; }
  /// One of 0 … count - 1. Precondition: count > 0.
  [[nodiscard]] int Below(int count) { return static_cast<int>(Between(0.0, count)); }
  [[nodiscard]] bool Coin() { return Below(2) == 1; }

 private:
  std::array<std::uint64_t, 4> state_;
};

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
