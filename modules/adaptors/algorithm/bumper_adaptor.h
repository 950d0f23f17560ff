#pragma once

#include "modules/adaptors/algorithm/local_map.h"
#include "modules/types/algorithm/contact.h"
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
  explicit BumperAdaptor(const BumperAdaptorConfiguration& configuration = {})
      : configuration_(configuration) {}

  /// `contact` felt at `pose` (world). Does not allocate.
  [[nodiscard]] Surroundings Update(const Contact& contact, const Pose2& pose);

 private:
  BumperAdaptorConfiguration configuration_;
  Contact last_;
  LocalMap map_;
};

}  // namespace runnel
