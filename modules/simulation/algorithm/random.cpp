#include "modules/simulation/algorithm/random.h"

#include <bit>
#include <cmath>

namespace runnel {

Random::Random(std::uint64_t seed) {
  for (std::uint64_t& word : state_) {  // SplitMix64
    seed += 0x9e3779b97f4a7c15U;
    std::uint64_t mixed = (seed ^ (seed >> 30)) * 0xbf58476d1ce4e5b9U;
    mixed = (mixed ^ (mixed >> 27)) * 0x94d049bb133111ebU;
    word = mixed ^ (mixed >> 31);
  }
}

std::uint64_t Random::NextBits() {
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

double GaussianNoise::operator()(double standard_deviation) {
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

}  // namespace runnel
