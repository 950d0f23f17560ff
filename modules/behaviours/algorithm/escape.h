#pragma once

#include "modules/types/algorithm/pose.h"
#include "modules/types/algorithm/surroundings.h"

namespace runnel {

struct EscapeConfiguration {
  double patience = 4.0;    ///< s without coming nearer, after which it is a dead end
  double progress = 0.1;    ///< m, by which it must come nearer
  double margin = 0.2;      ///< m, by which it leaves nearer to the goal than it came
  double free_way = 1.0;    ///< m towards the goal, with which it leaves
  double tolerance = 0.1;   ///< m, nearer than this it is there
};

/// Notices that the robot does not come nearer to its goal any more, and when it is out of there. Remembers.
struct EscapeState {
  bool has_goal = false;
  Point2 goal = {};
  double least_distance = 0.0;  ///< m, that it has come near
  double idle_time = 0.0;       ///< s, since it did
  bool is_escaping = false;
  double stuck_distance = 0.0;  ///< m, from the goal, when it was stuck

  friend bool operator==(const EscapeState&, const EscapeState&) = default;
};

/// One cycle of `time_step` s. Whether it is escaping.
bool WatchProgress(const EscapeConfiguration& configuration, double time_step, const Pose2& pose, Point2 goal,
                   const Surroundings& surroundings, EscapeState& state);

}  // namespace runnel
