#pragma once

#include "modules/adaptors/algorithm/local_map.h"
#include "modules/types/algorithm/infrared_ranges.h"
#include "modules/types/algorithm/pose.h"
#include "modules/types/algorithm/surroundings.h"

namespace runnel {

struct InfraredAdaptorConfiguration {
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
/// of the arc that were not there.
class InfraredAdaptor {
 public:
  explicit InfraredAdaptor(const InfraredAdaptorConfiguration& configuration = {})
      : configuration_(configuration) {}

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
  void MarkArc(const Cone& cone, const Pose2& pose);
  bool IsExplained(const Cone& cone, const Pose2& pose) const;
  bool MarkArcPoints(const Cone& cone, const Pose2& pose, bool even_where_free);

  InfraredAdaptorConfiguration configuration_;
  LocalMap map_;
};

}  // namespace runnel
