// The formulas of fusions beside an independent reckoning: as they are printed, in extended precision, over random inputs.

#include <algorithm>
#include <cmath>
#include <complex>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "modules/behaviours/algorithm/fusion.h"

namespace runnel {
namespace {

using Exact = long double;
constexpr double kNear = 1e-9;

struct Expected {
  Exact activity = 0, target_rating = 0, value = 0;
  std::complex<Exact> direction;
};

Expected Reckon(FusionMethod method, const std::vector<FusedChannel>& channels, double activation,
                const std::vector<double>& values) {
  Exact sum = 0, squares = 0, greatest = -1, rated = 0;
  std::size_t winner = 0;
  for (std::size_t k = 0; k < channels.size(); ++k) {
    const Exact a = channels[k].activity;
    sum += a;
    squares += a * a;
    rated += a * channels[k].target_rating;
    if (a > greatest) {
      greatest = a;
      winner = k;
    }
  }
  const Exact n = static_cast<Exact>(channels.size());
  const auto weight = [&](std::size_t k) -> Exact {
    const Exact a = channels[k].activity;
    if (method == FusionMethod::kWinnerTakesAll) return k == winner && a > 0 ? 1 : 0;
    if (method == FusionMethod::kWeightedAverage) return sum > 0 ? a / sum : 0;
    return greatest > 0 ? a / greatest : 0;
  };
  Expected expected;
  for (std::size_t k = 0; k < channels.size(); ++k) {
    expected.value += weight(k) * static_cast<Exact>(values[k]);
    expected.direction += weight(k) * std::polar<Exact>(1, static_cast<Exact>(values[k]));
  }
  Exact mean_rating = 0;
  for (const FusedChannel& each : channels) mean_rating += each.target_rating / n;
  switch (method) {
    case FusionMethod::kWinnerTakesAll:
      expected.activity = greatest * activation;
      expected.target_rating = channels[winner].target_rating;
      break;
    case FusionMethod::kWeightedAverage:
      expected.activity = sum > 0 ? squares / sum * activation : 0;
      expected.target_rating = sum > 0 ? rated / sum : mean_rating;
      break;
    case FusionMethod::kWeightedSum:
      expected.activity = greatest > 0 ? std::min<Exact>(1, squares / greatest) * activation : 0;
      expected.target_rating = sum > 0 ? rated / sum : mean_rating;
      break;
  }
  return expected;
}

/// Numbers with many that are 0, that are 1, and that are alike.
class Numbers {
 public:
  explicit Numbers(unsigned seed) : random_(seed) {}
  double Signal() {
    const int kind = Whole(0, 5);
    if (kind == 0) return 0.0;
    if (kind == 1) return 1.0;
    if (kind == 2) return 0.5;
    return std::uniform_real_distribution(0.0, 1.0)(random_);
  }
  double Value() { return std::uniform_real_distribution(-4.0, 4.0)(random_); }
  int Whole(int least, int most) { return std::uniform_int_distribution(least, most)(random_); }
  std::vector<FusedChannel> Channels() {
    std::vector<FusedChannel> channels(static_cast<std::size_t>(Whole(1, 7)));
    const bool is_idle = Whole(0, 9) == 0;
    for (FusedChannel& each : channels) each = {is_idle ? 0.0 : Signal(), Signal()};
    return channels;
  }

