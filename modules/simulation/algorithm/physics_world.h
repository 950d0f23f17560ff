#pragma once

#include <memory>

#include "modules/simulation/algorithm/world.h"
#include "modules/types/algorithm/measurements.h"
#include "modules/types/algorithm/pose.h"

namespace runnel {

struct PhysicsOptions {
  RobotOptions robot;
  double step = 0.005;  ///< s, of the physics; every call of Advance is made of whole steps
  /// s, that one call of Advance makes up for at most: 12,000 steps, some 20 ms of computing. Time
  /// beyond that is lost, as if the world had stood still: a machine that was suspended for an hour
  /// goes on where it was, and no cycle lasts for minutes.
  double longest_advance = 60.0;
};

/// A robot driving in a world, by rigid-body dynamics (Bullet): wheels push it with bounded force,
/// obstacles stop it, and it stays level on the ground.
///
/// The wheels are a constraint that the solver meets together with the contacts: each wheel's rim
/// shall move over the ground with the commanded speed, with no more force than the wheel has, and
/// the body shall not move sideways, with no more force than the grip. So a robot pushing into a
/// wall stands, with its wheels held; driving along a wall it slides.
///
/// Deterministic: the same world, options and calls give the same bits, in any thread and beside
/// any number of other PhysicsWorlds.
/// Threads: not thread-safe. Different worlds may live in different threads.
/// Precondition: the world has no faults (FaultsOf) and the start has ClearanceAt of the robot's
/// radius, or else the robot is pushed out of what it sticks in.
class PhysicsWorld {
 public:
  explicit PhysicsWorld(const World& world, const PhysicsOptions& options = {});
  ~PhysicsWorld();

  /// What the wheels shall do from now on (rad/s). Beyond the robot's limits both are slowed down
  /// by the same factor, so that the curve stays the same. What is no finite number counts as 0.
  void SetWheelSpeeds(const WheelSpeeds& speeds);

  /// Lets time pass (s, not negative), no more than the longest advance. What is left over after the
  /// last whole step is kept for the next call.
  void Advance(double duration);

  [[nodiscard]] double elapsed() const noexcept;            ///< s, in whole steps
  [[nodiscard]] Pose2 pose() const noexcept;                ///< of the robot's centre, in the world's frame
  [[nodiscard]] Twist2 twist() const noexcept;              ///< how it really moves
  [[nodiscard]] WheelSpeeds wheel_speeds() const noexcept;  ///< how the wheels really turn
  /// Whether anything was touched during the last Advance that made a step, and where last.
  [[nodiscard]] Contact contact() const noexcept;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace runnel
