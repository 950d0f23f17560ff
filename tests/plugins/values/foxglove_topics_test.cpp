#include <gtest/gtest.h>

#include "core/element/runtime.h"
#include "core/module/group.h"
#include "core/module/module.h"
#include "core/port/input.h"
#include "core/port/output.h"
#include "core/port/proxy_port.h"
#include "modules/types/pose.h"
#include "plugins/values/foxglove_channel.h"

namespace runnel {
namespace {

class Body final : public Module {
 public:
  using Module::Module;
  Output<Pose2> pose{this, "pose"};
  Input<Pose2> other{this, "other"};
  Output<Point2> goal{this, "goal"};

 private:
  void Update() override {}
};

class FoxgloveTopics : public testing::Test {
 protected:
  Runtime runtime;
  Group& application = runtime.Create<Group>(runtime.root(), "application");
  Group& robot = runtime.Create<Group>(application, "robot");
  Body& first = runtime.Create<Body>(robot, "first");
  Body& second = runtime.Create<Body>(robot, "second");
  Body& third = runtime.Create<Body>(robot, "third");
};

TEST_F(FoxgloveTopics, ArePathsWithoutWhatGoesWithoutSaying) {
  EXPECT_EQ(first.pose.path(), "/application/robot/first/output/pose");
  EXPECT_EQ(TopicOf(first.pose), "/robot/first/pose");
  EXPECT_EQ(TopicOf(first.other), "/robot/first/other");
  EXPECT_EQ(TopicOf(robot), "/robot");
  EXPECT_EQ(TopicOf(application), "/application");
}

TEST_F(FoxgloveTopics, TheRobotIsWhereMostReadersBelieve) {
  const Port* const ports[] = {&first.goal, &first.pose, &second.pose, &first.other};
  EXPECT_EQ(RobotPose(ports), &first.pose) << "nobody reads any";
  ASSERT_TRUE(Port::Connect(first.pose, second.other));
  ASSERT_TRUE(Port::Connect(second.pose, first.other));
  EXPECT_EQ(RobotPose(ports), &first.pose);
  ASSERT_TRUE(Port::Connect(second.pose, third.other));
  EXPECT_EQ(RobotPose(ports), &second.pose);
  EXPECT_EQ(RobotPose({}), nullptr);
}

}  // namespace
}  // namespace runnel
