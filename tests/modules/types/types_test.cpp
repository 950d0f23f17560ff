#include <limits>

#include <gtest/gtest.h>

#include "core/types/binary_form.h"
#include "modules/types/contact.h"
#include "modules/types/hit_and_leave_points.h"
#include "modules/types/infrared_ranges.h"
#include "modules/types/pose.h"
#include "modules/types/range_scan.h"
#include "modules/types/wheel_speeds.h"

namespace runnel {
namespace {

template <typename T>
void ExpectBothFormsReadBack(const T& value) {
  const auto from_text = FromText<T>(TextOf(value));
  ASSERT_TRUE(from_text) << TextOf(value);
  EXPECT_EQ(*from_text, value) << TextOf(value);

  std::vector<std::byte> bytes;
  ASSERT_TRUE(ToBinary(TypeOf<T>(), &value, bytes));
  BinaryReader reader(bytes);
  T read;
  ASSERT_TRUE(FromBinary(TypeOf<T>(), reader, &read));
  EXPECT_EQ(read, value);
}

TEST(ModuleTypes, ReadBackFromTextAndBytes) {
  ExpectBothFormsReadBack(Point2{0.1, -2});
  ExpectBothFormsReadBack(Pose2{1, 2, 3.1});
  ExpectBothFormsReadBack(Twist2{0.5, -1.5});
  ExpectBothFormsReadBack(WheelSpeeds{3, 4});
  ExpectBothFormsReadBack(
      RangeScan{-1.5, 0.1, 0.02, 4, {0.5f, std::numeric_limits<float>::infinity(), 3.25f}});
  ExpectBothFormsReadBack(InfraredRanges{1, std::numeric_limits<double>::infinity(), 2, 2, 0.45});
  ExpectBothFormsReadBack(Contact{true, -0.7});
  ExpectBothFormsReadBack(HitAndLeavePoints{{{1, 2}, {3, 4}}, {{5, 6}}});
  ExpectBothFormsReadBack(std::vector<Pose2>{{1, 2, 3}, {4, 5, 6}});
}

TEST(ModuleTypes, ReadAsAPersonWouldWriteThem) {
  EXPECT_EQ(TextOf(Pose2{1, 2, 0.5}), "{x: 1, y: 2, heading: 0.5}");
  EXPECT_EQ(TypeOf<Twist2>().FindField("turn")->unit, "rad/s");
}

}  // namespace
}  // namespace runnel
