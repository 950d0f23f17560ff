#include "plugins/values/internal/triangulation.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace runnel::internal {
namespace {

double AreaOf(const std::vector<Place>& ring) {
  double twice = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Place &a = ring[i], &b = ring[(i + 1) % ring.size()];
    twice += a.x * b.y - b.x * a.y;
  }
  return std::abs(twice) / 2;
}

double AreaOfTriangles(const std::vector<Place>& ring) {
  double area = 0;
  for (const auto& [a, b, c] : TrianglesOf(ring)) area += AreaOf({ring[a], ring[b], ring[c]});
  return area;
}

// Triangles that cover a simple line without overlapping have its area, and there are two fewer of
// them than corners.
void ExpectCovered(const std::vector<Place>& ring) {
  EXPECT_EQ(TrianglesOf(ring).size(), ring.size() - 2);
  EXPECT_NEAR(AreaOfTriangles(ring), AreaOf(ring), 1e-9 * (1 + AreaOf(ring)));
}

TEST(Triangulation, CoversWhatTheLineEncloses) {
  ExpectCovered({{0, 0}, {1, 0}, {0, 1}});
  ExpectCovered({{0, 0}, {0, 1}, {1, 1}, {1, 0}});                                  // clockwise
  ExpectCovered({{0, 0}, {4, 0}, {4, 4}, {2, 1}, {0, 4}});                          // a notch
  ExpectCovered({{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 2}, {3, 2}, {3, 3}, {0, 3}});  // a C
}

TEST(Triangulation, CoversStarsOfAllShapes) {
  std::mt19937 random(7);
  for (int i = 0; i < 200; ++i) {
    const std::size_t corners = 3 + random() % 60;
    std::vector<Place> ring;
    for (std::size_t k = 0; k < corners; ++k) {
      const double radius = 0.2 + static_cast<double>(random() % 1000) / 500.0;
      const double angle = 6.283185307179586 * static_cast<double>(k) / static_cast<double>(corners);
      ring.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
    ExpectCovered(ring);
  }
}

TEST(Triangulation, PassesOverCornersThatAreNone) {
  EXPECT_NEAR(AreaOfTriangles({{0, 0}, {1, 0}, {2, 0}, {2, 2}, {2, 2}, {0, 2}}), 4.0, 1e-12);
}

TEST(Triangulation, EndsWhateverComes) {
  EXPECT_EQ(TrianglesOf({}).size(), 0u);
  EXPECT_EQ(TrianglesOf({{0, 0}, {1, 1}}).size(), 0u);
  EXPECT_EQ(TrianglesOf({{0, 0}, {1, 1}, {2, 2}}).size(), 0u);
  EXPECT_LE(TrianglesOf({{0, 0}, {2, 2}, {2, 0}, {0, 2}}).size(), 2u) << "it crosses itself";
  EXPECT_EQ(TrianglesOf(std::vector<Place>(500)).size(), 0u) << "too many";
  const double nan = std::nan("");
  EXPECT_LE(TrianglesOf({{nan, 0}, {1, nan}, {nan, nan}, {0, 1}}).size(), 2u);
}

}  // namespace
}  // namespace runnel::internal
