#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "modules/types/algorithm/angle.h"
#include "modules/types/algorithm/pose.h"

namespace runnel {

/// What a planner is told about the obstacles round the body, whatever sensors the robot carries:
/// the contour of all boundaries known, seen from the body's centre, one distance for each sector
/// of bearing. It holds what is seen now and what a sensor adaptor remembers of the blind side, and
/// is all that a body needs to know about going straight in any direction: of two boundary points
/// at the same bearing the nearer one always stops it first.
///
/// The sensing abstractions of the generic Bug algorithm (how far obstacles are in front, on the left
/// and on the right) are the functions below. 256 bytes, copied freely.
struct Surroundings {
  static constexpr int kSectors = 120;
  static constexpr std::uint16_t kNothingKnown = 0xffff;
  /// m; fine enough that on a straight wall 0.3 m away neighbouring sectors still differ.
  static constexpr double kContourUnit = 0.25e-3;

  /// m, from the body's centre: how far the sensors see. 0 for sensors that only feel what they
  /// touch: then the contour is what was touched so far.
  float sensor_range = 0.0F;
  /// m, from the body's centre: how near to a boundary the centre may come, so the body's radius
  /// and the clearance asked for.
  float safe_distance = 0.0F;
  /// Whether the contour also holds points that are merely possible, of which a closer look may
  /// show that they are free.
  bool is_vague = false;
  /// False as long as nothing was measured: then nothing here is known.
  bool is_measured = false;
  /// The sector of the first place straight ahead that the body would get to and no sensor has looked at, as those of
  /// narrow view leave some; and how far, in units of kContourUnit, the centre can go before. kNothingKnown: there is
  /// none near.
  std::uint8_t unseen_sector = 0;
  std::uint16_t unseen_after = kNothingKnown;
  /// In units of kContourUnit, from the body's centre to the nearest boundary point known in sector
  /// i, of which the middle has the bearing SectorBearing(i) in the body's frame; kNothingKnown if
  /// there is none.
  std::array<std::uint16_t, kSectors> contour = NothingKnown();

  static constexpr std::array<std::uint16_t, kSectors> NothingKnown() {
    std::array<std::uint16_t, kSectors> none{};
    for (auto& distance : none) distance = kNothingKnown;
    return none;
  }
  friend constexpr bool operator==(const Surroundings&, const Surroundings&) = default;
};
static_assert(sizeof(Surroundings) <= 256);
[[nodiscard]] constexpr bool IsMeasured(const Surroundings& surroundings) { return surroundings.is_measured; }

/// A point of a boundary, seen from the body's centre.
struct BoundaryPoint {
  double distance = std::numeric_limits<double>::infinity();  ///< m; infinite if there is none
  double bearing = 0.0;                                       ///< rad, in the body's frame
};

inline constexpr double kSectorWidth = 2 * kPi / Surroundings::kSectors;

/// Sector 0 lies straight ahead, the others follow counter-clockwise.
[[nodiscard]] constexpr double SectorBearing(int sector) {
  return kSectorWidth * (sector <= Surroundings::kSectors / 2 ? sector : sector - Surroundings::kSectors);
}
[[nodiscard]] inline int SectorOf(double bearing) {
  const int sector = static_cast<int>(std::lround(WrapAngle(bearing) / kSectorWidth));
  return (sector + Surroundings::kSectors) % Surroundings::kSectors;
}
/// m; infinite if nothing is known there.
[[nodiscard]] constexpr double ContourDistance(const Surroundings& surroundings, int sector) {
  const std::uint16_t distance = surroundings.contour[static_cast<std::size_t>(sector)];
  return distance == Surroundings::kNothingKnown ? std::numeric_limits<double>::infinity()
                                                 : Surroundings::kContourUnit * distance;
}

/// Adds a boundary point to the contour, if none in its sector is nearer. Points further away than
/// 16 m, or nowhere (no numbers), are left out.
inline void AddBoundaryPoint(Surroundings& surroundings, BoundaryPoint point) {
  const double units = std::floor(point.distance / Surroundings::kContourUnit);
  if (!(units >= 0.0 && units < Surroundings::kNothingKnown)) return;
  if (!std::isfinite(point.bearing)) return;
  auto& nearest = surroundings.contour[static_cast<std::size_t>(SectorOf(point.bearing))];
  nearest = std::min(nearest, static_cast<std::uint16_t>(units));
}

/// What the body would get to first, straight ahead, of what no sensor has looked at: its bearing, and how far the
/// centre can go before; infinitely far if there is none near.
[[nodiscard]] inline BoundaryPoint Unseen(const Surroundings& surroundings) {
  if (surroundings.unseen_after == Surroundings::kNothingKnown) return {};
  return {Surroundings::kContourUnit * surroundings.unseen_after, SectorBearing(surroundings.unseen_sector)};
}

/// The nearest boundary point of which the bearing is at most `half_width` away from `bearing`.
[[nodiscard]] inline BoundaryPoint NearestBoundary(const Surroundings& surroundings, double bearing = 0.0,
                                                   double half_width = kPi) {
  BoundaryPoint nearest;
  for (int sector = 0; sector < Surroundings::kSectors; ++sector) {
    const double distance = ContourDistance(surroundings, sector);
    if (distance >= nearest.distance) continue;
    const double offset = WrapAngle(SectorBearing(sector) - bearing);
    if (std::abs(offset) <= half_width) nearest = {distance, SectorBearing(sector)};
  }
  return nearest;
}

/// What a disc meets on a straight way.
struct WayAhead {
  double free_range = std::numeric_limits<double>::infinity();  ///< m the centre can go
  double obstacle_bearing = 0.0;  ///< rad, of the boundary point that ends the way, seen from here
};

/// How far a disc of `radius` (m) round the body's centre can go straight towards `bearing` (rad,
/// body's frame) before it meets a boundary point known; infinitely far if nothing known is in its
/// way. A point already within the disc stops only motion that comes nearer to it.
[[nodiscard]] inline WayAhead LookAlong(const Surroundings& surroundings, double bearing, double radius) {
  WayAhead way;
  for (int sector = 0; sector < Surroundings::kSectors; ++sector) {
    const double distance = ContourDistance(surroundings, sector);
    if (distance - radius >= way.free_range) continue;
    const double offset = SectorBearing(sector) - bearing;
    const double ahead = distance * std::cos(offset), aside = distance * std::sin(offset);
    if (ahead <= 0.0 || std::abs(aside) >= radius) continue;
    const double free = distance <= radius ? 0.0 : ahead - std::sqrt(radius * radius - aside * aside);
    if (free < way.free_range) way = {free, SectorBearing(sector)};
  }
  return way;
}
[[nodiscard]] inline double FreeRange(const Surroundings& surroundings, double bearing, double radius) {
  return LookAlong(surroundings, bearing, radius).free_range;
}

}  // namespace runnel
