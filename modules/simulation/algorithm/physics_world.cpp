#include "modules/simulation/algorithm/physics_world.h"

#include <algorithm>
#include <cmath>

#include <btBulletDynamicsCommon.h>

#include "modules/simulation/algorithm/internal/bullet_obstacles.h"
#include "modules/simulation/algorithm/outline.h"
#include "modules/types/algorithm/angle.h"

namespace runnel {

namespace internal {

/// Two driven wheels as three rows of Bullet's constraint solver: the ground speed of the left
/// wheel, that of the right one, and no speed sideways.
class WheelConstraint final : public btTypedConstraint {
 public:
  /// `ground` is any fixed body: Bullet's own one is shared by all worlds of the process.
  WheelConstraint(btRigidBody& body, btRigidBody& ground, const RobotOptions& robot)
      : btTypedConstraint(D6_CONSTRAINT_TYPE, body, ground), robot_(robot) {}

  /// Within the limits of the robot already.
  void set_target(const WheelSpeeds& speeds) { target_ = speeds; }
  /// For one step: the direction in which the wheels roll during it (rad), and its duration (s).
  void Prepare(double rolling_direction, double step) {
    rolling_direction_ = rolling_direction;
    step_ = step;
  }

  void getInfo1(btConstraintInfo1* info) override {
    info->m_numConstraintRows = 3;
    info->nub = 0;
  }
  void getInfo2(btConstraintInfo2* info) override {
    const double c = std::cos(rolling_direction_), s = std::sin(rolling_direction_);
    const btVector3 ahead(c, s, 0), left(-s, c, 0);
    const double arm = robot_.track / 2, radius = robot_.wheel_radius;
    FillRow(info, 0, ahead, -arm, radius * target_.left, robot_.maximum_wheel_force);
    FillRow(info, 1, ahead, arm, radius * target_.right, robot_.maximum_wheel_force);
    FillRow(info, 2, left, 0.0, 0.0, robot_.maximum_grip);
  }
  void setParam(int, btScalar, int) override {}
  btScalar getParam(int, int) const override { return 0; }

 private:
  /// velocity * direction + turn rate * lever shall be `speed`; limits are impulses.
  void FillRow(btConstraintInfo2* info, int row, const btVector3& direction, double lever, double speed,
               double force) const {
    const int first = row * info->rowskip;
    for (int axis = 0; axis < 3; ++axis) info->m_J1linearAxis[first + axis] = direction[axis];
    info->m_J1angularAxis[first + 2] = lever;
    info->m_constraintError[first] = speed;
    info->m_lowerLimit[first] = -force * step_;
    info->m_upperLimit[first] = force * step_;
  }

