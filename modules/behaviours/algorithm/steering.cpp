#include "modules/behaviours/algorithm/steering.h"

#include <algorithm>
#include <cmath>

namespace runnel {

namespace {

constexpr double kWidthTolerance = 0.05;  // m

constexpr double kStraightAhead = 0.1;  // rad
constexpr double kSideways = 1.0;       // rad, where it looks which side is freer

// +1: to the left.
double FreerSide(const Surroundings& surroundings) {
  const double radius = PassingRadius(surroundings);
  return FreeRange(surroundings, kSideways, radius) >= FreeRange(surroundings, -kSideways, radius) ? 1.0 : -1.0;
}

// rad, as if the wall were on the right: where that is looked for.
constexpr double kHandMiddle = -1.05;
constexpr double kHandHalfWidth = 1.75;
constexpr double kBeside = 1.0;        // m; what is further away is not beside it
constexpr double kLookStep = 0.05;     // rad
constexpr double kSearchRadius = 0.5;  // m, of the circle where there is no wall

constexpr double kCarried = 1.0;  // m between two cycles, more than any robot drives

constexpr double kSeen = DegreesToRadians(13.0);  // rad off ahead, within the narrowest view
constexpr double kStraightTurn = 0.01;            // rad/s

// Where the wall is, as if that were on the right; the nearest one if none is on that hand.
double WallBearing(const Surroundings& surroundings, double hand) {
  const BoundaryPoint on_hand = NearestBoundary(surroundings, hand * kHandMiddle, kHandHalfWidth);
  return hand * (on_hand.distance <= kBeside ? on_hand : NearestBoundary(surroundings)).bearing;
}

constexpr double kUnseenNear = 0.05;              // m
constexpr double kFaced = DegreesToRadians(8.0);  // rad, of bearing, at which a look ends
constexpr double kSamePlace = 0.1;                // m

// Whether the last look, from here, was at that.
bool HasFaced(const EmergencyStopState& state, const Pose2& pose, double bearing) {
  return state.faced && Distance(Position(*state.faced), Position(pose)) < kSamePlace &&
         std::abs(WrapAngle(pose.heading + bearing - state.faced->heading)) < kSeen;
}

bool IsWayFree(const EscapeConfiguration& configuration, const Pose2& pose, Point2 goal, double distance,
               const Surroundings& surroundings) {
  const Point2 to_goal = ToBody(pose, goal);
  const double free = FreeRange(surroundings, std::atan2(to_goal.y, to_goal.x), PassingRadius(surroundings));
  return free >= std::min(configuration.free_way, distance);
}

}  // namespace

Twist2 Steer(const SteeringConfiguration& configuration, double bearing, double free) {
  const double turn =
      std::clamp(configuration.turn_gain * bearing, -configuration.turn_limit, configuration.turn_limit);
  const double part = std::max(0.0, 1.0 - std::abs(bearing) / configuration.turning_bearing);
  const double stopping_speed = std::sqrt(2.0 * configuration.braking * std::max(0.0, free));
  return {std::min(configuration.speed * part, stopping_speed), turn};
}

double PassingRadius(const Surroundings& surroundings) {
  return std::max(0.0, double{surroundings.safe_distance} - kWidthTolerance);
}

Wish DriveToGoal(const SteeringConfiguration& steering, const DriveToGoalConfiguration& configuration,
                 const Pose2& pose, Point2 goal) {
  const Point2 to_goal = ToBody(pose, goal);
  const double distance = std::hypot(to_goal.x, to_goal.y);
  if (distance <= configuration.tolerance) return {};
  const double bearing = std::atan2(to_goal.y, to_goal.x);
  return {Steer(steering, bearing, distance), std::min(1.0, distance / configuration.far_distance)};
}

Wish AvoidObstacles(const SteeringConfiguration& steering, const AvoidObstaclesConfiguration& configuration,
                    const Surroundings& surroundings) {
  const BoundaryPoint nearest = NearestBoundary(surroundings, 0.0, configuration.view_half_width);
  const double safe = surroundings.safe_distance;
  const double room = std::max(configuration.near_distance - safe, 1e-3);
  const double nearness = std::clamp((safe + room - nearest.distance) / room, 0.0, 1.0);
  if (nearness <= 0.0) return {};
  const bool is_ahead = std::abs(nearest.bearing) < kStraightAhead;
  const double away = is_ahead ? FreerSide(surroundings) : (nearest.bearing > 0.0 ? -1.0 : 1.0);
  return {{steering.speed * (1.0 - nearness), away * steering.turn_limit}, nearness};
}

Wish FollowWall(const SteeringConfiguration& steering, const FollowWallConfiguration& configuration,
                const Surroundings& surroundings) {
  const double hand = configuration.first_turn == FirstTurn::kLeft ? 1.0 : -1.0;  // +1: the wall is on the right
  const double radius = PassingRadius(surroundings);
  if (!std::isfinite(NearestBoundary(surroundings).distance)) {
    const double speed = std::min(steering.speed, steering.turn_limit * kSearchRadius);
    return {{speed, -hand * speed / kSearchRadius}, 1.0};
  }
  const double wall = WallBearing(surroundings, hand);
  double bearing = hand * kPi;  // nowhere: it turns round
  for (double look = wall; look < wall + 2 * kPi; look += kLookStep) {
    if (FreeRange(surroundings, hand * look, radius) < configuration.look_ahead) continue;
    bearing = WrapAngle(hand * look);
    break;
  }
  const double ahead = FreeRange(surroundings, 0.0, radius);
  const double beside = NearestBoundary(surroundings, -hand * kPi / 2, kPi / 2).distance;
  const double error = std::abs(beside - radius) / std::max(radius, 1e-3);
  return {Steer(steering, bearing, ahead), std::min(1.0, error)};
}

bool IsUnseenNear(const Surroundings& surroundings) { return Unseen(surroundings).distance <= kUnseenNear; }

Wish EmergencyStop(const EmergencyStopConfiguration& configuration, const Pose2& pose, const Surroundings& surroundings,
                   const Twist2& wanted, EmergencyStopState& state) {
  const SteeringConfiguration& steering = configuration.steering;
  const auto turn_to = [&](double bearing) {
    const double turn = std::clamp(steering.turn_gain * bearing, -steering.turn_limit, steering.turn_limit);
    return Wish{{0.0, turn}, 1.0};
  };
  if (state.look) {
    const double bearing = WrapAngle(*state.look - pose.heading);
    if (std::abs(bearing) >= kFaced) return turn_to(bearing);
    state = {.faced = pose};
  }
  if (wanted.forward <= 0.0) return {{0.0, wanted.turn}, 0.0};
  if (FreeRange(surroundings, 0.0, PassingRadius(surroundings)) < configuration.least_way) {
    return {{0.0, wanted.turn}, 1.0};
  }
  if (!surroundings.is_vague) return {{0.0, wanted.turn}, 0.0};
  const BoundaryPoint unseen = Unseen(surroundings);
  const bool is_near = IsUnseenNear(surroundings);
  if (is_near && !HasFaced(state, pose, unseen.bearing)) {
    state.look = pose.heading + unseen.bearing;
    return turn_to(unseen.bearing);
  }
  // On a curve it comes to what the cone ahead has not seen: until it stands it may turn by so much.
  const double on_curve = kSeen * steering.braking / std::max(std::abs(wanted.turn), kStraightTurn);
  const double before_unseen =
      is_near ? configuration.creeping_speed : std::sqrt(2.0 * steering.braking * unseen.distance);
  const double forward = std::min({wanted.forward, on_curve, before_unseen});
  return {{forward, wanted.turn}, forward < wanted.forward ? 1.0 : 0.0};
}

bool WatchProgress(const EscapeConfiguration& configuration, double time_step, const Pose2& pose, Point2 goal,
                   const Surroundings& surroundings, EscapeState& state) {
  const double distance = Distance(Position(pose), goal);
  // What was before does not count where somebody has carried the robot off, or it had not known where it was.
  const bool is_elsewhere = Distance(Position(pose), state.position) > kCarried;
  if (!state.has_goal || !(state.goal == goal) || is_elsewhere) {
    state = {.has_goal = true, .goal = goal, .least_distance = distance};
  }
  state.position = Position(pose);
  if (distance < configuration.tolerance) {
    state = {};  // pushed away from there, it comes anew
    return false;
  }
  if (state.is_escaping) {
    const bool is_nearer = distance < std::max(state.stuck_distance - configuration.margin, state.stuck_distance / 2);
    const bool is_in_the_open = NearestBoundary(surroundings).distance > kBeside;
    if ((is_nearer || is_in_the_open) && IsWayFree(configuration, pose, goal, distance, surroundings)) {
      state.is_escaping = false;
      state.least_distance = distance;
      state.idle_time = 0.0;
    }
    return state.is_escaping;
  }
  if (distance < state.least_distance - configuration.progress) {
    state.least_distance = distance;
    state.idle_time = 0.0;
  } else {
    state.idle_time += time_step;
  }
  if (state.idle_time >= configuration.patience) {
    state.is_escaping = true;
    state.stuck_distance = distance;
  }
  return state.is_escaping;
}

}  // namespace runnel
