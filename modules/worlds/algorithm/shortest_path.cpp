#include "modules/worlds/algorithm/shortest_path.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>

#include "modules/worlds/algorithm/internal/plane_geometry.h"

namespace runnel {

namespace {

using Circle = ConfigurationSpace::Circle;
using internal::Sweep;

constexpr double kArcStep = 0.1;  // rad, of the line that is drawn
constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

/// A point where a tangent touches its circle, or an end of the path.
struct Node {
  Point2 place;
  std::size_t circle = kNone;
  double angle = 0.0;
};

struct Tangent {
  std::size_t one, other;  ///< nodes
};

/// The common tangents of all circles and of the two ends: candidates, not asked whether free.
class TangentGraph {
 public:
  TangentGraph(const ConfigurationSpace& space, Point2 from, Point2 to) : space_(space) {
    nodes_ = {{from}, {to}};
    tangents_of_.resize(2);
    nodes_of_.resize(space.circles().size());
    AddTangent(0, 1);
    for (std::size_t i = 0; i < space.circles().size(); ++i) {
      if (!HasFreeArc(i)) continue;
      for (const std::size_t end : {std::size_t{0}, std::size_t{1}}) AddFromPoint(end, i);
      for (std::size_t j = 0; j < i; ++j) {
        if (HasFreeArc(j)) AddBetween(i, j);
      }
    }
    for (auto& nodes : nodes_of_) {
      std::ranges::sort(nodes, {}, [this](std::size_t node) { return nodes_[node].angle; });
    }
  }

  const std::vector<Node>& nodes() const { return nodes_; }
  const std::vector<Tangent>& tangents() const { return tangents_; }
  const std::vector<std::size_t>& TangentsOf(std::size_t node) const { return tangents_of_[node]; }
  const std::vector<std::size_t>& NodesOf(std::size_t circle) const { return nodes_of_[circle]; }

 private:
  bool HasFreeArc(std::size_t circle) const {
    return std::ranges::find(space_.circles()[circle].is_free, true) != space_.circles()[circle].is_free.end();
  }

  /// Whether the circle's boundary is free at this angle, or next to it.
  bool IsOnFreeArc(const Circle& circle, double angle) const {
    const double step = ConfigurationSpace::kTolerance / circle.radius;
    return space_.IsFree(circle, angle, angle + 2 * step) || space_.IsFree(circle, angle - 2 * step, angle);
  }

  std::size_t AddNode(std::size_t circle, double angle) {
    const Circle& round = space_.circles()[circle];
    nodes_.push_back({round.centre + round.radius * UnitVector(angle), circle, internal::PositiveAngle(angle)});
    tangents_of_.emplace_back();
    nodes_of_[circle].push_back(nodes_.size() - 1);
    return nodes_.size() - 1;
  }

  void AddTangent(std::size_t one, std::size_t other) {
    tangents_.push_back({one, other});
    tangents_of_[one].push_back(tangents_.size() - 1);
    tangents_of_[other].push_back(tangents_.size() - 1);
  }

  void AddFromPoint(std::size_t end, std::size_t circle) {
    const Circle& round = space_.circles()[circle];
    const Point2 gap = nodes_[end].place - round.centre;
    // A point on the circle is its own point of tangency.
    const double ratio = round.radius / Norm(gap);
    if (ratio > 1.0 + ConfigurationSpace::kTolerance / round.radius) return;
    const double half = std::acos(std::min(ratio, 1.0));
    for (const double side : {1.0, -1.0}) {
      const double angle = Direction(gap) + side * half;
      if (IsOnFreeArc(round, angle)) AddTangent(end, AddNode(circle, angle));
    }
  }

  /// The two outer tangents, and the two inner ones that cross between the circles. A tangent
  /// touches at the same angle from the line of centres on both circles, or at opposite ones.
  void AddBetween(std::size_t i, std::size_t j) {
    const Circle &a = space_.circles()[i], &b = space_.circles()[j];
    const Point2 gap = b.centre - a.centre;
    const double distance = Norm(gap), direction = Direction(gap);
    for (const double kind : {1.0, -1.0}) {  // outer, inner
      const double cosine = (a.radius - kind * b.radius) / distance;
      if (std::abs(cosine) > 1.0) continue;
      for (const double side : {1.0, -1.0}) {
        const double angle = direction + side * std::acos(cosine);
        const double other = kind > 0.0 ? angle : angle + kPi;
        if (!IsOnFreeArc(a, angle) || !IsOnFreeArc(b, other)) continue;
        const std::size_t one = AddNode(i, angle), two = AddNode(j, other);
        AddTangent(one, two);
      }
    }
  }

