// Infrared in passages of 0.9 m: the arcs that stand for far echoes reach across them.

#include <gmock/gmock.h>

#include "tests/modules/planning/drive.h"

namespace runnel {
namespace {

using namespace testing_world;

constexpr double kPitch = 8.0 / 7;  // m
constexpr double kWall = 0.2;       // m, thick

// What `runnel world --kind maze --seed 102 --width 8 --height 8 --gap 0.9` makes, but for the round
// ends of its walls.
Task Maze() {
  struct Wall {
    double column, row, columns, rows;  // in cells from the middle: its centre, and how far it goes
  };
  constexpr Wall kWalls[] = {
      {-2.5, 1.0, 0, 3}, {-1.5, -1.0, 0, 1}, {-1.5, 1.0, 0, 1}, {-0.5, -2.0, 0, 3},
      {-0.5, 1.5, 0, 2}, {0.5, 0.0, 0, 1},   {0.5, 3.0, 0, 1},  {1.5, -1.0, 0, 1},
      {1.5, 1.5, 0, 2},  {2.5, -2.0, 0, 1},  {2.5, 0.0, 0, 1},  {-1.5, -2.5, 2, 0},
      {1.5, -2.5, 2, 0}, {-2.5, -1.5, 2, 0}, {0.0, -1.5, 1, 0}, {2.0, -1.5, 1, 0},
      {1.0, -0.5, 1, 0}, {0.0, 0.5, 1, 0},   {2.0, 0.5, 1, 0},  {-1.0, 1.5, 1, 0},
      {1.0, 1.5, 1, 0},  {3.0, 1.5, 1, 0},   {-2.0, 2.5, 1, 0}, {2.0, 2.5, 1, 0},
  };
  World world({Box(0, 0, 7 * kPitch, 7 * kPitch)});
  for (const Wall& wall : kWalls) {
    world.Add(Box(kPitch * wall.column, kPitch * wall.row, kPitch * wall.columns + kWall,
                  kPitch * wall.rows + kWall));
  }
  return {world, {-3 * kPitch, -2 * kPitch}, {3 * kPitch, 2 * kPitch}};
}

TEST(InfraredInAMaze, PassesWhereAFarEchoMayHaveBeen) {
  const Outcome outcome = Drive("rev1", BoundaryDirection::kLeft, Sensor::kInfrared, Maze());
  EXPECT_EQ(int(outcome.status.mode), int(PlannerMode::kReached));
  EXPECT_GT(outcome.least_clearance, Robot::kRadius + 0.02);
}

}  // namespace
}  // namespace runnel
