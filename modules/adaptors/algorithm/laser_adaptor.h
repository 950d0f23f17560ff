#pragma once

#include "modules/adaptors/algorithm/local_map.h"
#include "modules/types/algorithm/pose.h"
#include "modules/types/algorithm/range_scan.h"
#include "modules/types/algorithm/surroundings.h"

namespace runnel {

struct LaserAdaptorConfiguration {
  double safe_distance = 0.35;      ///< m, from the body's centre to any boundary
  double refutation_margin = 0.10;  ///< m; a point is forgotten if the rays reach this much further
};

/// From a laser's scan to what planners are told. Each ray that met something is a boundary point;
/// points that fell out of the scan (a laser that looks ahead sees nothing behind) are remembered
/// in the world's frame until a later scan looks through them.
class LaserAdaptor {
 public:
  explicit LaserAdaptor(const LaserAdaptorConfiguration& configuration = {})
      : configuration_(configuration) {}

  /// `scan` taken from the body's centre at `pose` (world). Nothing is known (is_measured false) from
  /// a scan without rays, of which half are no numbers, or those of more than 10 degrees in a row. Does not allocate.
  [[nodiscard]] Surroundings Update(const RangeScan& scan, const Pose2& pose);

 private:
  void ForgetWhatTheScanRefutes(const RangeScan& scan);

  LaserAdaptorConfiguration configuration_;
  LocalMap map_;
};

}  // namespace runnel