 private:
  std::mt19937 random_;
};

constexpr FusionMethod kMethods[] = {FusionMethod::kWinnerTakesAll, FusionMethod::kWeightedAverage,
                                     FusionMethod::kWeightedSum};

TEST(FusionFormulasTest, AgreeWithAnIndependentReckoning) {
  Numbers numbers(3);
  for (int round = 0; round < 10000; ++round) {
    const auto channels = numbers.Channels();
    const double activation = numbers.Signal();
    std::vector<double> values(channels.size()), weights(channels.size());
    for (double& each : values) each = numbers.Value();
    for (const FusionMethod method : kMethods) {
      const Expected expected = Reckon(method, channels, activation, values);
      const FusedSignals fused = Fuse(method, channels, activation);
      EXPECT_NEAR(fused.activity, static_cast<double>(expected.activity), kNear);
      EXPECT_NEAR(fused.target_rating, static_cast<double>(expected.target_rating), kNear);
      WeighChannels(method, channels, weights);
      EXPECT_NEAR(FuseNumbers(weights, values), static_cast<double>(expected.value), kNear);
      if (std::abs(expected.direction) < 1e-6) continue;
      const double angle = FuseAngles(weights, values, fused.winner);
      EXPECT_NEAR(std::remainder(angle - static_cast<double>(std::arg(expected.direction)), 2 * M_PI), 0.0, 1e-6);
    }
  }
}

// What a fusion says of itself lies between those that it makes one: it neither makes up activity nor loses it.
TEST(FusionFormulasTest, AreNeutral) {
  Numbers numbers(4);
  for (int round = 0; round < 10000; ++round) {
    const auto channels = numbers.Channels();
    const double activation = numbers.Signal();
    double least = 1, sum = 0, least_rating = 1, greatest_rating = 0;
    for (const FusedChannel& each : channels) {
      least = std::min(least, each.activity);
      sum += each.activity;
      least_rating = std::min(least_rating, each.target_rating);
      greatest_rating = std::max(greatest_rating, each.target_rating);
    }
    for (const FusionMethod method : kMethods) {
      const FusedSignals fused = Fuse(method, channels, activation);
      EXPECT_GE(fused.activity, least * activation - 1e-12);
      EXPECT_LE(fused.activity, std::min(1.0, sum) * activation + 1e-12);
      EXPECT_LE(fused.activity, activation) << "the rule, without any rounding";
      EXPECT_GE(fused.target_rating, least_rating);
      EXPECT_LE(fused.target_rating, greatest_rating);
    }
  }
}

// A tree of fusions, of any shape: what comes out of its root lies between its leaves.
TEST(FusionFormulasTest, NetworksOfFusionsAreNeutral) {
  Numbers numbers(5);
  for (int round = 0; round < 2000; ++round) {
    std::vector<FusedChannel> level;
    double sum = 0, least = 1, least_rating = 1, greatest_rating = 0;
    for (int i = numbers.Whole(2, 12); i > 0; --i) {
      level.push_back({numbers.Signal(), numbers.Signal()});
      sum += level.back().activity;
      least = std::min(least, level.back().activity);
      least_rating = std::min(least_rating, level.back().target_rating);
      greatest_rating = std::max(greatest_rating, level.back().target_rating);
    }
    while (level.size() > 1) {
      std::vector<FusedChannel> next;
      for (std::size_t i = 0; i < level.size();) {
        const auto count = std::min(level.size() - i, static_cast<std::size_t>(numbers.Whole(1, 4)));
        const std::vector<FusedChannel> channels(level.begin() + static_cast<std::ptrdiff_t>(i),
                                                 level.begin() + static_cast<std::ptrdiff_t>(i + count));
        const FusedSignals fused = Fuse(kMethods[numbers.Whole(0, 2)], channels, 1.0);
        next.push_back({fused.activity, fused.target_rating});
        i += count;
      }
      if (next.size() == level.size()) next = {level.front()};
      level = next;
    }
    EXPECT_LE(level.front().activity, std::min(1.0, sum) + 1e-12);
    EXPECT_GE(level.front().activity, least - 1e-12);
    EXPECT_GE(level.front().target_rating, least_rating - 1e-12);
    EXPECT_LE(level.front().target_rating, greatest_rating + 1e-12);
  }
}

TEST(FusionFormulasTest, AnglesMeetWhereTheCircleCloses) {
  const std::vector weights{0.5, 0.5};
  EXPECT_NEAR(std::abs(FuseAngles(weights, std::vector{M_PI - 0.1, -M_PI + 0.1}, 0)), M_PI, 1e-12);
  EXPECT_NEAR(FuseAngles(weights, std::vector{0.25, 0.75}, 0), 0.5, 1e-12);
  EXPECT_NEAR(FuseAngles(weights, std::vector{0.5, 0.5 - M_PI}, 0), 0.5, 1e-12) << "they cancel out: the winner's";
}

}  // namespace
}  // namespace runnel
