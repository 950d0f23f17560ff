#include "modules/simulation/algorithm/ray_caster.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace runnel {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Few surfaces need few cells: a ray through an empty one has walked for nothing. That many for each surface, and no
/// more than so many along a side.
constexpr double kCellsPerSurface = 4.0;
constexpr double kMostCellsPerSide = 48.0;
constexpr double kSmallestCell = 0.1;  // m
/// A flat reaches this part of its length past its ends, so that no ray slips through a corner.
constexpr double kOverlap = 1e-12;

double DistanceToFlat(const Segment2& flat, Point2 origin, Point2 direction) {
  const Point2 along = flat.to - flat.from, gap = flat.from - origin;
  const double denominator = Cross(direction, along);
  if (denominator == 0.0) return kInfinity;
  // Most are missed, and are found to be without a division.
  const double size = std::abs(denominator);
  const double part = std::copysign(1.0, denominator) * Cross(gap, direction);  // times size
  if (!(part >= -kOverlap * size && part <= (1.0 + kOverlap) * size)) return kInfinity;
  const double distance = Cross(gap, along) / denominator;
  return distance >= 0.0 ? distance : kInfinity;
}

double DistanceToRound(const Outline::Round& round, Point2 origin, Point2 direction) {
  const Point2 to_centre = round.centre - origin;
  const double middle = Dot(to_centre, direction), aside = Cross(to_centre, direction);
  const double half_chord_squared = round.radius * round.radius - aside * aside;
  if (half_chord_squared < 0.0) return kInfinity;
  const double half_chord = std::sqrt(half_chord_squared);
  if (middle >= half_chord) return middle - half_chord;
  return middle + half_chord >= 0.0 ? middle + half_chord : kInfinity;
}

/// The part of a ray within [low, high] along one axis; empty if first > second.
std::pair<double, double> Within(double origin, double inverse_direction, double low, double high) {
  if (std::isinf(inverse_direction)) {
    const bool inside = origin >= low && origin <= high;
    return inside ? std::pair(-kInfinity, kInfinity) : std::pair(kInfinity, -kInfinity);
  }
  const double a = (low - origin) * inverse_direction, b = (high - origin) * inverse_direction;
  return std::minmax(a, b);
}

}  // namespace

RayCaster::RayCaster(const Outline& outline, double eye_height) {
  for (const Outline::Flat& flat : outline.flats) {
    if (flat.height > eye_height) flats_.push_back(flat.ground);
  }
  for (const Outline::Round& round : outline.rounds) {
    if (round.height > eye_height) rounds_.push_back(round);
  }
  if (flats_.empty() && rounds_.empty()) return;
  MeasureExtent();
  FillCells();
}

void RayCaster::MeasureExtent() {
  Extent all{{kInfinity, kInfinity}, {-kInfinity, -kInfinity}};
  for (const Segment2& flat : flats_) all.Include(flat.from), all.Include(flat.to);
  for (const Outline::Round& round : rounds_) all.Include(round.centre, round.radius);
  low_ = all.low, high_ = all.high;
  const Point2 extent = high_ - low_;
  const auto surfaces = static_cast<double>(flats_.size() + rounds_.size());
  const double cells_per_side = std::min(std::sqrt(kCellsPerSurface * surfaces), kMostCellsPerSide);
  cell_size_ = std::max(std::max(extent.x, extent.y) / cells_per_side, kSmallestCell);
  cells_per_metre_ = 1.0 / cell_size_;
  low_ = low_ - Point2{0.01 * cell_size_, 0.01 * cell_size_};  // nothing lies on the border
  columns_ = static_cast<std::ptrdiff_t>((high_.x - low_.x) / cell_size_ + 1.01);
  rows_ = static_cast<std::ptrdiff_t>((high_.y - low_.y) / cell_size_ + 1.01);
  high_ = low_ + Point2{static_cast<double>(columns_) * cell_size_, static_cast<double>(rows_) * cell_size_};
}

void RayCaster::FillCells() {
  buckets_.resize(static_cast<std::size_t>(columns_ * rows_));
  std::uint32_t surface = 0;
  for (const Segment2& flat : flats_) {
    AddToCells(surface++, {std::min(flat.from.x, flat.to.x), std::min(flat.from.y, flat.to.y)},
               {std::max(flat.from.x, flat.to.x), std::max(flat.from.y, flat.to.y)});
  }
  for (const Outline::Round& round : rounds_) {
    const Point2 reach = {round.radius, round.radius};
    AddToCells(surface++, round.centre - reach, round.centre + reach);
  }
  for (const std::vector<std::uint32_t>& bucket : buckets_) {
    first_.push_back(static_cast<std::uint32_t>(surfaces_.size()));
    surfaces_.insert(surfaces_.end(), bucket.begin(), bucket.end());
  }
  first_.push_back(static_cast<std::uint32_t>(surfaces_.size()));
  buckets_.clear();
  buckets_.shrink_to_fit();
}

