#include "apps/arena/bounds.h"

#include <algorithm>

namespace runnel::arena {

std::vector<std::size_t> BoundariesMet(const Course& course, const std::vector<Point2>& hits) {
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

std::optional<double> BoundOf(const std::string& variant, const Course& course, const std::vector<Point2>& hits) {
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

double TimeLimitOf(const Course& course) {
  double way = Distance(Position(course.world.start), course.world.goal);
  for (const BoundaryLoop& loop : course.boundaries) way += LengthOf(loop);
  return std::max(kLeastTimeLimit, kLapsAllowed * way / kSpeedAlongWalls);
}

}  // namespace runnel::arena
