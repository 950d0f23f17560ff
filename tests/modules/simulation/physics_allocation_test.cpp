#include <cstdlib>

#include <LinearMath/btAlignedAllocator.h>
#include <gtest/gtest.h>

#include "modules/simulation/algorithm/physics_world.h"
#include "modules/simulation/algorithm/world_geometry.h"
#include "modules/types/algorithm/angle.h"

namespace runnel {
namespace {

int allocations = 0;

void* CountingMalloc(std::size_t size) {
  ++allocations;
  return std::malloc(size);
}

World RoomWithAPillar() {
  return {.boxes = {{.pose = {0.5, 0, 0}, .length = 0.3, .width = 0.3}},
          .cylinders = {{.centre = {0.6, 0.3}, .radius = 0.1}},
          .walls = {{.points = {{-0.5, -1}, {-0.5, 1}, {0, 1}}, .thickness = 0.1}},
          .bounds = Ring{{-1, -1}, {1, -1}, {1.5, 1}, {-1, 1}}};
}

TEST(PhysicsWorld, AllocatesInItsConstructorOnly) {
  btAlignedAllocSetCustom(CountingMalloc, std::free);
  PhysicsWorld world(RoomWithAPillar());
  EXPECT_GT(allocations, 0);
  const int after_construction = allocations;
  int touches = 0;
  for (int i = 0; i < 2000; ++i) {
    world.SetWheelSpeeds(i % 100 < 60 ? WheelSpeeds{8, 10} : WheelSpeeds{-9, -6});
    world.Advance(0.05);
    touches += world.contact().is_touching ? 1 : 0;
  }
  EXPECT_GT(touches, 100);
  EXPECT_EQ(allocations, after_construction);
}

}  // namespace
}  // namespace runnel
