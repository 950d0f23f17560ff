#include "apps/arena/course.h"

#include "apps/arena/application_text.h"
#include "modules/simulation/world_file/world_reader.h"

namespace runnel::arena {

std::optional<Course> ReadCourse(const std::filesystem::path& file, double safe_distance,
                                 Diagnostics& diagnostics) {
  auto text = ReadFile(file);
  if (!text) {
    diagnostics.Add(text.error());
    return std::nullopt;
  }
  const auto world = ReadWorld(*text, file.string(), diagnostics);
  if (!world) return std::nullopt;
  const ConfigurationSpace space(*world, safe_distance);
  Course course{.name = world->name.empty() ? file.stem().string() : world->name,
                .file = file,
                .text = *text,
                .world = *world,
                .shortest = {},
                .boundaries = space.Boundaries()};
  // A robot that starts too near to a wall can still drive away from it.
  const auto start = space.NearestFree(Position(world->start), safe_distance);
  const auto goal = space.NearestFree(world->goal, kGoalTolerance);
  if (start && goal) course.shortest = FindShortestPath(space, *start, *goal);
  return course;
}

}  // namespace runnel::arena
