#pragma once

#include <optional>

#include "modules/types/algorithm/pose.h"
#include "modules/types/algorithm/surroundings.h"

namespace runnel {

/// How the behaviours of a robot drive.
struct SteeringConfiguration {
  double speed = 0.4;            ///< m/s, at most
  double turn_limit = 1.2;       ///< rad/s
  double turn_gain = 3.0;        ///< rad/s of turn for each rad of bearing
  double braking = 0.3;          ///< m/s^2
  double turning_bearing = 0.8;  ///< rad; towards bearings beyond this it turns on the spot
};

/// Towards `bearing` (rad, body's frame), the slower the more it has to turn and the nearer the end of the way is, `free` m
/// ahead.
[[nodiscard]] Twist2 Steer(const SteeringConfiguration& configuration, double bearing, double free);

/// m; the radius of the disc that has to pass: a little less than the safe distance, so that driving along a wall is
/// possible at all.
[[nodiscard]] double PassingRadius(const Surroundings& surroundings);

/// What a behaviour of the robot wants, and how much.
struct Wish {
  Twist2 twist = {};
  double rating = 0.0;  ///< within [0, 1]; 0: it is content
};

struct DriveToGoalConfiguration {
  double tolerance = 0.1;     ///< m; nearer than this it is content
  double far_distance = 1.0;  ///< m; from here on it is as far from content as can be
};

/// Straight to the goal, whatever is in the way.
[[nodiscard]] Wish DriveToGoal(const SteeringConfiguration& steering, const DriveToGoalConfiguration& configuration,
                               const Pose2& pose, Point2 goal);

struct AvoidObstaclesConfiguration {
  double near_distance = 0.8;    ///< m; what is nearer disturbs it, and at the safe distance as much as can be
  double view_half_width = 1.3;  ///< rad, to both sides of the way ahead
};

/// Turns away from the nearest obstacle ahead, and drives the slower the nearer it is.
[[nodiscard]] Wish AvoidObstacles(const SteeringConfiguration& steering,
                                  const AvoidObstaclesConfiguration& configuration, const Surroundings& surroundings);

/// Which way it turns where it meets a wall, which is then on its other hand.
enum class FirstTurn { kLeft, kRight };

struct FollowWallConfiguration {
  FirstTurn first_turn = FirstTurn::kLeft;
  double look_ahead = 0.5;  ///< m; a way that is free so far is a way
};

/// Along the wall on its hand: from there, swings the gaze round to the first way that is free. Where there is no wall
/// it drives in a circle towards where one should be. Its rating: how far it is from driving beside a wall.
[[nodiscard]] Wish FollowWall(const SteeringConfiguration& steering, const FollowWallConfiguration& configuration,
                              const Surroundings& surroundings);

struct EmergencyStopConfiguration {
  double least_way = 0.05;      ///< m; with less way ahead that is free it stops
  double creeping_speed = 0.1;  ///< m/s, into what it has faced and no sensor can tell of
  SteeringConfiguration steering = {};
};

/// Where it looks, and has looked.
struct EmergencyStopState {
  std::optional<double> look = {};  ///< rad, world: where it turns to, to see what is there
  std::optional<Pose2> faced = {};  ///< where its last look ended
};

/// Whether a sensor of narrow view has to be turned to what lies straight ahead before the robot goes on.
[[nodiscard]] bool IsUnseenNear(const Surroundings& surroundings);

/// Stands still before it is too late, and lets nothing pass of what is `wanted` but turning on the spot. What rangers of
/// narrow view have not looked at is not free: it slows down before it and on curves, turns to it until it faces it, and
/// then lets the others go on. What was faced from where it stands is known as well as it can be. The pose counts only with
/// such rangers.
[[nodiscard]] Wish EmergencyStop(const EmergencyStopConfiguration& configuration, const Pose2& pose,
                                 const Surroundings& surroundings, const Twist2& wanted, EmergencyStopState& state);

struct EscapeConfiguration {
  double patience = 4.0;   ///< s without coming nearer, after which it is a dead end
  double progress = 0.1;   ///< m, by which it must come nearer
  double margin = 0.2;     ///< m, by which it leaves nearer to the goal than it came, but in the open,
  double free_way = 1.0;   ///< m towards the goal, with which it leaves
  double tolerance = 0.1;  ///< m, nearer than this it is there
};

/// Notices that the robot does not come nearer to its goal any more, and when it is out of there. Remembers.
struct EscapeState {
  bool has_goal = false;
  Point2 goal = {};
  Point2 position = {};         ///< of the robot in the cycle before
  double least_distance = 0.0;  ///< m, that it has come near
  double idle_time = 0.0;       ///< s, since it did
  bool is_escaping = false;
  double stuck_distance = 0.0;  ///< m, from the goal, when it was stuck

  friend bool operator==(const EscapeState&, const EscapeState&) = default;
};

/// One cycle of `time_step` s. Whether it is escaping.
bool WatchProgress(const EscapeConfiguration& configuration, double time_step, const Pose2& pose, Point2 goal,
                   const Surroundings& surroundings, EscapeState& state);

}  // namespace runnel
