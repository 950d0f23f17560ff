#include "apps/arena/report.h"

#include "apps/arena/application_text.h"
#include "modules/simulation/algorithm/trajectory_svg.h"

namespace runnel::arena {

Result<void> WritePicture(const std::filesystem::path& folder, const Course& course,
                          const RunRecord& record) {
  const RunResult& result = record.result;
  Trajectory trajectory{
      .path = result.path,
      .hits = result.hits,
      .leaves = result.leaves,
      .verdict = result.outcome,
      .tone = course.IsRight(result.outcome) ? VerdictTone::kGood : VerdictTone::kBad,
      .duration = result.simulated_time,
      .length = result.path_length};
  if (result.robot_radius > 0.0) trajectory.robot_radius = result.robot_radius;
  if (!result.path.empty()) {
    const PathSample& last = result.path.back();
    trajectory.end = Pose2{last.position.x, last.position.y, last.heading};
  }
  World world = course.world;
  world.name = record.key.world + " · " + record.key.variant + " · " + record.key.sensor;
  return WriteFile(folder / (FileNameOf(record.key) + ".svg"), TrajectorySvg(world, trajectory));
}

}  // namespace runnel::arena
