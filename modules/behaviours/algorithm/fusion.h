#pragma once

#include <cstddef>
#include <span>

namespace runnel {

/// How the behaviours of one node are made one.
enum class FusionMethod {
  kWinnerTakesAll,   ///< the first of those with the greatest activity
  kWeightedAverage,  ///< by activity
  kWeightedSum,      ///< by activity in parts of the greatest
};

/// One behaviour that a fusion has before it. Both within [0, 1].
struct FusedChannel {
  double activity = 0.0;
  double target_rating = 0.0;
};

struct FusedSignals {
  double activity = 0.0;
  double target_rating = 0.0;
  std::size_t winner = 0;  ///< the first channel with the greatest activity
};

/// The meta signals of the fusion itself:
///
///                       activity                            target rating
///   winner takes all    a_s * activation                    r_s
///   weighted average    (sum a^2 / sum a) * activation      sum a r / sum a
///   weighted sum        min(1, sum a^2 / max a) * activation    as weighted average
///
/// Neutral: the activity lies between min(a) * activation and min(1, sum a) * activation, the target rating between
/// the least and the greatest. At least one channel. Does not allocate.
[[nodiscard]] FusedSignals Fuse(FusionMethod method, std::span<const FusedChannel> channels, double activation);

/// By what each channel's value is multiplied before all are added: 0 for all where nobody is active, as nobody wants any
/// of them. As many weights as channels.
void WeighChannels(FusionMethod method, std::span<const FusedChannel> channels, std::span<double> weights);

/// The sum, weighted.
[[nodiscard]] double FuseNumbers(std::span<const double> weights, std::span<const double> numbers);
/// Angles (rad) as weighted unit vectors, so that pi and -pi are one. In (-pi, pi]; that of the winner if they cancel out.
[[nodiscard]] double FuseAngles(std::span<const double> weights, std::span<const double> angles, std::size_t winner);

}  // namespace runnel
