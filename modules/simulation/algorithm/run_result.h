#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "modules/simulation/algorithm/path_record.h"

namespace runnel {

/// What is left of a run when it is over, for programs that compare runs. In m, rad and s, in the
/// world's frame.
struct RunResult {
  std::string outcome = {};         ///< "reached", "unreachable", "timeout", "collision", "error"
  std::string remark = {};          ///< what an error was; may be empty
  double path_length = 0.0;         ///< m
  double simulated_time = 0.0;      ///< s
  std::uint64_t cycles = 0;         ///< of control
  double robot_radius = 0.0;        ///< m
  std::vector<Point2> hits = {};    ///< where obstacles were met, in the order of time
  std::vector<Point2> leaves = {};  ///< where they were left again
  std::vector<PathSample> path = {};
};

/// Leaves out samples that are nearer than `step` (m) to the last one kept; the first and the last
/// stay. A step of 0 leaves all.
[[nodiscard]] std::vector<PathSample> ThinnedPath(const std::vector<PathSample>& path, double step);

}  // namespace runnel
