#include "modules/simulation/algorithm/noise.h"

#include <cmath>

namespace runnel {

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
