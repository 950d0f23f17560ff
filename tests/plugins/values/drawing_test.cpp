#include "modules/types/drawing.h"

#include <gmock/gmock.h>

#include "core/element/runtime.h"
#include "core/lockfree/thread_epoch.h"
#include "core/module/group.h"
#include "core/port/input.h"
#include "core/port/output.h"
#include "plugins/values/foxglove_channel.h"
#include "plugins/values/watched_port.h"

namespace runnel {
namespace {

using ::testing::HasSubstr;
using ::testing::SizeIs;

Drawing Sketch() {
  Drawing drawing{"robot", {}};
  drawing.AddPoints({{1, 2}}, {.red = 1}, 0.1);
  drawing.AddLine({{0, 0}, {1, 0}}, {.green = 1, .alpha = 0.5});
  drawing.items.push_back({DrawnKind::kClosedLine, {{0, 0}, {1, 0}, {0, 1}}, {.blue = 1}, 0.02, {}});
  drawing.AddText({3, 4}, "near", {});
  return drawing;
}

std::string Scene(const Drawing& drawing) {
  const auto channels = ChannelsFor(TypeOf<Drawing>(), "/a/out");
  EXPECT_THAT(channels, SizeIs(2));
  EXPECT_EQ(channels[1].schema_name, "foxglove.SceneUpdate");
  std::string json;
  channels[1].append(&drawing, Time{}, json);
  return json;
}

TEST(DrawingTest, IsASceneForFoxglove) {
  const std::string json = Scene(Sketch());
  EXPECT_THAT(json, HasSubstr(R"("frame_id":"robot","id":"drawing")"));
  EXPECT_THAT(json, HasSubstr(R"("size":{"x":0.1,"y":0.1,"z":0.1},"color":{"r":1,"g":0,"b":0,"a":1})"));
  EXPECT_THAT(json, HasSubstr(R"({"type":0,)"));
  EXPECT_THAT(json, HasSubstr(R"({"type":1,)"));
  EXPECT_THAT(json, HasSubstr(R"("color":{"r":0,"g":1,"b":0,"a":0.5})"));
  EXPECT_THAT(json, HasSubstr(R"("text":"near")"));
}

TEST(DrawingTest, IsInTheWorldIfNothingElseIsSaid) {
  EXPECT_THAT(Scene({}), HasSubstr(R"("frame_id":"world")"));
  EXPECT_THAT(Scene({"map", {}}), HasSubstr(R"("frame_id":"map")"));
}

TEST(DrawingTest, IsAskedForOnlyWhileSomebodyLooks) {
  Runtime runtime;
  auto& group = runtime.Create<Group>(runtime.root(), "a");
  Output<Drawing> out(group, "out");
  EXPECT_FALSE(out.is_watched());
  WatchedPort watched("/a/out");
  const EpochGuard guard;
  {
    const std::lock_guard lock(runtime.structure_mutex());
    ASSERT_TRUE(watched.Find(runtime));
  }
  EXPECT_FALSE(watched.VisitIfNew([](const void*, ValueTimes) {}));
  EXPECT_TRUE(out.is_watched()) << "somebody has looked, and found nothing";
  out.Publish(Sketch());
  EXPECT_FALSE(out.is_watched()) << "nobody has looked since";
  EXPECT_TRUE(watched.VisitIfNew([](const void*, ValueTimes) {}));
  EXPECT_TRUE(out.is_watched());
}

TEST(DrawingTest, AConnectionLooksAllTheTime) {
  Runtime runtime;
  auto& group = runtime.Create<Group>(runtime.root(), "a");
  Output<Drawing> out(group, "out");
  Input<Drawing> in(group, "in");
  ASSERT_TRUE(Port::Connect(out, in));
  EXPECT_TRUE(out.is_watched());
  EXPECT_TRUE(out.is_watched());
  ASSERT_TRUE(Port::Disconnect(out, in));
  EXPECT_FALSE(out.is_watched());
}

}  // namespace
}  // namespace runnel
