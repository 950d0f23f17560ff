#include "bench/report/chart_axis.h"

#include <algorithm>
#include <cmath>

namespace runnel::bench {

namespace {

constexpr double kMuch = 30;  // from the smallest to the largest
constexpr double kMostSteps = 6;
constexpr double kRounding = 1e-9;

}  // namespace

void ChartAxis::Include(double value) {
  low_ = std::min(low_, value);
  high_ = std::max(high_, value);
}

void ChartAxis::Finish() {
  is_logarithmic_ = low_ > 0 && high_ > kMuch * low_;
  if (!is_logarithmic_) return FinishLinear();
  bottom_ = std::floor(std::log10(low_) + kRounding);
  top_ = std::ceil(std::log10(high_) - kRounding);
}

void ChartAxis::FinishLinear() {
  if (high_ <= 0) high_ = 1;
  // The smallest of 1, 2, 5, 10, 20 … that needs few steps.
  const double power = std::pow(10, std::floor(std::log10(high_ / kMostSteps)));
  for (const double factor : {1.0, 2.0, 5.0, 10.0}) {
    step_ = factor * power;
    if (high_ <= kMostSteps * step_) break;
  }
  top_ = std::ceil(high_ / step_ - kRounding) * step_;
}

double ChartAxis::Share(double value) const {
  const double place = is_logarithmic_ ? std::log10(value) : value;
  return (place - bottom_) / (top_ - bottom_);
}

std::vector<double> ChartAxis::Ticks() const {
  std::vector<double> ticks;
  for (double place = bottom_; place <= top_ + step_ * kRounding; place += step_) {
    ticks.push_back(is_logarithmic_ ? std::pow(10, place) : place);
  }
  return ticks;
}

}  // namespace runnel::bench