  const RobotOptions robot_;
  WheelSpeeds target_;
  double rolling_direction_ = 0.0;
  double step_ = 0.0;
};

}  // namespace internal

namespace {

constexpr double kTouchDistance = 1e-3;  // m, within which a bumper is pressed
constexpr double kBroadphaseMargin = 5.0;

btVector3 ToBullet(Point2 point, double z) { return {point.x, point.y, z}; }

/// A box round the world for the sweep. Outside of it everything still collides, only slower.
std::pair<btVector3, btVector3> BroadphaseExtent(const World& world) {
  const auto [low, high] = ExtentOf(world);
  const btVector3 margin(kBroadphaseMargin, kBroadphaseMargin, kBroadphaseMargin);
  return {ToBullet(low, -1.0) - margin, ToBullet(high, 1.0) + margin};
}

unsigned int GreatestCountOfObjects(const World& world) {
  constexpr std::size_t kRobotAndCrowd = 32;
  std::size_t count = kRobotAndCrowd + world.boxes.size() + world.cylinders.size();
  for (const WallObstacle& wall : world.walls) count += 2 * wall.points.size();
  return static_cast<unsigned int>(count);
}

WheelSpeeds Limited(WheelSpeeds speeds, const RobotOptions& robot) {
  if (!std::isfinite(speeds.left)) speeds.left = 0.0;
  if (!std::isfinite(speeds.right)) speeds.right = 0.0;
  const double left = robot.wheel_radius * speeds.left, right = robot.wheel_radius * speeds.right;
  const double speed = std::abs(left / 2 + right / 2);
  const double turn_rate = std::abs(right / robot.track - left / robot.track);
  const double excess = std::max({1.0, speed / robot.maximum_speed, turn_rate / robot.maximum_turn_rate});
  return {speeds.left / excess, speeds.right / excess};
}

btRigidBody::btRigidBodyConstructionInfo BodyInfo(const RobotOptions& robot, btCollisionShape* shape) {
  btVector3 inertia;
  shape->calculateLocalInertia(robot.mass, inertia);
  btRigidBody::btRigidBodyConstructionInfo info(robot.mass, nullptr, shape, inertia);
  info.m_friction = robot.wall_friction;
  return info;
}

}  // namespace

struct PhysicsWorld::State {
  State(const World& description, const PhysicsOptions& physics_options)
      : options(physics_options),
        extent(BroadphaseExtent(description)),
        dispatcher(&configuration),
        broadphase(extent.first, extent.second, GreatestCountOfObjects(description), nullptr, true),
        world(&dispatcher, &broadphase, &solver, &configuration),
        obstacles(description, kDefaultObstacleHeight),
        shape(btVector3(options.robot.radius, options.robot.radius, options.robot.height / 2)),
        robot(BodyInfo(options.robot, &shape)),
        ground(0, nullptr, nullptr),
        wheels(robot, ground, options.robot) {
    SetUpSolver();
    SetUpRobot(description.start);
    Rehearse(description.start);
    obstacles.AddTo(world);
  }

  ~State() {
    world.removeConstraint(&wheels);
    world.removeRigidBody(&robot);
    obstacles.RemoveFrom(world);
  }

  State(const State&) = delete;
  State& operator=(const State&) = delete;

  void SetUpSolver() {
    world.setGravity(btVector3(0, 0, 0));                          // the ground carries the robot; nothing else moves
    world.getSolverInfo().m_solverMode = SOLVER_USE_WARMSTARTING;  // one code path for all CPUs
    world.getSolverInfo().m_numIterations = 20;
    solver.setRandSeed(0);
  }

  void SetUpRobot(const Pose2& start) {
    PlaceRobot(start);
    robot.setLinearFactor(btVector3(1, 1, 0));
    robot.setAngularFactor(btVector3(0, 0, 1));
    robot.setActivationState(DISABLE_DEACTIVATION);
    robot.setDamping(0, 0);
    world.addRigidBody(&robot);
    world.addConstraint(&wheels);
  }

  /// At rest.
  void PlaceRobot(const Pose2& start) {
    const double z = options.robot.ground_clearance + options.robot.height / 2;
    const btTransform place(btQuaternion(btVector3(0, 0, 1), start.heading), ToBullet(Position(start), z));
    robot.setWorldTransform(place);
    robot.setInterpolationWorldTransform(place);
    robot.setLinearVelocity(btVector3(0, 0, 0));
    robot.setAngularVelocity(btVector3(0, 0, 0));
  }

  /// Bullet's lists grow when they first need to: here, among more contacts than any world makes,
  /// rather than in the middle of a run.
  void Rehearse(const Pose2& start) {
    World crowd{.start = start, .polygons = {{}}};
    for (int i = 0; i < 12; ++i) {
      const double angle = i * kPi / 6;
      const Point2 place = Position(start) + options.robot.radius * UnitVector(angle);
      crowd.polygons[0].outline.push_back(place);
      crowd.boxes.push_back({.pose = {place.x, place.y, angle}, .length = 0.01, .width = 0.05});
    }
    const internal::BulletObstacles obstacles_of_crowd(crowd, kDefaultObstacleHeight);
    obstacles_of_crowd.AddTo(world);
    for (int i = 0; i < 3; ++i) Step();
    obstacles_of_crowd.RemoveFrom(world);
    solver.reset();
    PlaceRobot(start);
    steps = 0;
    rolling_direction = start.heading;
    contact = {};
  }

