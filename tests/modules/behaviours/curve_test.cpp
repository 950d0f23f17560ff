#include "modules/behaviours/algorithm/curve.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace runnel {
namespace {

TEST(CurveTest, RisesAndFalls) {
  const Curve rise{.start = 1, .end = 3};
  EXPECT_EQ(ValueAt(rise, 0.5), 0.0);
  EXPECT_EQ(ValueAt(rise, 1), 0.0);
  EXPECT_DOUBLE_EQ(ValueAt(rise, 2), 0.5);
  EXPECT_EQ(ValueAt(rise, 3), 1.0);
  EXPECT_EQ(ValueAt(rise, 100), 1.0);
  Curve fall = rise;
  fall.kind = CurveKind::kFall;
  EXPECT_EQ(ValueAt(fall, 0), 1.0);
  EXPECT_EQ(ValueAt(fall, 3), 0.0);
}

TEST(CurveTest, WantsItsPlacesInOrder) {
  EXPECT_TRUE(IsOrdered({.start = 0, .end = 1, .second_start = 0, .second_end = 0})) << "those do not count";
  EXPECT_FALSE(IsOrdered({.start = 1, .end = 1}));
  EXPECT_TRUE(IsOrdered({CurveKind::kRiseFall, CurveShape::kSine, 0, 1, 1, 2}));
  EXPECT_FALSE(IsOrdered({CurveKind::kRiseFall, CurveShape::kSine, 0, 2, 1, 3}));
  EXPECT_FALSE(IsOrdered({CurveKind::kFallRise, CurveShape::kSine, 0, 1, 2, 2}));
}

// By cases, from the places between which it goes up or down.
TEST(CurveTest, AgreesWithAnIndependentReckoning) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> width(0.01, 3.0), place(-5.0, 5.0);
  for (int round = 0; round < 5000; ++round) {
    Curve curve;
    curve.kind = static_cast<CurveKind>(round % 4);
    curve.shape = static_cast<CurveShape>(round / 4 % 2);
    curve.start = place(random);
    curve.end = curve.start + width(random);
    curve.second_start = curve.end + (round % 3 == 0 ? 0.0 : width(random));
    curve.second_end = curve.second_start + width(random);
    const double x = curve.start + 2 * place(random);
    const auto smooth = [&](double s, double e) {
      const double part = (x - s) / (e - s);
      return curve.shape == CurveShape::kLinear ? part : (1 - std::cos(M_PI * part)) / 2;
    };
    const bool has_two = curve.kind == CurveKind::kRiseFall || curve.kind == CurveKind::kFallRise;
    double up = 1;  // of the one that goes up first
    if (x < curve.start)
      up = 0;
    else if (x < curve.end)
      up = smooth(curve.start, curve.end);
    else if (has_two && x > curve.second_end)
      up = 0;
    else if (has_two && x > curve.second_start)
      up = 1 - smooth(curve.second_start, curve.second_end);
    const bool is_down = curve.kind == CurveKind::kFall || curve.kind == CurveKind::kFallRise;
    const double value = ValueAt(curve, x);
    EXPECT_NEAR(value, is_down ? 1 - up : up, 1e-9);
    EXPECT_GE(value, 0.0);
    EXPECT_LE(value, 1.0);
  }
}

}  // namespace
}  // namespace runnel
