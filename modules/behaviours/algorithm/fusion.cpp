#include "modules/behaviours/algorithm/fusion.h"

#include <algorithm>
#include <cmath>

namespace runnel {

namespace {

// Vectors that leave less than this of each other point nowhere.
constexpr double kNoDirection = 1e-9;

std::size_t WinnerOf(std::span<const FusedChannel> channels) {
  const auto winner = std::ranges::max_element(channels, {}, &FusedChannel::activity);
  return static_cast<std::size_t>(winner - channels.begin());
}

double SumOf(std::span<const FusedChannel> channels) {
  double sum = 0.0;
  for (const FusedChannel& each : channels) sum += each.activity;
  return sum;
}

// Sum of w a and of w r, for weights a / `divisor`, alike for all if there is nothing to divide by.
struct Weighted {
  double activity = 0.0;
  double target_rating = 0.0;
};
Weighted Weigh(std::span<const FusedChannel> channels, double divisor) {
  const double alike = 1.0 / static_cast<double>(channels.size());
  Weighted sum;
  for (const FusedChannel& each : channels) {
    const double weight = divisor > 0.0 ? each.activity / divisor : alike;
    sum.activity += weight * each.activity;
    sum.target_rating += weight * each.target_rating;
  }
  return sum;
}

}  // namespace

FusedSignals Fuse(FusionMethod method, std::span<const FusedChannel> channels, double activation) {
  const std::size_t winner = WinnerOf(channels);
  const FusedChannel& strongest = channels[winner];
  if (method == FusionMethod::kWinnerTakesAll) {
    return {strongest.activity * activation, strongest.target_rating, winner};
  }
  const Weighted average = Weigh(channels, SumOf(channels));
  // What rounding adds must not make more of them than there is.
  const auto [least, greatest] = std::ranges::minmax(channels, {}, &FusedChannel::target_rating);
  const double rating = std::clamp(average.target_rating, least.target_rating, greatest.target_rating);
  if (method == FusionMethod::kWeightedAverage) {
    return {std::min(average.activity, strongest.activity) * activation, rating, winner};
  }
  return {std::min(1.0, Weigh(channels, strongest.activity).activity) * activation, rating, winner};
}

void WeighChannels(FusionMethod method, std::span<const FusedChannel> channels, std::span<double> weights) {
  const std::size_t winner = WinnerOf(channels);
  const double sum = SumOf(channels);
  const double greatest = channels[winner].activity;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    const double activity = channels[i].activity;
    switch (method) {
      case FusionMethod::kWinnerTakesAll:
        weights[i] = i == winner && greatest > 0.0 ? 1.0 : 0.0;
        break;
      case FusionMethod::kWeightedAverage:
        weights[i] = sum > 0.0 ? activity / sum : 0.0;
        break;
      case FusionMethod::kWeightedSum:
        weights[i] = greatest > 0.0 ? activity / greatest : 0.0;
        break;
    }
  }
}

double FuseNumbers(std::span<const double> weights, std::span<const double> numbers) {
  double sum = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    // Nothing of what is infinite is nothing.
    if (weights[i] != 0.0) sum += weights[i] * numbers[i];
  }
  return sum;
}

double FuseAngles(std::span<const double> weights, std::span<const double> angles, std::size_t winner) {
  double x = 0.0, y = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    if (weights[i] == 0.0) continue;
    x += weights[i] * std::cos(angles[i]);
    y += weights[i] * std::sin(angles[i]);
  }
  if (std::hypot(x, y) >= kNoDirection) return std::atan2(y, x);
  return std::atan2(std::sin(angles[winner]), std::cos(angles[winner]));
}

}  // namespace runnel
