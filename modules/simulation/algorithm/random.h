#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace runnel {

/// Pseudo-random numbers, the same for the same seed with every standard library and compiler.
///
/// Blackman and Vigna's xoshiro256++ (2019), seeded by SplitMix64.
///
/// Threads: not thread-safe. Allocation: none.
class Random {
 public:
  explicit Random(std::uint64_t seed) {
    for (std::uint64_t& word : state_) {  // SplitMix64
      seed += 0x9e3779b97f4a7c15U;
      std::uint64_t mixed = (seed ^ (seed >> 30)) * 0xbf58476d1ce4e5b9U;
      mixed = (mixed ^ (mixed >> 27)) * 0x94d049bb133111ebU;
      word = mixed ^ (mixed >> 31);
    }
  }

  [[nodiscard]] std::uint64_t NextBits() {
    const std::uint64_t result = std::rotl(state_[0] + state_[3], 23) + state_[0];
    const std::uint64_t shifted = state_[1] << 17;
    state_[2] ^= state_[0];
    state_[3] ^= state_[1];
    state_[1] ^= state_[2];
    state_[0] ^= state_[3];
    state_[2] ^= shifted;
    state_[3] = std::rotl(state_[3], 45);
    return result;
  }

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
  double operator()(double standard_deviation) {
    if (standard_deviation == 0.0) return 0.0;
    if (has_spare_) {
      has_spare_ = false;
      return standard_deviation * spare_;
    }
    double x = 0.0, y = 0.0, square = 0.0;
    do {
      x = random_.NextSigned();
      y = random_.NextSigned();
      square = x * x + y * y;
    } while (square >= 1.0 || square == 0.0);
    const double factor = std::sqrt(-2.0 * std::log(square) / square);
    spare_ = factor * y;
    has_spare_ = true;
    return standard_deviation * factor * x;
  }

 private:
  Random random_;
  double spare_ = 0.0;
  bool has_spare_ = false;
};

}  // namespace runnel
