#include "modules/worlds/algorithm/configuration_space.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "modules/simulation/algorithm/world_geometry.h"
#include "modules/worlds/algorithm/internal/plane_geometry.h"

namespace runnel {

namespace {

using internal::Meeting;
using internal::PositiveAngle;
using internal::Sweep;

constexpr double kSamePlace = 1e-9;  // m
constexpr double kSameAngle = 1e-12;

Point2 On(const ConfigurationSpace::Circle& circle, double angle) {
  return circle.centre + circle.radius * UnitVector(angle);
}

Point2 Unit(Point2 a) { return (1.0 / Norm(a)) * a; }

/// To the right of the direction in which the segment goes.
Segment2 MovedRight(const Segment2& segment, double by) {
  const Point2 along = Unit(segment.to - segment.from);
  const Point2 right{along.y, -along.x};
  return {segment.from + by * right, segment.to + by * right};
}

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

/// Whether a round piece passes between its centre and the point, or the point between them.
bool IsBeside(const BoundaryPiece& piece, Point2 point) {
  const double first = Direction(piece.from - *piece.centre);
  return Sweep(first, Direction(point - *piece.centre)) <= Sweep(first, Direction(piece.to - *piece.centre));
}

}  // namespace

double BoundaryPiece::length() const {
  if (!centre) return Distance(from, to);
  return Distance(*centre, from) * Sweep(Direction(from - *centre), Direction(to - *centre));
}

double BoundaryPiece::DistanceTo(Point2 point) const {
  if (!centre) return Distance(Segment2{from, to}, point);
  if (IsBeside(*this, point)) return std::abs(Distance(*centre, point) - Distance(*centre, from));
  return std::min(Distance(point, from), Distance(point, to));
}

ConfigurationSpace::ConfigurationSpace(World world, double radius)
    : world_(std::move(world)), radius_(radius), outline_(OutlineOf(world_)) {
  for (const Outline::Flat& flat : outline_.flats) {
    offsets_.push_back(MovedRight(flat.ground, radius_));
    offsets_.push_back(MovedRight({flat.ground.to, flat.ground.from}, radius_));
  }
  const auto add = [this](Point2 centre, double grown) {
    const bool is_known = std::ranges::any_of(circles_, [&](const Circle& circle) {
      return circle.radius == grown && Distance(circle.centre, centre) < kSamePlace;
    });
    if (!is_known && grown > 0.0) circles_.push_back({centre, grown});
  };
  for (const Outline::Round& round : outline_.rounds) add(round.centre, round.radius + radius_);
  for (const Outline::Flat& flat : outline_.flats) add(flat.ground.from, radius_);
  for (const Outline::Flat& flat : outline_.flats) add(flat.ground.to, radius_);
  for (Circle& circle : circles_) CutCircle(circle);
}

void ConfigurationSpace::CutCircle(Circle& circle) const {
  std::vector<double> cuts{0.0};
  const auto add = [&](const std::vector<Point2>& points) {
    for (const Point2 point : points) cuts.push_back(PositiveAngle(Direction(point - circle.centre)));
  };
  for (const Segment2& offset : offsets_) {
    add(Meeting(circle.centre, circle.radius, offset, kTolerance));
  }
  for (const Circle& other : circles_) {
    add(Meeting(circle.centre, circle.radius, other.centre, other.radius, kTolerance));
  }
  std::ranges::sort(cuts);
  const auto same = std::unique(cuts.begin(), cuts.end(), [](double a, double b) { return b - a < kSameAngle; });
  cuts.erase(same, cuts.end());
  circle.is_free.clear();
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    const double next = i + 1 < cuts.size() ? cuts[i + 1] : cuts.front() + 2 * kPi;
    circle.is_free.push_back(IsFree(On(circle, (cuts[i] + next) / 2)));
  }
  circle.cuts = std::move(cuts);
}

double ConfigurationSpace::SurfaceDistance(Point2 point) const {
  double least = std::numeric_limits<double>::infinity();
  for (const Outline::Flat& flat : outline_.flats) {
    least = std::min(least, Distance(flat.ground, point));
  }
  for (const Outline::Round& round : outline_.rounds) {
    least = std::min(least, Distance(round.centre, point) - round.radius);
  }
  return least;
}

bool ConfigurationSpace::IsFree(Point2 point) const {
  return SurfaceDistance(point) >= radius_ - kTolerance && ClearanceAt(world_, point) >= radius_ - kTolerance;
}

bool ConfigurationSpace::IsFree(const Segment2& segment) const {
  const double least = radius_ - kTolerance;
  return std::ranges::none_of(
             outline_.flats,
             [&](const Outline::Flat& flat) { return internal::Distance(flat.ground, segment) < least; }) &&
         std::ranges::none_of(outline_.rounds, [&](const Outline::Round& round) {
           return Distance(segment, round.centre) < round.radius + least;
         });
}

