#include <algorithm>
#include <cmath>

#include "modules/worlds/algorithm/configuration_space.h"
#include "modules/worlds/algorithm/internal/plane_geometry.h"

namespace runnel {

namespace {

/// Ends of pieces that follow each other are as near as that, after the rounding of intersections
/// at flat angles.
constexpr double kJoint = 1e-4;  // m

bool AreSame(const BoundaryPiece& a, const BoundaryPiece& b) {
  return Distance(a.from, b.from) < kJoint && Distance(a.to, b.to) < kJoint &&
         std::abs(a.length() - b.length()) < kJoint;
}

/// Where two obstacles share a surface, it has been found twice.
std::vector<BoundaryPiece> WithoutDoubles(const std::vector<BoundaryPiece>& pieces) {
  std::vector<BoundaryPiece> single;
  for (const BoundaryPiece& piece : pieces) {
    const auto same = [&](const BoundaryPiece& other) { return AreSame(piece, other); };
    if (std::ranges::none_of(single, same)) single.push_back(piece);
  }
  return single;
}

int RoundCrossings(const BoundaryPiece& piece, const Segment2& segment) {
  int count = 0;
  const double radius = Distance(*piece.centre, piece.from);
  const double first = Direction(piece.from - *piece.centre);
  const double sweep = internal::Sweep(first, Direction(piece.to - *piece.centre));
  for (const Point2 point : internal::Meeting(*piece.centre, radius, segment, 0.0)) {
    if (internal::Sweep(first, Direction(point - *piece.centre)) < sweep) ++count;
  }
  return count;
}

}  // namespace

std::vector<BoundaryLoop> ConfigurationSpace::Boundaries() const {
  std::vector<BoundaryPiece> all;
  for (const Segment2& offset : offsets_) AddPiecesOf(offset, all);
  for (const Circle& circle : circles_) AddPiecesOf(circle, all);
  std::vector<BoundaryPiece> left = WithoutDoubles(all);
  std::vector<BoundaryLoop> loops;
  while (!left.empty()) {
    BoundaryLoop loop{left.back()};
    left.pop_back();
    for (;;) {
      const Point2 end = loop.back().to;
      const auto away = [&](const BoundaryPiece& piece) { return Distance(end, piece.from); };
      const auto next = std::ranges::min_element(left, {}, away);
      const double closing = Distance(end, loop.front().from);
      if (next == left.end() || away(*next) > kJoint || closing <= away(*next)) break;
      loop.push_back(*next);
      left.erase(next);
    }
    loops.push_back(std::move(loop));
  }
  return loops;
}

double LengthOf(const BoundaryLoop& loop) {
  double length = 0.0;
  for (const BoundaryPiece& piece : loop) length += piece.length();
  return length;
}

double DistanceTo(const BoundaryLoop& loop, Point2 point) {
  double least = std::numeric_limits<double>::infinity();
  for (const BoundaryPiece& piece : loop) least = std::min(least, piece.DistanceTo(point));
  return least;
}

int Crossings(const BoundaryLoop& loop, const Segment2& segment) {
  int count = 0;
  for (const BoundaryPiece& piece : loop) {
    if (piece.centre) {
      count += RoundCrossings(piece, segment);
    } else if (WhereItMeets(segment, {piece.from, piece.to})) {
      ++count;
    }
  }
  return count;
}

}  // namespace runnel
