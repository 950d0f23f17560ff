#include "apps/arena/matrix.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "apps/arena/names.h"
#include "modules/simulation/world_file/world_file.h"

namespace runnel::arena {

std::optional<Course> ReadCourse(const std::filesystem::path& file, double safe_distance, Diagnostics& diagnostics) {
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

namespace {

template <typename Word>
std::vector<Word> WithoutRepeats(const std::vector<Word>& words) {
  std::vector<Word> single;
  for (const Word& word : words) {
    if (std::ranges::find(single, word) == single.end()) single.push_back(word);
  }
  return single;
}

void ReadCourses(const ArenaArguments& arguments, Matrix& matrix, Diagnostics& diagnostics) {
  std::vector<std::filesystem::path> files;
  for (const std::string& word : arguments.worlds) {
    const auto file = FindWorldFile(word);
    if (!file) {
      diagnostics.Add(file.error());
    } else if (std::ranges::find(files, *file) == files.end()) {
      files.push_back(*file);
    }
  }
  for (const auto& file : files) {
    auto course = ReadCourse(file, arguments.settings.safe_distance, diagnostics);
    if (!course) continue;
    const auto same = std::ranges::find(matrix.courses, course->name, &Course::name);
    if (same == matrix.courses.end()) {
      matrix.courses.push_back(std::move(*course));
    } else {
      diagnostics.Add({.message = "two worlds are called '" + course->name + "'",
                       .position = {file.string()},
                       .hint = "the other is " + same->file.string()});
    }
  }
}

/// By sensor and variant's name.
using Applications = std::map<std::pair<std::string, std::string>, std::string>;

Applications ReadApplications(const ArenaArguments& arguments, const Product& product, const Matrix& matrix,
                              Diagnostics& diagnostics) {
  CheckNames(arguments.sensors, XmlNamesIn(product.applications), "sensor", diagnostics);
  Applications applications;
  if (!diagnostics.ok()) return applications;
  for (const std::string& sensor : WithoutRepeats(arguments.sensors)) {
    for (const Variant& variant : matrix.variants) {
      const auto file = product.applications / (sensor + ".xml");
      if (auto text = ApplicationText(file, variant, arguments.plugins)) {
        applications[{sensor, variant.name}] = std::move(*text);
      } else {
        diagnostics.Add(text.error());
      }
    }
  }
  return applications;
}

void AddRuns(const ArenaArguments& arguments, const Applications& applications, Matrix& matrix) {
  const auto sensors = WithoutRepeats(arguments.sensors);
  const auto directions = WithoutRepeats(arguments.directions);
  const auto seeds = WithoutRepeats(arguments.seeds);
  for (std::size_t course = 0; course < matrix.courses.size(); ++course) {
    for (const Variant& variant : matrix.variants) {
      for (const std::string& sensor : sensors) {
        const std::string& application = applications.at({sensor, variant.name});
        // Tells versions apart, no more.
        const std::string made_of =
            fmt::format("{:x}", std::hash<std::string>()(matrix.courses[course].text + '\0' + application));
        for (const std::string& direction : directions) {
          for (const std::uint64_t seed : seeds) {
            matrix.runs.push_back({.key = {matrix.courses[course].name, variant.name, sensor, direction, seed},
                                   .course = course,
                                   .application = application,
                                   .made_of = made_of});
          }
        }
      }
    }
  }
}

}  // namespace

std::optional<Matrix> MakeMatrix(const ArenaArguments& arguments, const Product& product, Diagnostics& diagnostics) {
  Matrix matrix;
  ReadCourses(arguments, matrix, diagnostics);
  const auto types = FindTypes(arguments.plugins, diagnostics);
  matrix.variants = FindVariants(WithoutRepeats(arguments.variants), types, diagnostics);
  CheckNames(arguments.directions, {"left", "right"}, "direction", diagnostics);
  const Applications applications = ReadApplications(arguments, product, matrix, diagnostics);
  if (!diagnostics.ok()) return std::nullopt;
  AddRuns(arguments, applications, matrix);
  // Each N-th, so that worlds and variants that take long are dealt out evenly.
  std::size_t number = 0;
  std::erase_if(matrix.runs, [&](const PlannedRun&) { return number++ % arguments.shards != arguments.shard - 1; });
  return matrix;
}

}  // namespace runnel::arena
