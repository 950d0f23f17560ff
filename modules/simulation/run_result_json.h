#pragma once

#include <string>

#include "modules/simulation/algorithm/run_result.h"

namespace runnel {

/// The result as one JSON object: outcome, remark, path_length_m, sim_time_s, cycles,
/// robot_radius_m, hits and leaves (lists of [x, y]), path (list of [t, x, y, heading]) and modes
/// (of each point of the path: 0 driving to the goal, 1 following a wall, 2 going to the leave
/// point). Numbers of the path are rounded to six places, others lose no bit; what is not finite is null.
[[nodiscard]] std::string JsonOf(const RunResult& result);

}  // namespace runnel