bool ConfigurationSpace::IsFree(const Circle& circle, double from, double to) const {
  const double sweep = to - from;
  for (std::size_t i = 0; i < circle.cuts.size(); ++i) {
    if (circle.is_free[i]) continue;
    const double next = i + 1 < circle.cuts.size() ? circle.cuts[i + 1] : 2 * kPi;
    const double begin = Sweep(from, circle.cuts[i]), length = next - circle.cuts[i];
    // It begins within the arc, or reaches over the arc's beginning. What is shorter than the
    // tolerance is rounding.
    const double shortest = kTolerance / circle.radius;
    const double overlap_at_begin = std::min(length, sweep - begin);
    const double overlap_at_end = std::min(sweep, begin + length - 2 * kPi);
    if (length > shortest && std::max(overlap_at_begin, overlap_at_end) > shortest) return false;
  }
  return true;
}

std::optional<Point2> ConfigurationSpace::NearestFree(Point2 point, double reach) const {
  if (IsFree(point)) return point;
  std::optional<Point2> nearest;
  const auto consider = [&](Point2 candidate) {
    const double distance = Distance(point, candidate);
    if (distance > reach || (nearest && distance >= Distance(point, *nearest))) return;
    if (IsFree(candidate)) nearest = candidate;
  };
  for (const Segment2& offset : offsets_) consider(NearestPoint(offset, point));
  for (const Circle& circle : circles_) {
    consider(On(circle, Direction(point - circle.centre)));
    for (const double cut : circle.cuts) consider(On(circle, cut));
  }
  return nearest;
}

void ConfigurationSpace::AddPiecesOf(const Segment2& offset, std::vector<BoundaryPiece>& pieces) const {
  const double length = Distance(offset.from, offset.to);
  std::vector<double> cuts{0.0, length};
  const auto add = [&](Point2 point) {
    const double at = Distance(offset.from, point);
    if (at < length) cuts.push_back(at);
  };
  for (const Circle& circle : circles_) {
    for (const Point2 point : Meeting(circle.centre, circle.radius, offset, kTolerance)) {
      if (Distance(offset, point) < kSamePlace) add(point);
    }
  }
  for (const Segment2& other : offsets_) {
    if (const auto part = WhereItMeets(offset, other)) cuts.push_back(*part * length);
  }
  std::ranges::sort(cuts);
  const Point2 along = Unit(offset.to - offset.from);
  for (std::size_t i = 1; i < cuts.size(); ++i) {
    if (cuts[i] - cuts[i - 1] < kTolerance) continue;
    if (!IsFree(offset.from + (cuts[i] + cuts[i - 1]) / 2 * along)) continue;
    pieces.push_back({offset.from + cuts[i - 1] * along, offset.from + cuts[i] * along});
  }
}

void ConfigurationSpace::AddPiecesOf(const Circle& circle, std::vector<BoundaryPiece>& pieces) const {
  for (std::size_t i = 0; i < circle.cuts.size(); ++i) {
    const double from = circle.cuts[i];
    const double to = i + 1 < circle.cuts.size() ? circle.cuts[i + 1] : 2 * kPi;
    if (!circle.is_free[i] || (to - from) * circle.radius < kTolerance) continue;
    // In halves: a whole circle would begin where it ends.
    const double middle = (from + to) / 2;
    pieces.push_back({On(circle, from), On(circle, middle), circle.centre});
    pieces.push_back({On(circle, middle), On(circle, to), circle.centre});
  }
}

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

// A piece that begins and ends on different sides of the line is crossed once, so a line through a joint is counted once; a
// round one that only bulges over the line is crossed twice.
int Crossings(const BoundaryLoop& loop, const Segment2& segment) {
  const double length = Distance(segment.from, segment.to);
  const Point2 along = Unit(segment.to - segment.from), left{-along.y, along.x};
  const auto ahead = [&](Point2 point) { return Dot(along, point - segment.from); };
  const auto beside = [&](Point2 point) { return Dot(left, point - segment.from); };
  int count = 0;
  const auto add = [&](double way) { count += way >= 0.0 && way <= length ? 1 : 0; };
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const BoundaryPiece& piece = loop[i];
    const Point2 end = loop[(i + 1) % loop.size()].from;
    const double before = beside(piece.from), after = beside(end);
    const bool comes_from_right = before < 0.0, goes_to_right = after < 0.0;
    if (!piece.centre) {
      if (comes_from_right != goes_to_right) add(ahead(piece.from + before / (before - after) * (end - piece.from)));
      continue;
    }
    const double radius = Distance(*piece.centre, piece.from), off = beside(*piece.centre);
    const double half = std::sqrt(std::max(0.0, radius * radius - off * off));
    const Point2 farthest = *piece.centre + (comes_from_right ? radius : -radius) * left;
    const bool bulges =
        comes_from_right == goes_to_right && (beside(farthest) < 0.0) != comes_from_right && IsBeside(piece, farthest);
    // Counter-clockwise it goes to the left ahead of the centre, and to the right behind it.
    if (bulges || (comes_from_right && !goes_to_right)) add(ahead(*piece.centre) + half);
    if (bulges || (!comes_from_right && goes_to_right)) add(ahead(*piece.centre) - half);
  }
  return count;
}

}  // namespace runnel
