#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/arena/course.h"

namespace runnel::arena {

/// The boundaries that the robot has met: for each, by which of its hit points first; indices into
/// the boundaries of the course, each once.
[[nodiscard]] std::vector<std::size_t> BoundariesMet(const Course& course, const std::vector<Point2>& hits);

/// How long the path may be at most, in m, as its authors have proved for a point that follows
/// boundaries exactly, with the lengths P of the grown obstacles met and the straight distance D:
///
///     bug1        D + 1.5 ΣP          Lumelsky, Stepanov 1984
///     bug2        D + Σ n P / 2       the same 1986; n crossings of the line and the boundary,
///                                        rounded up to an even number
///     alg1, alg2  D + 2 ΣP            Sankaranarayanan, Vidyasagar 1990
///
/// Nothing for other variants, for which no such bound is known to us.
[[nodiscard]] std::optional<double> BoundOf(const std::string& variant, const Course& course,
                                            const std::vector<Point2>& hits);

/// s, simulated, after which a run on the course is a timeout: as long as going kLapsAllowed times along every wall there
/// is, and from start to goal, takes at kSpeedAlongWalls. The slowest run known to be right, of a variant that ends, took
/// the time of four such laps (infrared, which has to be turned to what it looks at). At least kLeastTimeLimit.
[[nodiscard]] double TimeLimitOf(const Course& course);
inline constexpr double kLapsAllowed = 15.0;
inline constexpr double kSpeedAlongWalls = 0.3;   ///< m/s, that of the planners' default
inline constexpr double kLeastTimeLimit = 300.0;  ///< s

}  // namespace runnel::arena