  const ConfigurationSpace& space_;
  std::vector<Node> nodes_;
  std::vector<Tangent> tangents_;
  std::vector<std::vector<std::size_t>> tangents_of_;
  std::vector<std::vector<std::size_t>> nodes_of_;  // of each circle, by angle
};

class Search {
 public:
  Search(const ConfigurationSpace& space, Point2 from, Point2 to)
      : space_(space),
        graph_(space, from, to),
        to_(to),
        length_(graph_.nodes().size(), std::numeric_limits<double>::infinity()),
        came_from_(graph_.nodes().size(), kNone),
        is_done_(graph_.nodes().size()) {}

  std::optional<ShortestPath> Find() {
    Offer(0, kNone, 0.0);
    while (!open_.empty()) {
      const std::size_t node = open_.top().second;
      open_.pop();
      if (is_done_[node]) continue;
      if (node == 1) return Path();
      is_done_[node] = true;
      FollowTangents(node);
      FollowCircle(node);
    }
    return std::nullopt;
  }

 private:
  const Node& At(std::size_t node) const { return graph_.nodes()[node]; }

  void Offer(std::size_t node, std::size_t from, double length) {
    if (is_done_[node] || length >= length_[node]) return;
    length_[node] = length;
    came_from_[node] = from;
    open_.emplace(-(length + Distance(At(node).place, to_)), node);
  }

  void FollowTangents(std::size_t node) {
    for (const std::size_t index : graph_.TangentsOf(node)) {
      const Tangent& tangent = graph_.tangents()[index];
      const std::size_t other = tangent.one == node ? tangent.other : tangent.one;
      if (is_done_[other]) continue;
      const double length = Distance(At(node).place, At(other).place);
      if (length_[node] + length >= length_[other]) continue;
      if (space_.IsFree(Segment2{At(node).place, At(other).place})) {
        Offer(other, node, length_[node] + length);
      }
    }
  }

  /// To the next nodes either way; those beyond are come to from there.
  void FollowCircle(std::size_t node) {
    if (At(node).circle == kNone) return;
    const Circle& circle = space_.circles()[At(node).circle];
    const auto& nodes = graph_.NodesOf(At(node).circle);
    const auto here = std::ranges::find(nodes, node) - nodes.begin();
    const auto count = static_cast<std::ptrdiff_t>(nodes.size());
    for (const std::ptrdiff_t step : {std::ptrdiff_t{1}, std::ptrdiff_t{-1}}) {
      const std::size_t other = nodes[static_cast<std::size_t>((here + step + count) % count)];
      if (other == node || is_done_[other]) continue;
      const double first = step > 0 ? At(node).angle : At(other).angle;
      const double sweep = Sweep(first, step > 0 ? At(other).angle : At(node).angle);
      if (!space_.IsFree(circle, first, first + sweep)) continue;
      Offer(other, node, length_[node] + circle.radius * sweep);
    }
  }

  std::optional<ShortestPath> Path() const {
    ShortestPath path{.length = length_[1]};
    for (std::size_t node = 1; node != kNone; node = came_from_[node]) {
      const std::size_t before = came_from_[node];
      path.points.push_back(At(node).place);
      const bool is_arc = before != kNone && At(node).circle != kNone && At(node).circle == At(before).circle;
      if (is_arc) AddArc(node, before, path.points);
    }
    std::ranges::reverse(path.points);
    return path;
  }

  void AddArc(std::size_t node, std::size_t before, std::vector<Point2>& points) const {
    const Circle& circle = space_.circles()[At(node).circle];
    const double forward = Sweep(At(before).angle, At(node).angle);
    const double arc = length_[node] - length_[before];
    const bool is_forward = std::abs(forward * circle.radius - arc) < 1e-9;
    const double sweep = is_forward ? forward : -Sweep(At(node).angle, At(before).angle);
    const int steps = static_cast<int>(std::abs(sweep) / kArcStep);
    for (int i = steps; i > 0; --i) {
      const double angle = At(before).angle + sweep * i / (steps + 1);
      points.push_back(circle.centre + circle.radius * UnitVector(angle));
    }
  }

  const ConfigurationSpace& space_;
  const TangentGraph graph_;
  const Point2 to_;
  std::vector<double> length_;
  std::vector<std::size_t> came_from_;
  std::vector<bool> is_done_;
  std::priority_queue<std::pair<double, std::size_t>> open_;
};

}  // namespace

std::optional<ShortestPath> FindShortestPath(const ConfigurationSpace& space, Point2 from, Point2 to, double reach) {
  const auto first = space.NearestFree(from, reach), last = space.NearestFree(to, reach);
  if (!first || !last) return std::nullopt;
  return Search(space, *first, *last).Find();
}

}  // namespace runnel