void RayCaster::AddToCells(std::uint32_t surface, Point2 low, Point2 high) {
  const auto index = [this](double value, double origin, std::ptrdiff_t count) {
    const double cell = std::floor((value - origin) / cell_size_);
    return std::clamp(static_cast<std::ptrdiff_t>(cell), std::ptrdiff_t{0}, count - 1);
  };
  const double reach = 0.72 * cell_size_;  // from the middle of a cell to its corner, and a little
  const double margin = 0.01 * cell_size_;
  for (auto row = index(low.y - margin, low_.y, rows_); row <= index(high.y + margin, low_.y, rows_); ++row) {
    for (auto column = index(low.x - margin, low_.x, columns_); column <= index(high.x + margin, low_.x, columns_);
         ++column) {
      const Point2 middle = low_ + Point2{(static_cast<double>(column) + 0.5) * cell_size_,
                                          (static_cast<double>(row) + 0.5) * cell_size_};
      if (IsNear(surface, middle, reach)) {
        buckets_[static_cast<std::size_t>(row * columns_ + column)].push_back(surface);
      }
    }
  }
}

bool RayCaster::IsNear(std::uint32_t surface, Point2 point, double distance) const {
  if (surface < flats_.size()) return Distance(flats_[surface], point) <= distance;
  const Outline::Round& round = rounds_[surface - flats_.size()];
  return std::abs(Distance(round.centre, point) - round.radius) <= distance;
}

double RayCaster::DistanceTo(std::uint32_t surface, Point2 origin, Point2 direction) const {
  return surface < flats_.size() ? DistanceToFlat(flats_[surface], origin, direction)
                                 : DistanceToRound(rounds_[surface - flats_.size()], origin, direction);
}

double RayCaster::NearestInCell(std::size_t cell, Point2 origin, Point2 direction, double nearest) const {
  for (std::uint32_t i = first_[cell]; i < first_[cell + 1]; ++i) {
    nearest = std::min(nearest, DistanceTo(surfaces_[i], origin, direction));
  }
  return nearest;
}

RayCaster::AxisWalk RayCaster::StartWalk(double origin, double direction, double inverse_direction, double low,
                                         double entry, std::ptrdiff_t count) const {
  AxisWalk walk;
  const double place = (origin + entry * direction - low) * cells_per_metre_;
  walk.cell = std::clamp(static_cast<std::ptrdiff_t>(std::floor(place)), std::ptrdiff_t{0}, count - 1);
  walk.step = std::isinf(inverse_direction) ? 0 : direction > 0.0 ? 1 : -1;
  if (walk.step == 0) {
    walk.next_border = kInfinity;
    return walk;
  }
  const double border = low + static_cast<double>(walk.cell + (walk.step > 0 ? 1 : 0)) * cell_size_;
  walk.next_border = (border - origin) * inverse_direction;
  walk.border_distance = cell_size_ * std::abs(inverse_direction);
  return walk;
}

double RayCaster::Cast(Point2 origin, double direction, double range) const {
  return CastAlong(origin, UnitVector(direction), range);
}

void RayCaster::CastFan(Point2 origin, Point2 ahead, std::span<const Point2> directions, double range,
                        std::span<float> distances) const {
  for (std::size_t i = 0; i < directions.size(); ++i) {
    distances[i] = static_cast<float>(CastAlong(origin, Turned(directions[i], ahead), range));
  }
}

double RayCaster::CastAlong(Point2 origin, Point2 direction, double range) const {
  if (surfaces_.empty()) return kInfinity;
  // Infinite along an axis that the ray is at right angles to.
  const Point2 inverse{1.0 / direction.x, 1.0 / direction.y};
  const auto [x_entry, x_exit] = Within(origin.x, inverse.x, low_.x, high_.x);
  const auto [y_entry, y_exit] = Within(origin.y, inverse.y, low_.y, high_.y);
  const double entry = std::max({x_entry, y_entry, 0.0});
  const double exit = std::min({x_exit, y_exit, range});
  if (!(entry <= exit)) return kInfinity;  // also where anything is no number

  AxisWalk x = StartWalk(origin.x, direction.x, inverse.x, low_.x, entry, columns_);
  AxisWalk y = StartWalk(origin.y, direction.y, inverse.y, low_.y, entry, rows_);
  double nearest = kInfinity;
  while (x.cell >= 0 && x.cell < columns_ && y.cell >= 0 && y.cell < rows_) {
    const auto cell = static_cast<std::size_t>(y.cell * columns_ + x.cell);
    nearest = NearestInCell(cell, origin, direction, nearest);
    AxisWalk& next = x.next_border < y.next_border ? x : y;
    if (nearest <= next.next_border || next.next_border > exit) break;
    next.cell += next.step;
    next.next_border += next.border_distance;
  }
  return nearest <= range ? nearest : kInfinity;
}

}  // namespace runnel
