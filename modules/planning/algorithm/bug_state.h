#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

#include "modules/planning/algorithm/faced_headings.h"
#include "modules/planning/algorithm/lap.h"
#include "modules/planning/algorithm/wall_follower.h"
#include "modules/types/algorithm/planner_status.h"
#include "modules/types/algorithm/pose.h"
#include "modules/types/algorithm/surroundings.h"

namespace runnel {

/// The last points of a kind, in order, in memory of a fixed size: once it is full, each new point
/// takes the place of the oldest. Copied freely.
class PointHistory {
 public:
  /// Every leave point of a variant that ends is nearer to the goal than the one before by the
  /// leave margin, so with 0.1 m this is enough for tasks of 25 m, and for most that are longer.
  static constexpr std::size_t kCapacity = 256;

  void Add(Point2 point) {
    points_[total_++ % kCapacity] = point;
    size_ = std::min(size_ + 1, kCapacity);
  }
  /// As if the last one had not been added (what it took the place of stays lost). Precondition:
  /// not empty.
  void RemoveLast() {
    --total_;
    --size_;
  }

  /// Of the points remembered.
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  /// Of the points there have been.
  [[nodiscard]] std::size_t total() const { return total_; }
  /// From 0, the oldest remembered, to size() - 1, the newest.
  [[nodiscard]] Point2 operator[](std::size_t i) const { return points_[(total_ - size_ + i) % kCapacity]; }
  [[nodiscard]] Point2 back() const { return (*this)[size() - 1]; }

 private:
  friend struct KeptFields;  // names the members for a handover
  std::array<Point2, kCapacity> points_{};
  std::size_t total_ = 0;
  std::size_t size_ = 0;
};

/// What a planner is given in each update. A start or goal other than in the update before begins a
/// new task.
struct BugInput {
  double time_step = 0.0;  ///< s since the last update
  Pose2 pose;              ///< world
  Surroundings surroundings;
  Point2 start;  ///< m, world; where the M-line begins
  Point2 goal;   ///< m, world
};

/// How a robot gets to its leave point.
enum class Approach : std::uint8_t {
  kNear,           ///< it is there, or nearly: straight, then it faces the goal
  kAlongBoundary,  ///< by the shorter way along the boundary, then it faces the goal
  kAcross,         ///< straight to a point away from the boundary, and on from there
  kBack,           ///< straight back to where a way across began that proved to be blocked
};

/// Everything a Bug algorithm remembers. All variants record all of it, so that one variant can
/// take over from another in the middle of a task. Holds no pointers; copied freely.
struct BugState {
  static constexpr double kNever = std::numeric_limits<double>::infinity();

  PlannerStatus status;
  bool has_task = false;
  Point2 start;
  Point2 goal;
  std::uint64_t composition = 0;  ///< of the variant that drove last; 0: none has
  Pose2 last_pose;                ///< in the update before
  Twist2 last_twist;              ///< commanded then
  Pose2 still_pose;               ///< where it has been since it last moved
  Twist2 commanded;               ///< m and rad, lately, since then
  double earlier_turn = 0.0;      ///< rad/s, commanded in the update before the last
  double turning = 0.0;           ///< rad^2/s, commanded turns times themselves, as `commanded`
  double response = 0.0;          ///< rad^2/s, times what the heading has turned an update later

  PointHistory hits;    ///< in the order they were met
  PointHistory leaves;  ///< without those that turned out to be none

  // Of all the task.
  double least_distance_of_all = kNever;            ///< m to the goal, of all points visited
  Point2 line_start;                                ///< of the M-line, that ends at the goal
  double least_distance_on_line = kNever;           ///< m to the goal, of the M-line's points visited
  double last_leave_distance = kNever;              ///< m to the goal, from where motion to goal began
  std::optional<BoundaryDirection> last_direction;  ///< chosen at the last hit point
  std::optional<BoundaryDirection> node_side;       ///< of the goal, of the tangent node chosen last
  int second_looks = 0;                             ///< at hit points, after a lap, that found the way free
  double doubted_hit_distance = kNever;             ///< m to the goal, of the last hit point whose lap proved nothing
  FacedHeadings faced;                              ///< from where it stands
  std::optional<double> look;                       ///< rad, world: where it turns to, to see what is there
  std::optional<double> look_back;                  ///< rad, world: where it turns to then, its heading before
  Point2 progress_point;                            ///< where the robot last got on
  double idle_time = 0.0;                           ///< s since then
  double refused_at = -kNever;                      ///< m, the path's length where it last found a leave point blocked

  // Since the last hit point.
  WallFollower follower;
  double hit_distance = kNever;       ///< m from the hit point to the goal
  double least_distance = kNever;     ///< m to the goal, of all points visited
  double followed_distance = kNever;  ///< m to the goal, of the boundary sensed
  bool has_reversed = false;
  bool has_doubted = false;  ///< that a lap proved the goal to be out of reach, and gone round the other way

  // Since the lap began: at the hit point, where it reversed, or in a loop that both are not on.
  Lap lap;
  bool is_other_loop = false;        ///< than the one that the robot hit, or reversed on
  Point2 closest_point;              ///< nearest to the goal
  double closest_distance = kNever;  ///< m, its distance to the goal
  double closest_length = 0.0;       ///< m, the lap's length there

  std::optional<Point2> crossing;     ///< of the M-line, just here or just behind
  std::optional<Point2> leave_point;  ///< found, not left yet
  Approach approach = Approach::kNear;
  bool is_last_chance = false;            ///< if the leave point is blocked, there is no other
  double way_to_leave_point = 0.0;        ///< m along the boundary, when the robot set out
  bool is_on_last_stretch = false;        ///< straight to the leave point, no more along the boundary
  Point2 set_out_point;                   ///< from where it set out for the leave point
  bool is_off_boundary = false;           ///< since then, until it follows the boundary again: no part of the lap
  std::optional<double> set_out_contact;  ///< rad, world: where that boundary was, seen from there
  double set_out_at = 0.0;                ///< m, the path's length there
};

}  // namespace runnel
