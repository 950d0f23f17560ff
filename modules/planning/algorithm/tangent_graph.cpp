#include "modules/planning/algorithm/tangent_graph.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "modules/types/algorithm/segment.h"

namespace runnel {

namespace {

// m; a robot that touches the grown boundary goes on along it: the node is not where it stands.
constexpr double kLeastAhead = 0.30;

int Wrapped(int sector) { return (sector + Surroundings::kSectors) % Surroundings::kSectors; }

}  // namespace

TangentGraph::TangentGraph(const Surroundings& surroundings, const Pose2& pose, double radius, double range)
    : surroundings_(surroundings), pose_(pose), radius_(radius), range_(range) {
  free_.fill(range);
  blocker_.fill(-1);
  for (int point = 0; point < kSectors; ++point) {
    const double distance = ContourDistance(surroundings, point);
    if (distance - radius >= range) continue;
    const double half_width = distance <= radius ? kPi / 2 : std::asin(radius / distance);
    const int reach = static_cast<int>(half_width / kSectorWidth);
    for (int turn = -reach; turn <= reach; ++turn) {
      const double ahead = distance * std::cos(turn * kSectorWidth);
      const double aside = distance * std::sin(turn * kSectorWidth);
      if (ahead <= 1e-9 || std::abs(aside) >= radius) continue;
      const double free = distance <= radius ? 0.0 : ahead - std::sqrt(radius * radius - aside * aside);
      const auto sector = static_cast<std::size_t>(Wrapped(point + turn));
      if (free >= free_[sector]) continue;
      free_[sector] = free;
      blocker_[sector] = point;
    }
  }
}

Point2 TangentGraph::Ahead(int sector, double distance) const {
  return Position(pose_) + distance * UnitVector(pose_.heading + SectorBearing(sector));
}

std::optional<TangentGraph::Node> TangentGraph::BestNode(Point2 goal, double lowering) const {
  const double distance = Distance(Position(pose_), goal);
  const double goal_bearing = Direction(ToBody(pose_, goal));
  std::optional<Node> best;
  for (int sector = 0; sector < kSectors; ++sector) {
    const int next = Wrapped(sector + 1);
    const int blocker = Blocker(sector), next_blocker = Blocker(next);
    const bool is_blocked = blocker >= 0 && next_blocker >= 0;
    if (is_blocked ? IsSameSection(blocker, next_blocker) : blocker == next_blocker) continue;
    const int past = Free(sector) > Free(next) ? sector : next;
    const double end = std::min(Free(sector), Free(next));
    const double ahead = std::min(Free(past), std::max(end, kLeastAhead));
    const Point2 place = Ahead(past, ahead);
    const double rest = Distance(place, goal);
    if (rest > distance - lowering || (best && ahead + rest >= best->way)) continue;
    const bool is_left = WrapAngle(SectorBearing(past) - goal_bearing) >= 0.0;
    best = Node{place, ahead + rest, is_left ? BoundaryDirection::kLeft : BoundaryDirection::kRight};
  }
  return best;
}

Point2 TangentGraph::NearestReachable(Point2 goal) const {
  Point2 nearest = Position(pose_);
  const auto look = [&](Point2 end) {
    const Point2 point = NearestPoint(Segment2{Position(pose_), end}, goal);
    if (Distance(point, goal) < Distance(nearest, goal)) nearest = point;
  };
  for (int sector = 0; sector < kSectors; ++sector) look(Ahead(sector, Free(sector)));
  const double bearing = Direction(ToBody(pose_, goal));
  const double free = std::min(FreeRange(surroundings_, bearing, radius_), range_);
  look(Position(pose_) + free * UnitVector(pose_.heading + bearing));
  return nearest;
}

bool TangentGraph::IsSameSection(int point, int other) const {
  if (point == other) return true;
  const auto local = [&](int sector) {
    return ContourDistance(surroundings_, sector) * UnitVector(SectorBearing(sector));
  };
  return Distance(local(point), local(other)) < 2 * radius_;
}

double TangentGraph::SectionDistance(Point2 goal, double contact_bearing) const {
  double least = std::numeric_limits<double>::infinity();
  const int contact = SectorOf(contact_bearing);
  for (const int step : {1, -1}) {
    int last = contact;
    for (int sector = contact; std::isfinite(ContourDistance(surroundings_, sector));) {
      if (!IsSameSection(last, sector)) break;
      least = std::min(least, Distance(Ahead(sector, ContourDistance(surroundings_, sector)), goal));
      last = sector;
      sector = Wrapped(sector + step);
      if (sector == contact) break;
    }
  }
  return least;
}

}  // namespace runnel
