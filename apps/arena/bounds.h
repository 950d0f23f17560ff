#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "apps/arena/course.h"

namespace runnel::arena {

/// The boundaries that the robot has met: for each, by which of its hit points first; indices into
/// the boundaries of the course, each once.
[[nodiscard]] inline std::vector<std::size_t> BoundariesMet(const Course& course, const std::vector<Point2>& hits) {
  std::vector<std::size_t> met;
  for (const Point2 hit : hits) {
    const auto away = [hit](const BoundaryLoop& loop) { return DistanceTo(loop, hit); };
    const auto found = std::ranges::min_element(course.boundaries, {}, away);
    const auto nearest = static_cast<std::size_t>(found - course.boundaries.begin());
    const bool is_new = std::ranges::find(met, nearest) == met.end();
    if (found != course.boundaries.end() && is_new) met.push_back(nearest);
  }
  return met;
}

/// How long the path may be at most, in m, as its authors have proved for a point that follows
/// boundaries exactly, with the lengths P of the grown obstacles met and the straight distance D:
///
///     bug1        D + 1.5 ΣP          Lumelsky, Stepanov 1984
///     bug2        D + Σ n P / 2       the same 1986; n crossings of the line and the boundary,
///                                        rounded up to an even number
///     alg1, alg2  D + 2 ΣP            Sankaranarayanan, Vidyasagar 1990
///
/// Nothing for other variants, for which no such bound is known to us.
[[nodiscard]] inline std::optional<double> BoundOf(const std::string& variant, const Course& course,
                                                   const std::vector<Point2>& hits) {
  const Segment2 line{Position(course.world.start), course.world.goal};
  const auto sum = [&](const auto& factor) {
    double bound = Distance(line.from, line.to);
    for (const std::size_t i : BoundariesMet(course, hits)) {
      bound += factor(course.boundaries[i]) * LengthOf(course.boundaries[i]);
    }
    return bound;
  };
  if (variant == "bug1") {
    return sum([](const BoundaryLoop&) { return 1.5; });
  }
  if (variant == "bug2") {
    // A line that ends inside of an obstacle goes in once more than out; then the robot goes round.
    return sum([&](const BoundaryLoop& loop) { return (Crossings(loop, line) + 1) / 2; });
  }
  if (variant == "alg1" || variant == "alg2") {
    return sum([](const BoundaryLoop&) { return 2.0; });
  }
  return std::nullopt;
}

inline constexpr double kLapsAllowed = 15.0;
inline constexpr double kSpeedAlongWalls = 0.3;   ///< m/s, that of the planners' default
inline constexpr double kLeastTimeLimit = 300.0;  ///< s

/// s, simulated, after which a run on the course is a timeout: as long as going kLapsAllowed times along every wall there
/// is, and from start to goal, takes at kSpeedAlongWalls. The slowest run known to be right, of a variant that ends, took
/// the time of four such laps (infrared, which has to be turned to what it looks at). At least kLeastTimeLimit.
[[nodiscard]] inline double TimeLimitOf(const Course& course) {
  double way = Distance(Position(course.world.start), course.world.goal);
  for (const BoundaryLoop& loop : course.boundaries) way += LengthOf(loop);
  return std::max(kLeastTimeLimit, kLapsAllowed * way / kSpeedAlongWalls);
}

}  // namespace runnel::arena