  double Heading() const {
    const btMatrix3x3& basis = robot.getWorldTransform().getBasis();
    return std::atan2(basis[1][0], basis[0][0]);
  }

  void Step() {
    // The wheels roll along the middle of the arc of this step, not along its start.
    rolling_direction = Heading() + robot.getAngularVelocity().z() * options.step / 2;
    wheels.Prepare(rolling_direction, options.step);
    world.stepSimulation(options.step, 0);
    ++steps;
    LookForContact();
  }

  void LookForContact() {
    const btManifoldPoint* strongest = nullptr;
    bool robot_is_first = false;
    for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
      const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(i);
      for (int p = 0; p < manifold.getNumContacts(); ++p) {
        const btManifoldPoint& point = manifold.getContactPoint(p);
        if (point.getAppliedImpulse() <= 0.0 && point.getDistance() > kTouchDistance) continue;
        if (strongest && point.getAppliedImpulse() <= strongest->getAppliedImpulse()) continue;
        strongest = &point;
        robot_is_first = manifold.getBody0() == &robot;
      }
    }
    if (strongest == nullptr) return;
    const btVector3& place = robot_is_first ? strongest->getPositionWorldOnA() : strongest->getPositionWorldOnB();
    const btVector3 offset = place - robot.getWorldTransform().getOrigin();
    contact = {true, WrapAngle(Direction({offset.x(), offset.y()}) - Heading())};
  }

  const PhysicsOptions options;
  const std::pair<btVector3, btVector3> extent;
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher;
  // Not Bullet's usual tree, which swaps its nodes by their addresses as it keeps itself balanced:
  // the order of pairs, and with it the last digits of a solution, could differ from run to run.
  bt32BitAxisSweep3 broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world;
  internal::BulletObstacles obstacles;
  btCylinderShapeZ shape;
  btRigidBody robot;
  btRigidBody ground;
  internal::WheelConstraint wheels;

  std::int64_t steps = 0;
  double time_left_over = 0.0;
  double rolling_direction = 0.0;
  Contact contact;
};

PhysicsWorld::PhysicsWorld(const World& world, const PhysicsOptions& options)
    : state_(std::make_unique<State>(world, options)) {}
PhysicsWorld::~PhysicsWorld() = default;

void PhysicsWorld::SetWheelSpeeds(const WheelSpeeds& speeds) {
  state_->wheels.set_target(Limited(speeds, state_->options.robot));
}

void PhysicsWorld::Advance(double duration) {
  const double step = state_->options.step;
  const double least = 0.999 * step;  // durations are rarely whole in binary digits
  state_->time_left_over += std::min(duration, state_->options.longest_advance);
  if (state_->time_left_over > least) state_->contact = {};
  while (state_->time_left_over > least) {
    state_->Step();
    state_->time_left_over -= step;
  }
}

double PhysicsWorld::elapsed() const noexcept { return static_cast<double>(state_->steps) * state_->options.step; }

Pose2 PhysicsWorld::pose() const noexcept {
  const btVector3& origin = state_->robot.getWorldTransform().getOrigin();
  return {origin.x(), origin.y(), state_->Heading()};
}

Twist2 PhysicsWorld::twist() const noexcept {
  const btVector3& velocity = state_->robot.getLinearVelocity();
  return {Dot({velocity.x(), velocity.y()}, UnitVector(state_->rolling_direction)),
          state_->robot.getAngularVelocity().z()};
}

WheelSpeeds PhysicsWorld::wheel_speeds() const noexcept {
  const RobotOptions& robot = state_->options.robot;
  const auto [forward, turn] = twist();
  const double difference = turn * robot.track / 2;
  return {(forward - difference) / robot.wheel_radius, (forward + difference) / robot.wheel_radius};
}

Contact PhysicsWorld::contact() const noexcept { return state_->contact; }

}  // namespace runnel
