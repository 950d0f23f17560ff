#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/base/error.h"
#include "modules/worlds/algorithm/shortest_path.h"

namespace runnel::arena {

/// A world, and what is true of it for every planner.
struct Course {
  std::string name;
  std::filesystem::path file;
  std::string text;  ///< of the file
  World world;
  /// Of the robot's centre with its safe distance from the obstacles; nothing if there is none:
  /// then "unreachable" is right.
  std::optional<ShortestPath> shortest;
  std::vector<BoundaryLoop> boundaries;  ///< of the obstacles grown by the safe distance

  [[nodiscard]] bool IsRight(const std::string& outcome) const {
    return outcome == (shortest ? "reached" : "unreachable");
  }
};

/// A goal that is nearer to a wall than the safe distance by no more than this can be reached all
/// the same: planners are content so near to it.
inline constexpr double kGoalTolerance = 0.10;  // m

/// Errors are added: all that is wrong with the file.
[[nodiscard]] std::optional<Course> ReadCourse(const std::filesystem::path& file, double safe_distance,
                                               Diagnostics& diagnostics);

}  // namespace runnel::arena
