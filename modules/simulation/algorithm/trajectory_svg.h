#pragma once

#include <optional>
#include <string>
#include <vector>

#include "modules/simulation/algorithm/path_record.h"
#include "modules/simulation/algorithm/world.h"
#include "modules/types/algorithm/pose.h"

namespace runnel {

/// How a verdict is coloured.
enum class VerdictTone { kGood, kNeutral, kBad };

/// What happened on a run, as far as a picture tells it. In m and s, in the world's frame.
struct Trajectory {
  std::vector<PathSample> path = {};  ///< in the order of time
  std::vector<Point2> hits = {};      ///< where an obstacle was met, in the order of time
  std::vector<Point2> leaves = {};    ///< where an obstacle was left again
  std::vector<Point2> shortest = {};  ///< the shortest path there is, drawn beside; may be empty
  std::optional<Pose2> end = {};      ///< where the robot is drawn
  double robot_radius = RobotOptions{}.radius;
  std::string verdict = {};  ///< for example "goal reached"; "" leaves it out
  VerdictTone tone = VerdictTone::kNeutral;
  double duration = 0.0;  ///< s of simulated time
  double length = 0.0;    ///< m driven
};

/// A picture of a world and of what a robot did in it, as a complete SVG file for a light
/// background: obstacles, start and goal, the path coloured by mode with arrows along it, numbered
/// hit points (H1, H2, …) and leave points (L1, …), the robot where it ended, a grid of 1 m (in
/// worlds of more than 60 m, of 10 m, and so on), and a caption with name, verdict, length and
/// time. Each element has a class ("path", "hit", …).
///
/// The same input gives the same bytes, whatever the locale. What is not finite is left out.
[[nodiscard]] std::string TrajectorySvg(const World& world, const Trajectory& trajectory);

}  // namespace runnel
