#include <gmock/gmock.h>

#include "modules/simulation/sensors.h"
#include "plugins/testing/guards.h"
#include "plugins/testing/module_rig.h"
#include "tests/modules/simulation/simulation_fixture.h"

namespace runnel {
namespace {

using test::SceneWithAWall;

struct CameraTest : testing::Test {
  void SetUp() override {
    ASSERT_TRUE(rig.module.width.SetFromText("40"));
    ASSERT_TRUE(rig.module.height.SetFromText("30"));
    ASSERT_TRUE(rig.Prepare());
    rig.Feed(rig.module.scene, SceneWithAWall());
  }
  void See(const Pose2& pose) {
    rig.Feed(rig.module.pose, pose);
    rig.RunCycle();
  }
  /// How many pixels of the middle column are neither sky nor ground.
  static int WallRows(const Image& image) {
    int rows = 0;
    for (std::uint32_t row = 0; row < image.height; ++row) {
      const std::uint8_t red = image.data[row * image.row_stride + 3 * (image.width / 2)];
      if (red < 180) ++rows;
    }
    return rows;
  }
  test::ModuleRig<Camera> rig;
};

TEST_F(CameraTest, TakesPicturesOnlyWhileSomebodyLooks) {
  See({0, 0, 0});
  EXPECT_EQ(rig.module.image.publications(), 0u);
  rig.module.image.NoteLook();
  See({0.1, 0, 0});
  EXPECT_EQ(rig.module.image.publications(), 1u);
  See({0.2, 0, 0});
  EXPECT_EQ(rig.module.image.publications(), 1u) << "nobody has looked since";
}

TEST_F(CameraTest, AWallIsLargerFromNearAndOutOfSightBehind) {
  const auto rows = [&](const Pose2& pose) {
    rig.module.image.NoteLook();
    See(pose);
    return WallRows(rig.Last(rig.module.image));
  };
  const int far = rows({-2, 0, 0});
  const int near = rows({0.5, 0, 0});
  EXPECT_GT(far, 0);
  EXPECT_GT(near, far);
  EXPECT_EQ(rows({-2, 0, kPi}), 0);
  const Image image = rig.Last(rig.module.image);
  EXPECT_EQ(image.encoding, "rgb8");
  EXPECT_EQ(image.row_stride, 120u);
  EXPECT_EQ(image.data.size(), 3600u);
}

TEST_F(CameraTest, AllocatesNothingAfterwards) {
  if (!test::AllocationGuard::works()) GTEST_SKIP() << "sanitizers have a malloc of their own";
  rig.module.image.NoteLook();
  See({});
  for (int i = 1; i < 4; ++i) {
    rig.Feed(rig.module.pose, {0.1 * i, 0, 0});
    rig.module.image.NoteLook();
    const auto tasks = rig.module.FindAnnotation<Executable>()->tasks();
    const CycleScope cycle({});
    const test::AllocationGuard guard;
    for (const Task& task : tasks) task.run();
    EXPECT_EQ(guard.allocations(), 0u) << i;
  }
}

}  // namespace
}  // namespace runnel
