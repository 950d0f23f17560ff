// Infrared in passages of 0.9 m: the arcs that stand for far echoes reach across them.

#include <gmock/gmock.h>

#include "tests/modules/planning/drive.h"

namespace runnel {
namespace {

using namespace testing_world;

constexpr double kPitch = 8.0 / 7;  // m
constexpr double kWall = 0.2;       // m, thick

struct Wall {
  double column, row, columns, rows;  // in cells from the middle: its centre, and how far it goes
};

World Maze(std::initializer_list<Wall> walls) {
  World world({Box(0, 0, 7 * kPitch, 7 * kPitch)});
  for (const Wall& wall : walls) {
    world.Add(Box(kPitch * wall.column, kPitch * wall.row, kPitch * wall.columns + kWall, kPitch * wall.rows + kWall));
  }
  return world;
}

// What `runnel world --kind maze --seed 102 --width 8 --height 8 --gap 0.9` makes, but for the round
// ends of its walls.
Task Maze102() {
  return {Maze({{-2.5, 1.0, 0, 3}, {-1.5, -1.0, 0, 1}, {-1.5, 1.0, 0, 1}, {-0.5, -2.0, 0, 3}, {-0.5, 1.5, 0, 2},
                {0.5, 0.0, 0, 1},  {0.5, 3.0, 0, 1},   {1.5, -1.0, 0, 1}, {1.5, 1.5, 0, 2},   {2.5, -2.0, 0, 1},
                {2.5, 0.0, 0, 1},  {-1.5, -2.5, 2, 0}, {1.5, -2.5, 2, 0}, {-2.5, -1.5, 2, 0}, {0.0, -1.5, 1, 0},
                {2.0, -1.5, 1, 0}, {1.0, -0.5, 1, 0},  {0.0, 0.5, 1, 0},  {2.0, 0.5, 1, 0},   {-1.0, 1.5, 1, 0},
                {1.0, 1.5, 1, 0},  {3.0, 1.5, 1, 0},   {-2.0, 2.5, 1, 0}, {2.0, 2.5, 1, 0}}),
          {-3 * kPitch, -2 * kPitch},
          {3 * kPitch, 2 * kPitch}};
}

// The same with seed 304.
Task Maze304() {
  return {Maze({{-2.5, -1.0, 0, 1},
                {-2.5, 1.5, 0, 2},
                {-1.5, -2.0, 0, 3},
                {-1.5, 3.0, 0, 1},
                {-0.5, -1.0, 0, 3},
                {-0.5, 2.0, 0, 1},
                {0.5, -0.5, 0, 4},
                {1.5, 0.0, 0, 1},
                {2.5, 1.5, 0, 2},
                {-3.0, -2.5, 1, 0},
                {1.5, -2.5, 2, 0},
                {2.0, -1.5, 3, 0},
                {-2.0, -0.5, 1, 0},
                {2.5, -0.5, 2, 0},
                {-1.5, 0.5, 2, 0},
                {0.5, 1.5, 4, 0},
                {1.0, 2.5, 1, 0}}),
          {-3 * kPitch, -1 * kPitch},
          {3 * kPitch, -2 * kPitch}};
}

TEST(InfraredInAMaze, PassesWhereAFarEchoMayHaveBeen) {
  const Outcome outcome = Drive("rev1", BoundaryDirection::kLeft, Sensor::kInfrared, Maze102());
  EXPECT_EQ(int(outcome.status.mode), int(PlannerMode::kReached));
  EXPECT_GT(outcome.least_clearance, Robot::kRadius + 0.02);
}

// An echo from afar may have closed a passage; from the other side it does not. So a goal behind a wall that
// has none is given up after two laps.
TEST(InfraredInAMaze, TangentBugGoesRoundTheOtherWayBeforeItGivesUp) {
  const World world({Box(0, 0, 3, 3), Box(0, 0, 2.8, 2.8)});
  const auto drive = [&](Sensor sensor) {
    return Drive("tangent_bug", BoundaryDirection::kLeft, sensor, {world, {-4, 0}, {-0.9, 0}});
  };
  const Outcome seen = drive(Sensor::kLaser), felt = drive(Sensor::kInfrared);
  EXPECT_EQ(int(seen.status.mode), int(PlannerMode::kUnreachable));
  EXPECT_EQ(int(felt.status.mode), int(PlannerMode::kUnreachable));
  EXPECT_GT(felt.status.path_length, 1.7 * seen.status.path_length);
}

// Where no point has a way of DistBug's step behind it, it leaves as Bug1 does.
TEST(DistBugInAMaze, ReachesAGoalBehindPassagesNarrowerThanItsStep) {
  for (const Sensor sensor : {Sensor::kLaser, Sensor::kInfrared}) {
    for (const auto direction : {BoundaryDirection::kLeft, BoundaryDirection::kRight}) {
      const Outcome outcome = Drive("dist_bug", direction, sensor, Maze304());
      EXPECT_EQ(int(outcome.status.mode), int(PlannerMode::kReached));
      EXPECT_GT(outcome.least_clearance, Robot::kRadius + 0.02);
    }
  }
}

}  // namespace
}  // namespace runnel
