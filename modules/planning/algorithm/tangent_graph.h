#pragma once

#include <array>
#include <optional>

#include "modules/planning/algorithm/driving.h"
#include "modules/types/algorithm/pose.h"
#include "modules/types/algorithm/surroundings.h"

namespace runnel {

/// What a robot with a body sees of the local tangent graph of TangentBug (Kamon, Rimon, Rivlin
/// 1998): how far it can go straight in each direction, and the nodes, which are the ends of the
/// boundary sections sensed. All of it is in the plane of the body's centre: obstacles are grown by
/// `radius`, so a node is a place to go to, not the corner itself. Directions are those of the
/// sectors of Surroundings. What no sensor has seen counts as free.
class TangentGraph {
 public:
  /// `range` m is how far the sensors see; what is free up to there is open.
  TangentGraph(const Surroundings& surroundings, const Pose2& pose, double radius, double range);

  struct Node {
    Point2 place;                                       ///< m, world
    double way = 0.0;                                   ///< m from the robot, through it, to the goal
    BoundaryDirection side = BoundaryDirection::kLeft;  ///< of the straight way to the goal
  };
  /// The node with the shortest way through it to the goal, of those at least `lowering` m nearer
  /// to the goal than the robot is; with -infinity of all.
  [[nodiscard]] std::optional<Node> BestNode(Point2 goal, double lowering) const;

  /// The point nearest to the goal of all that can be reached straight and are seen (d_reach is its
  /// distance).
  [[nodiscard]] Point2 NearestReachable(Point2 goal) const;

  /// m from the goal to the nearest boundary point sensed that belongs to the section with a point
  /// at `contact_bearing` (rad, body's frame): sections are apart where the body fits through.
  /// Infinite if there is nothing.
  [[nodiscard]] double SectionDistance(Point2 goal, double contact_bearing) const;

 private:
  static constexpr int kSectors = Surroundings::kSectors;
  [[nodiscard]] double Free(int sector) const { return free_[static_cast<std::size_t>(sector)]; }
  [[nodiscard]] Point2 Ahead(int sector, double distance) const;
  [[nodiscard]] int Blocker(int sector) const { return blocker_[static_cast<std::size_t>(sector)]; }
  /// Whether the body does not fit through between the boundary points of two sectors.
  [[nodiscard]] bool IsSameSection(int point, int other) const;

  const Surroundings& surroundings_;
  Pose2 pose_;
  double radius_;
  double range_;
  std::array<double, kSectors> free_{};  // m, at most the range
  std::array<int, kSectors> blocker_{};  // sector of what ends the way, -1 if nothing does
};

}  // namespace runnel
