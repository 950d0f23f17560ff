#include <cmath>
#include <limits>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "modules/simulation/algorithm/random.h"
#include "modules/simulation/algorithm/range_sensors.h"
#include "tests/modules/simulation/rays.h"

namespace runnel {
namespace {

World WallAhead(double x) { return {.boxes = {{.pose = {x + 1, 0, 0}, .length = 2, .width = 100}}}; }

TEST(LaserScanner, SweepsFromTheRightToTheLeftOfTheBody) {
  // A wall 1 m to the left of a body that looks along +y at (5, 5) is at x = 4.
  const RayCaster rays = Rays({.boxes = {{.pose = {3, 5, 0}, .length = 2, .width = 100}}});
  LaserScanner scanner;
  RangeScan scan;
  scanner.Scan(rays, {5, 5, kPi / 2}, scan);
  ASSERT_EQ(scan.ranges.size(), 181U);
  EXPECT_DOUBLE_EQ(scan.start_angle, -kPi / 2);
  EXPECT_DOUBLE_EQ(scan.angle_step, kPi / 180);
  EXPECT_EQ(scan.range_minimum, 0.02);
  EXPECT_EQ(scan.range_maximum, 4.0);
  for (std::size_t i = 0; i < 181; ++i) {
    const double bearing = DegreesToRadians(static_cast<double>(i) - 90.0);
    const double expected = bearing > 0.0 ? 1.0 / std::sin(bearing) : kInfinity;
    if (expected < 4.0) {
      EXPECT_NEAR(scan.ranges[i], expected, 1e-6) << i;
    } else {
      EXPECT_EQ(scan.ranges[i], kInfinity) << i;
    }
  }
}

TEST(LaserScanner, ReadsTheMinimumForWhatIsNearer) {
  LaserScanner scanner;
  RangeScan scan;
  scanner.Scan(Rays(WallAhead(0.01)), {}, scan);
  EXPECT_EQ(scan.ranges[90], 0.02F);
}

TEST(LaserScanner, KeepsItsMemory) {
  LaserScanner scanner(LaserScannerOptions{.rays = 41});
  RangeScan scan;
  scanner.Scan(Rays(WallAhead(1)), {}, scan);
  const float* const memory = scan.ranges.data();
  scanner.Scan(Rays(WallAhead(2)), {}, scan);
  EXPECT_EQ(scan.ranges.data(), memory);
  EXPECT_EQ(scan.ranges.size(), 41U);
  EXPECT_NEAR(scan.ranges[20], 2.0, 1e-6);
}

TEST(LaserScanner, NoiseSpreadsDistancesButMakesNoEchoOfNone) {
  const RayCaster rays = Rays(WallAhead(2));
  LaserScanner scanner(LaserScannerOptions{.standard_deviation = 0.05});
  RangeScan scan;
  double sum = 0.0, square = 0.0;
  constexpr int kScans = 4000;
  for (int i = 0; i < kScans; ++i) {
    scanner.Scan(rays, {}, scan);
    EXPECT_EQ(scan.ranges[0], kInfinity);
    const double error = scan.ranges[90] - 2.0;
    sum += error;
    square += error * error;
  }
  EXPECT_NEAR(sum / kScans, 0.0, 0.003);
  EXPECT_NEAR(std::sqrt(square / kScans), 0.05, 0.003);
}

TEST(LaserScanner, TheSameSeedGivesTheSameScan) {
  const RayCaster rays = Rays(WallAhead(2));
  const auto scan_with = [&](std::uint64_t seed) {
    LaserScanner scanner(LaserScannerOptions{.standard_deviation = 0.1, .seed = seed});
    RangeScan scan;
    scanner.Scan(rays, {}, scan);
    return scan;
  };
  EXPECT_EQ(scan_with(3), scan_with(3));
  EXPECT_NE(scan_with(3), scan_with(4));
}

TEST(InfraredSensor, GivesTheLeastDistanceInEachCone) {
  // Nearest in front: not on the axis, but within 13 degrees of it.
  const RayCaster rays = Rays({.cylinders = {{.centre = {1.5, 0.3}, .radius = 0.1},
                                             {.centre = {0, 1.2}, .radius = 0.2},
                                             {.centre = {1.0, -1.0}, .radius = 0.2}}});
  InfraredSensor sensor(InfraredSensorOptions{.rays_per_cone = 261});
  const InfraredRanges ranges = sensor.Measure(rays, {});
  EXPECT_NEAR(ranges.front, std::hypot(1.5, 0.3) - 0.1, 1e-3);
  EXPECT_NEAR(ranges.left, 1.0, 1e-9);
  EXPECT_EQ(ranges.right, kInfinity);  // what is there lies between the cones
  EXPECT_EQ(ranges.range_maximum, 2.0);
  EXPECT_DOUBLE_EQ(ranges.field_of_view, DegreesToRadians(26));
}

TEST(InfraredSensor, SeesNothingPastItsRangeOrOutsideItsCones) {
  InfraredSensor sensor;
  EXPECT_EQ(sensor.Measure(Rays(WallAhead(2.01)), {}).front, kInfinity);
  EXPECT_NEAR(sensor.Measure(Rays(WallAhead(1.99)), {}).front, 1.99, 1e-9);
  const auto at = [](double degrees) {
    const Point2 place = 1.5 * UnitVector(DegreesToRadians(degrees));
    return Rays({.cylinders = {{.centre = place, .radius = 0.02}}});
  };
  EXPECT_NEAR(sensor.Measure(at(12.9), {}).front, 1.48, 5e-3);
  EXPECT_EQ(sensor.Measure(at(14.5), {}).front, kInfinity);
  EXPECT_NEAR(sensor.Measure(at(-90), {}).right, 1.48, 1e-9);
}

TEST(InfraredSensor, TurnsWithTheBody) {
  InfraredSensor sensor;
  const InfraredRanges ranges = sensor.Measure(Rays(WallAhead(1)), {0, 0, kPi / 2});
  EXPECT_NEAR(ranges.right, 1.0, 1e-9);
  EXPECT_EQ(ranges.front, kInfinity);
}

TEST(GaussianNoise, HasTheMeanTheDeviationAndTheTailsOfItsDistribution) {
  GaussianNoise noise(42);
  constexpr int kNumbers = 100000;
  double sum = 0.0, square = 0.0;
  int beyond_one = 0, beyond_two = 0;
  for (int i = 0; i < kNumbers; ++i) {
    const double number = noise(2.0);
    sum += number;
    square += number * number;
    beyond_one += std::abs(number) > 2.0 ? 1 : 0;
    beyond_two += std::abs(number) > 4.0 ? 1 : 0;
  }
  EXPECT_NEAR(sum / kNumbers, 0.0, 0.03);
  EXPECT_NEAR(std::sqrt(square / kNumbers), 2.0, 0.02);
  EXPECT_NEAR(beyond_one, 0.3173 * kNumbers, 600);
  EXPECT_NEAR(beyond_two, 0.0455 * kNumbers, 300);
}

TEST(GaussianNoise, IsTheSameOnEveryMachine) {
  GaussianNoise noise(1);
  EXPECT_NEAR(noise(1.0), 0.7497765692000015, 1e-12);
  EXPECT_NEAR(noise(1.0), 0.5945638545653684, 1e-12);
}

TEST(GaussianNoise, WithoutDeviationIsExactlyNothing) {
  GaussianNoise noise(1), other(1);
  for (int i = 0; i < 10; ++i) EXPECT_EQ(noise(0.0), 0.0);
  EXPECT_EQ(noise(1.0), other(1.0));  // nothing was drawn
}

}  // namespace
}  // namespace runnel
