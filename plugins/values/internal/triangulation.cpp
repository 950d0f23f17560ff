#include "plugins/values/internal/triangulation.h"

#include <algorithm>
#include <numeric>

namespace runnel::internal {

namespace {

// Twice the area of the triangle; positive if its corners go counter-clockwise.
double Turn(const Place& a, const Place& b, const Place& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

double TwiceTheArea(const std::vector<Place>& ring) {
  double area = 0;
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) area += Turn(ring[0], ring[i], ring[i + 1]);
  return area;
}

bool IsWithin(const Place& point, const Place& a, const Place& b, const Place& c) {
  return Turn(a, b, point) >= 0 && Turn(b, c, point) >= 0 && Turn(c, a, point) >= 0;
}

bool IsSame(const Place& a, const Place& b) { return a.x == b.x && a.y == b.y; }

// Whether the corner sticks out and can be cut off without cutting anything else. `left` goes
// counter-clockwise.
bool IsEar(const std::vector<Place>& ring, const std::vector<std::size_t>& left, std::size_t at) {
  const std::size_t count = left.size();
  const Place& before = ring[left[(at + count - 1) % count]];
  const Place& corner = ring[left[at]];
  const Place& after = ring[left[(at + 1) % count]];
  if (Turn(before, corner, after) <= 0) return false;
  for (const std::size_t other : left) {
    const Place& point = ring[other];
    const bool is_corner = IsSame(point, before) || IsSame(point, corner) || IsSame(point, after);
    if (!is_corner && IsWithin(point, before, corner, after)) return false;
  }
  return true;
}

}  // namespace

std::vector<std::array<std::size_t, 3>> TrianglesOf(const std::vector<Place>& ring, std::size_t most) {
  std::vector<std::array<std::size_t, 3>> triangles;
  if (ring.size() < 3 || ring.size() > most) return triangles;
  std::vector<std::size_t> left(ring.size());
  std::iota(left.begin(), left.end(), std::size_t{0});
  if (TwiceTheArea(ring) < 0) std::ranges::reverse(left);
  std::size_t at = 0, tried = 0;
  while (left.size() >= 3 && tried < left.size()) {
    const std::size_t count = left.size();
    at %= count;
    const std::size_t before = left[(at + count - 1) % count], after = left[(at + 1) % count];
    const bool is_flat = Turn(ring[before], ring[left[at]], ring[after]) == 0;
    if (!is_flat && !IsEar(ring, left, at)) {
      ++at;
      ++tried;
      continue;
    }
    if (!is_flat) triangles.push_back({before, left[at], after});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(at));
    tried = 0;
  }
  return triangles;
}

}  // namespace runnel::internal
