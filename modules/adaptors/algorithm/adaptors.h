#pragma once

#include "modules/adaptors/algorithm/local_map.h"
#include "modules/types/algorithm/measurements.h"
#include "modules/types/algorithm/pose.h"
#include "modules/types/algorithm/surroundings.h"

namespace runnel {

struct BumperAdaptorConfiguration {
  double body_radius = 0.15;    ///< m; what the bumper feels is so far from the body's centre
  double safe_distance = 0.20;  ///< m, from the body's centre to any boundary felt before
  double body_margin = 0.03;    ///< m; a point by so much inside the body is none
};

/// From a bumper all round the body to what planners are told: the points it has touched so far
/// nearby, in the world's frame. What it has not touched counts as free, so a planner learns of an
/// obstacle by touching it, again and again along a wall. `sensor_range` is 0.
class BumperAdaptor {
 public:
  explicit BumperAdaptor(const BumperAdaptorConfiguration& configuration = {}) : configuration_(configuration) {}

  /// `contact` felt at `pose` (world). Does not allocate.
  [[nodiscard]] Surroundings Update(const Contact& contact, const Pose2& pose);

 private:
  BumperAdaptorConfiguration configuration_;
  Contact last_;
  LocalMap map_;
};

struct InfraredAdaptorConfiguration {
  double body_radius = 0.15;    ///< m, not more than it is: what is nearer counts as free
  double safe_distance = 0.35;  ///< m, from the body's centre to any boundary
  /// m; a cone is free up to its echo less this, which is more than half a cell's diagonal.
  double refutation_margin = 0.05;
  /// m; the place of an echo on an arc not longer than this counts as known.
  double certain_arc = 0.20;
  double arc_step = 0.03;  ///< m between the points that stand for an echo's arc
};

/// From three infrared rangers to what planners are told. An echo says that something lies on the
/// arc across its cone and nothing nearer within the cone, not where on the arc. An echo that a
/// boundary point known explains adds nothing. Otherwise all of the arc becomes boundary, except
/// where an earlier reading looked through; later readings from other places look through the parts
/// of the arc that were not there. Where the body stands, nothing else is; what it would get to straight ahead of what no
/// cone has looked at, is told (Unseen).
class InfraredAdaptor {
 public:
  explicit InfraredAdaptor(const InfraredAdaptorConfiguration& configuration = {}) : configuration_(configuration) {}

  /// `ranges` taken from the body's centre at `pose` (world). Nothing is known (is_measured
  /// false) from ranges with range_maximum 0, or where one is no number. Does not allocate.
  [[nodiscard]] Surroundings Update(const InfraredRanges& ranges, const Pose2& pose);

 private:
  struct Cone {
    double bearing;     ///< rad, of its axis in the body's frame
    double half_width;  ///< rad, below pi / 2
    double echo;        ///< m, at most range_maximum
    bool has_echo;
  };
  void Carve(const Cone& cone, const Pose2& pose);
  void AddUnseen(const Pose2& pose, Surroundings& surroundings) const;
  void MarkArc(const Cone& cone, const Pose2& pose);
  bool IsExplained(const Cone& cone, const Pose2& pose) const;
  bool MarkArcPoints(const Cone& cone, const Pose2& pose, bool even_where_free);

  InfraredAdaptorConfiguration configuration_;
  LocalMap map_;
};

struct LaserAdaptorConfiguration {
  double safe_distance = 0.35;      ///< m, from the body's centre to any boundary
  double refutation_margin = 0.10;  ///< m; a point is forgotten if the rays reach this much further
};

/// From a laser's scan to what planners are told. Each ray that met something is a boundary point;
/// points that fell out of the scan (a laser that looks ahead sees nothing behind) are remembered
/// in the world's frame until a later scan looks through them.
class LaserAdaptor {
 public:
  explicit LaserAdaptor(const LaserAdaptorConfiguration& configuration = {}) : configuration_(configuration) {}

  /// `scan` taken from the body's centre at `pose` (world). Nothing is known (is_measured false) from
  /// a scan without rays, of which half are no numbers, or those of more than 10 degrees in a row. Does not allocate.
  [[nodiscard]] Surroundings Update(const RangeScan& scan, const Pose2& pose);

 private:
  void ForgetWhatTheScanRefutes(const RangeScan& scan);

  LaserAdaptorConfiguration configuration_;
  LocalMap map_;
};

}  // namespace runnel
