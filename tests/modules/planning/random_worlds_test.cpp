#include <cstdint>
#include <random>
#include <string>
#include <tuple>

#include <gmock/gmock.h>

#include "tests/modules/planning/drive.h"
#include "tests/modules/planning/variant_index.h"

namespace runnel {
namespace {

using namespace testing_world;

constexpr double kJudgedHalf = 4.0;  // m
constexpr double kCell = 0.05;       // m

/// Whether the goal can be reached at all, by flooding a grid: an independent judge.
class Judge {
 public:
  Judge(const World& world, Point2 start, Point2 goal, double radius) : goal_(goal) {
    const int cells = static_cast<int>(2 * kReach / kCell);
    std::vector<char> blocked(static_cast<std::size_t>(cells * cells));
    const auto centre = [&](int i) { return -kReach + (i + 0.5) * kCell; };
    for (int i = 0; i < cells * cells; ++i) {
      blocked[static_cast<std::size_t>(i)] = world.Clearance({centre(i % cells), centre(i / cells)}) < radius;
    }
    std::vector<int> open = {static_cast<int>((start.y + kReach) / kCell) * cells +
                             static_cast<int>((start.x + kReach) / kCell)};
    while (!open.empty()) {
      const int cell = open.back();
      open.pop_back();
      const int x = cell % cells, y = cell / cells;
      if (x < 0 || y < 0 || x >= cells || y >= cells || blocked[static_cast<std::size_t>(cell)]) {
        continue;
      }
      blocked[static_cast<std::size_t>(cell)] = 1;
      nearest_ = std::min(nearest_, Distance(goal_, {centre(x), centre(y)}));
      if (x > 0) open.push_back(cell - 1);
      if (x + 1 < cells) open.push_back(cell + 1);
      if (y > 0) open.push_back(cell - cells);
      if (y + 1 < cells) open.push_back(cell + cells);
    }
  }
  /// m, how near to the goal a disc of the radius can come.
  [[nodiscard]] double nearest() const { return nearest_; }

 private:
  static constexpr double kReach = kJudgedHalf + 2.0;
  Point2 goal_;
  double nearest_ = std::numeric_limits<double>::infinity();
};

class Dice {
 public:
  explicit Dice(std::uint32_t seed) : engine_(seed) {}
  double Between(double low, double high) { return low + (high - low) * static_cast<double>(engine_()) / 4294967296.0; }
  Point2 Place() {
    const double x = Between(-kJudgedHalf, kJudgedHalf);
    return {x, Between(-kJudgedHalf, kJudgedHalf)};
  }

 private:
  std::mt19937 engine_;
};

Polygon Placed(Polygon polygon, double angle, Point2 place) {
  for (Point2& point : polygon) point = ToWorld({place.x, place.y, angle}, point);
  return polygon;
}

Polygon RandomPolygon(Dice& dice) {
  const double kind = dice.Between(0, 4);
  const Point2 place = dice.Place();
  const double angle = dice.Between(-kPi, kPi);
  const double a = dice.Between(0.3, 2.0), b = dice.Between(0.3, 2.0);
  if (kind < 1) return Placed(Box(0, 0, a, b), angle, place);
  if (kind < 2) return Placed(Box(0, 0, 0.1, 1.5 * a), angle, place);
  if (kind < 3) return Placed(Cylinder(0, 0, a / 2), angle, place);
  return Placed({{0, 0}, {a + 0.5, 0}, {a + 0.5, 0.15}, {0.15, 0.15}, {0.15, b}, {0, b}}, angle, place);
}

struct RandomTask {
  Task task;
  double surely = 0.0;    ///< m to the goal that a wider disc can come
  double possibly = 0.0;  ///< m to the goal that a narrower disc can come
};

/// With infrared a passage must be wider, or its vague echoes close it now and then.
constexpr double kSurelyWithLaser = 0.40;     // m, radius of a disc that passes
constexpr double kSurelyWithInfrared = 0.50;  // m

RandomTask MakeTask(std::uint32_t seed, double sure_radius) {
  Dice dice(seed);
  RandomTask random;
  const int polygons = 3 + static_cast<int>(dice.Between(0, 9));
  for (int i = 0; i < polygons; ++i) random.task.world.Add(RandomPolygon(dice));
  do {
    random.task.start = dice.Place();
  } while (random.task.world.Clearance(random.task.start) < 0.4);
  do {
    random.task.goal = dice.Place();
  } while (Distance(random.task.start, random.task.goal) < 2.0);
  random.task.heading = dice.Between(-kPi, kPi);
  random.surely = Judge(random.task.world, random.task.start, random.task.goal, sure_radius).nearest();
  random.possibly = Judge(random.task.world, random.task.start, random.task.goal, 0.27).nearest();
  return random;
}

int JudgedWorlds() {
  const char* wanted = std::getenv("RUNNEL_WORLDS");
  return wanted == nullptr ? 6 : std::stoi(wanted);
}

class RandomWorlds : public testing::TestWithParam<std::tuple<BugVariant, Sensor>> {};

TEST_P(RandomWorlds, GiveTheVerdictOfAnIndependentJudge) {
  const auto& [variant, sensor] = GetParam();
  // Other worlds for every variant.
  const int first = 1 + 1000 * static_cast<int>(VariantIndex(variant.name));
  for (int seed = first; seed < first + JudgedWorlds(); ++seed) {
    const RandomTask random =
        MakeTask(static_cast<std::uint32_t>(seed), sensor == Sensor::kLaser ? kSurelyWithLaser : kSurelyWithInfrared);
    const auto direction = seed % 2 == 0 ? BoundaryDirection::kLeft : BoundaryDirection::kRight;
    SCOPED_TRACE("world " + std::to_string(seed) + ", surely to " + std::to_string(random.surely) + " m, possibly to " +
                 std::to_string(random.possibly) + " m");
    const Outcome outcome = Drive(variant.name, direction, sensor, random.task, "world" + std::to_string(seed));
    EXPECT_GT(outcome.least_clearance, sensor == Sensor::kLaser ? 0.25 : Robot::kRadius + 0.02);
    const PlannerMode verdict = outcome.status.mode;
    EXPECT_THAT(verdict, testing::AnyOf(PlannerMode::kReached, PlannerMode::kUnreachable));
    if (random.surely < kCell) {
      EXPECT_EQ(int(verdict), int(PlannerMode::kReached));
    }
    if (random.possibly > 0.15) {
      EXPECT_EQ(int(verdict), int(PlannerMode::kUnreachable));
    }
  }
}

std::string NameOfJudged(const testing::TestParamInfo<RandomWorlds::ParamType>& param) {
  const auto [variant, sensor] = param.param;
  return std::string(variant.name) + (sensor == Sensor::kLaser ? "Laser" : "Infrared");
}

INSTANTIATE_TEST_SUITE_P(All, RandomWorlds,
                         testing::Combine(testing::ValuesIn(VariantsThatEnd()),
                                          testing::Values(Sensor::kLaser, Sensor::kInfrared)),
                         NameOfJudged);

}  // namespace
}  // namespace runnel
