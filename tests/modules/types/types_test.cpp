#include <limits>

#include <gtest/gtest.h>

#include "modules/types/drawing.h"
#include "modules/types/measurements.h"
#include "modules/types/planner_status.h"
#include "modules/types/pose.h"

namespace runnel {
namespace {

template <typename T>
void ExpectReadsBack(const T& value) {
  const auto from_text = FromText<T>(TextOf(value));
  ASSERT_TRUE(from_text) << TextOf(value);
  EXPECT_EQ(*from_text, value) << TextOf(value);
}

TEST(ModuleTypes, ReadBackFromText) {
  ExpectReadsBack(Point2{0.1, -2});
  ExpectReadsBack(Pose2{1, 2, 3.1});
  ExpectReadsBack(Twist2{0.5, -1.5});
  ExpectReadsBack(WheelSpeeds{3, 4});
  ExpectReadsBack(RangeScan{-1.5, 0.1, 0.02, 4, {0.5f, std::numeric_limits<float>::infinity(), 3.25f}});
  ExpectReadsBack(InfraredRanges{1, std::numeric_limits<double>::infinity(), 2, 2, 0.45});
  ExpectReadsBack(Contact{true, -0.7});
  ExpectReadsBack(HitAndLeavePoints{{{1, 2}, {3, 4}}, {{5, 6}}});
  ExpectReadsBack(Path2{{{1, 2}, {3, 4}}});
  ExpectReadsBack(Image{2, 1, "rgb8", 6, {1, 2, 3, 255, 0, 4}});
  ExpectReadsBack(WorldMap{"a", {1, 2, 3}, {4, 5}, {{{{0, 0}, {1, 0}, {0, 1}}, 0.5, true}}, {{7, 7}}});
  ExpectReadsBack(std::vector<Pose2>{{1, 2, 3}, {4, 5, 6}});
}

TEST(ModuleTypes, ReadAsAPersonWouldWriteThem) {
  EXPECT_EQ(TextOf(Pose2{1, 2, 0.5}), "{x: 1, y: 2, heading: 0.5}");
  EXPECT_EQ(TypeOf<Twist2>().FindField("turn")->unit, "rad/s");
}

// core/types/README.md promises these fields to viewers.
TEST(ModuleTypes, HaveTheFieldsThatTheirTagsPromise) {
  const auto expect = [](const TypeInfo& type, const std::string& meaning, std::initializer_list<const char*> fields) {
    EXPECT_EQ(type.semantic_tag(), meaning) << type.name();
    for (const char* field : fields) {
      EXPECT_NE(type.FindField(field), nullptr) << type.name() << "." << field;
    }
  };
  expect(TypeOf<Point2>(), "point", {"x", "y"});
  expect(TypeOf<Pose2>(), "pose", {"x", "y", "heading"});
  expect(TypeOf<Twist2>(), "twist", {"forward", "turn"});
  expect(TypeOf<RangeScan>(), "range_scan", {"start_angle", "angle_step", "range_minimum", "range_maximum", "ranges"});
  expect(TypeOf<Contact>(), "contact", {"is_touching", "bearing"});
  expect(TypeOf<Path2>(), "path", {"points"});
  expect(TypeOf<HitAndLeavePoints>(), "hit_and_leave_points", {"hits", "leaves"});
  expect(TypeOf<WorldMap>(), "world_map", {"name", "start", "goal", "outlines", "bounds"});
  expect(TypeOf<MapOutline>(), "", {"points", "height", "is_hole"});
  expect(TypeOf<Image>(), "image", {"width", "height", "encoding", "row_stride", "data"});
  expect(TypeOf<WheelSpeeds>(), "", {});
}

}  // namespace
}  // namespace runnel
