#include <limits>

#include <gtest/gtest.h>

#include "plugins/parameters/parameter_base.h"

namespace runnel {
namespace {

TEST(Bounds, ContainTheirEnds) {
  const Bounds<double> bounds{0.05, 5.0};
  EXPECT_TRUE(bounds.Contain(0.05));
  EXPECT_TRUE(bounds.Contain(5.0));
  EXPECT_FALSE(bounds.Contain(0.049));
  EXPECT_FALSE(bounds.Contain(5.001));
}

TEST(Bounds, MayBeOpenAtEitherEnd) {
  EXPECT_TRUE(Bounds<int>{.lowest = 0}.Contain(std::numeric_limits<int>::max()));
  EXPECT_FALSE(Bounds<int>{.lowest = 0}.Contain(-1));
  EXPECT_TRUE(Bounds<int>{.highest = 0}.Contain(std::numeric_limits<int>::min()));
  EXPECT_FALSE(Bounds<int>{.highest = 0}.Contain(1));
  EXPECT_TRUE(Bounds<int>{}.Contain(17));
  EXPECT_TRUE(Bounds<int>{}.empty());
}

TEST(Bounds, NeverContainWhatIsNoNumber) {
  const double not_a_number = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE((Bounds<double>{.lowest = 0.0}.Contain(not_a_number)));
  EXPECT_FALSE((Bounds<double>{.highest = 0.0}.Contain(not_a_number)));
}

}  // namespace
}  // namespace runnel
