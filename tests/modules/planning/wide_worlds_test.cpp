// Random worlds of disjoint obstacles with gaps that the robot fits through: there every variant
// but Com must end with the right verdict, within the bound that its authors have proven, with hit
// and leave points on the boundary.

#include <algorithm>
#include <array>
#include <optional>
#include <random>
#include <string>
#include <tuple>

#include <gmock/gmock.h>

#include "tests/modules/planning/drive.h"
#include "tests/modules/planning/sketch.h"
#include "tests/modules/planning/variant_index.h"

namespace runnel {
namespace {

using namespace testing_world;

constexpr double kSafeDistance = 0.35;                           // m
constexpr double kGap = 2 * Robot::kRadius + 2 * kSafeDistance;  // m, between two obstacles at least
constexpr double kHalfArena = 4.0;                               // m
// What a controller adds to the way of an ideal point.
constexpr double kMarginPerMetre = 0.05;
constexpr double kMargin = 0.5;  // m
// m by which hit and leave points are off the grown boundary.
constexpr double kLaserTolerance = 0.07;
constexpr double kInfraredTolerance = 0.18;

double DistanceBetween(const Polygon& a, const Polygon& b) {
  double least = BugState::kNever;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Segment2 side = {a[i], a[(i + 1) % a.size()]};
    for (const Point2 point : b) least = std::min(least, Distance(side, point));
  }
  return least;
}

struct WideWorld {
  Task task;
  std::vector<Polygon> polygons;
  bool is_reachable = true;
};

// All obstacles are convex, so the free space of the robot's centre is in one piece: the goal can be
// reached unless it lies in a grown obstacle. Goals in between are not drawn.
WideWorld MakeWorld(std::uint32_t seed) {
  std::mt19937 engine(seed);
  const auto between = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(engine()) / 4294967296.0;
  };
  const auto place = [&] {
    const double x = between(-kHalfArena, kHalfArena);
    return Point2{x, between(-kHalfArena, kHalfArena)};
  };
  WideWorld wide;
  for (int attempt = 0; attempt < 40; ++attempt) {
    Polygon polygon =
        between(0, 1) < 0.6 ? Box(0, 0, between(0.1, 2.5), between(0.3, 2.5)) : Cylinder(0, 0, between(0.1, 1.0));
    const Point2 middle = place();
    const double angle = between(-kPi, kPi);
    for (Point2& corner : polygon) corner = ToWorld({middle.x, middle.y, angle}, corner);
    bool is_apart = true;
    for (const Polygon& other : wide.polygons) {
      is_apart = is_apart && DistanceBetween(polygon, other) > kGap && DistanceBetween(other, polygon) > kGap &&
                 !Contains(other, polygon[0]) && !Contains(polygon, other[0]);
    }
    if (is_apart) wide.polygons.push_back(polygon);
  }
  wide.task.world = World(wide.polygons);
  const auto is_inside = [&](Point2 point) {
    return std::any_of(wide.polygons.begin(), wide.polygons.end(),
                       [&](const Polygon& polygon) { return Contains(polygon, point); });
  };
  do {
    wide.task.start = place();
  } while (wide.task.world.Clearance(wide.task.start) < kSafeDistance + 0.05 || is_inside(wide.task.start));
  double clearance = 0.0;
  do {
    wide.task.goal = place();
    clearance = wide.task.world.Clearance(wide.task.goal);
    wide.is_reachable = clearance > kSafeDistance + 0.05 && !is_inside(wide.task.goal);
  } while (Distance(wide.task.start, wide.task.goal) < 3.0 ||
           (!wide.is_reachable && !is_inside(wide.task.goal) && clearance > 0.15) ||
           (is_inside(wide.task.goal) && clearance < 0.02));
  wide.task.heading = between(-kPi, kPi);
  return wide;
}

/// Of the obstacle that the point lies beside.
const Polygon& PolygonAt(const WideWorld& wide, Point2 point) {
  const Polygon* nearest = &wide.polygons.front();
  for (const Polygon& polygon : wide.polygons) {
    if (World({polygon}).Clearance(point) < World({*nearest}).Clearance(point)) nearest = &polygon;
  }
  return *nearest;
}

/// How often the line from start to goal crosses the boundary of the polygon grown.
int Crossings(const Task& task, const Polygon& polygon) {
  // Convex: the line goes in and out, or only in if it ends there.
  return World({polygon}).Clearance(task.goal) < kSafeDistance || Contains(polygon, task.goal) ? 1 : 2;
}

/// m, from the start on, of an ideal point that meets these obstacles; nothing if the authors of the
/// variant have given no bound.
std::optional<double> Bound(std::string_view variant, const WideWorld& wide, const PointHistory& hits) {
  const std::array<std::string_view, 4> bounded = {"bug1", "bug2", "alg1", "alg2"};
  if (std::find(bounded.begin(), bounded.end(), variant) == bounded.end()) return std::nullopt;
  double bound = Distance(wide.task.start, wide.task.goal);
  std::vector<const Polygon*> met;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    const Polygon* polygon = &PolygonAt(wide, hits[i]);
    if (std::find(met.begin(), met.end(), polygon) != met.end()) continue;
    met.push_back(polygon);
    const double perimeter = Perimeter(*polygon) + 2 * kPi * kSafeDistance;
    if (variant == "bug1") {
      bound += 1.5 * perimeter;
    } else if (variant == "bug2") {
      // A fruitless lap of a goal inside is a whole one.
      bound += std::max(Crossings(wide.task, *polygon) / 2.0, 1.0) * perimeter;
    } else {
      bound += 2 * perimeter;
    }
  }
  return bound;
}

class WideWorlds : public testing::TestWithParam<std::tuple<BugVariant, Sensor>> {};

int WideWorldCount() {
  const char* wanted = std::getenv("RUNNEL_WORLDS");
  return wanted == nullptr ? 10 : std::stoi(wanted);
}

TEST_P(WideWorlds, EndRightlyWithinTheBound) {
  const auto& [variant, sensor] = GetParam();
  const double tolerance = sensor == Sensor::kLaser ? kLaserTolerance : kInfraredTolerance;
  for (int i = 0; i < WideWorldCount(); ++i) {
    // Other worlds for every variant.
    const auto seed = static_cast<std::uint32_t>(1 + i + 1000 * static_cast<int>(VariantIndex(variant.name)));
    SCOPED_TRACE("world " + std::to_string(seed));
    const WideWorld wide = MakeWorld(seed);
    const auto direction = seed % 2 == 0 ? BoundaryDirection::kLeft : BoundaryDirection::kRight;
    const Outcome outcome = Drive(variant.name, direction, sensor, wide.task, "wide" + std::to_string(seed));
    EXPECT_EQ(int(outcome.status.mode), int(wide.is_reachable ? PlannerMode::kReached : PlannerMode::kUnreachable));
    EXPECT_GT(outcome.least_clearance, sensor == Sensor::kLaser ? 0.25 : Robot::kRadius + 0.02);
    // With rangers of narrow view the robot goes round the other way, too, before it gives up.
    const double ways = sensor == Sensor::kInfrared && !wide.is_reachable ? 2.0 : 1.0;
    if (const auto bound = Bound(variant.name, wide, outcome.hits)) {
      EXPECT_LT(outcome.status.path_length, (1 + kMarginPerMetre) * ways * *bound + kMargin);
    }
    for (std::size_t hit = 0; hit < outcome.hits.size(); ++hit) {
      EXPECT_NEAR(wide.task.world.Clearance(outcome.hits[hit]), kSafeDistance, tolerance) << "hit";
    }
    for (std::size_t leave = 0; leave < outcome.leaves.size(); ++leave) {
      EXPECT_NEAR(wide.task.world.Clearance(outcome.leaves[leave]), kSafeDistance, tolerance);
    }
  }
}

std::string NameOfWide(const testing::TestParamInfo<WideWorlds::ParamType>& param) {
  const auto& [variant, sensor] = param.param;
  return std::string(variant.name) + (sensor == Sensor::kLaser ? "Laser" : "Infrared");
}

INSTANTIATE_TEST_SUITE_P(All, WideWorlds,
                         testing::Combine(testing::ValuesIn(VariantsThatEnd()),
                                          testing::Values(Sensor::kLaser, Sensor::kInfrared)),
                         NameOfWide);

}  // namespace
}  // namespace runnel
