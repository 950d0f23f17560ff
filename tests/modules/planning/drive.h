#pragma once

#include <cstdlib>
#include <fstream>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "modules/adaptors/algorithm/adaptors.h"
#include "modules/planning/algorithm/bug_algorithm.h"
#include "modules/planning/algorithm/bug_variants.h"
#include "tests/modules/planning/test_world.h"
#include "tests/modules/planning/variant_index.h"

namespace runnel {

inline void PrintTo(const BugVariant& variant, std::ostream* stream) { *stream << variant.name; }

}  // namespace runnel

namespace runnel::testing_world {

inline constexpr double kTimeStep = 0.05;
inline constexpr int kMostSteps =
    25000;  // with infrared the longest of these runs takes 21,234, as it looks before it drives

enum class Sensor { kLaser, kInfrared, kBumper };

/// A robot in a world with a sensor and its adaptor.
class Vehicle {
 public:
  Vehicle(const World& world, Sensor sensor, const Pose2& pose) : world_(world), sensor_(sensor), robot_(pose) {}

  [[nodiscard]] Surroundings Look() {
    const Pose2 pose = robot_.pose();
    if (sensor_ == Sensor::kLaser) return laser_.Update(world_.Scan(pose), pose);
    if (sensor_ == Sensor::kInfrared) return infrared_.Update(world_.Infrared(pose), pose);
    return bumper_.Update(contact_, pose);
  }
  void Drive(const Twist2& twist, double time_step) {
    if (sensor_ == Sensor::kBumper) {
      contact_ = robot_.DriveAndTouch(twist, time_step, world_);
    } else {
      robot_.Drive(twist, time_step);
    }
  }
  [[nodiscard]] const Pose2& pose() const { return robot_.pose(); }

 private:
  World world_;
  Sensor sensor_;
  Robot robot_;
  LaserAdaptor laser_;
  InfraredAdaptor infrared_;
  BumperAdaptor bumper_;
  Contact contact_;
};

struct Task {
  World world;
  Point2 start;
  Point2 goal;
  double heading = 0.0;
};

/// All but Com.
inline std::vector<BugVariant> VariantsThatEnd() {
  std::vector<BugVariant> variants(kBugVariants.begin(), kBugVariants.end());
  std::erase_if(variants, [](const BugVariant& variant) { return variant.name == "com"; });
  return variants;
}

inline bool IsVerdict(PlannerMode mode) { return mode == PlannerMode::kReached || mode == PlannerMode::kUnreachable; }

struct Outcome {
  PlannerStatus status;
  PointHistory hits;
  PointHistory leaves;
  double least_clearance = std::numeric_limits<double>::infinity();
};

/// With RUNNEL_TRAJECTORIES=<folder> every run leaves its trajectory there, for a look at it.
class Trace {
 public:
  explicit Trace(const std::string& run) {
    const char* folder = std::getenv("RUNNEL_TRAJECTORIES");
    if (folder == nullptr) return;
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    std::string name = std::string(test->test_suite_name()) + "." + test->name() + run;
    for (char& c : name) c = c == '/' ? '_' : c;
    file_.open(std::string(folder) + "/" + name + ".txt");
  }
  void Write(const Pose2& pose, const BugOutput& out, const Surroundings& surroundings) {
    if (!file_.is_open()) return;
    if (out.status.hits != hits_) {
      hits_ = out.status.hits;
      for (int sector = 0; sector < Surroundings::kSectors; ++sector) {
        const double distance = ContourDistance(surroundings, sector);
        const Point2 point = ToWorld(pose, distance * UnitVector(SectorBearing(sector)));
        file_ << "# " << hits_ << ' ' << point.x << ' ' << point.y << '\n';
      }
    }
    file_ << pose.x << ' ' << pose.y << ' ' << pose.heading << ' ' << out.twist.forward << ' ' << out.twist.turn << ' '
          << static_cast<int>(out.status.mode) << ' ' << out.status.hits << ' ' << out.status.leaves << ' '
          << out.status.path_length << '\n';
  }

 private:
  std::ofstream file_;
  std::uint32_t hits_ = 0;
};

/// A published variant.
inline BugAlgorithm Make(std::string_view variant, BoundaryDirection direction = BoundaryDirection::kLeft) {
  BugConfiguration configuration;
  configuration.first_direction = direction;
  BugComposition composition = kBugVariants.at(VariantIndex(variant)).composition;
  if (composition.direction == DirectionKind::kLeft && direction == BoundaryDirection::kRight) {
    composition.direction = DirectionKind::kRight;
  }
  return BugAlgorithm(configuration, Assemble(composition));
}

inline Outcome Drive(std::string_view variant, BoundaryDirection direction, Sensor sensor, const Task& task,
                     const std::string& run = "") {
  const BugAlgorithm algorithm = Make(variant, direction);
  Vehicle vehicle(task.world, sensor, {task.start.x, task.start.y, task.heading});
  BugState state;
  Outcome outcome;
  Trace trace(run);
  for (int step = 0; step < kMostSteps; ++step) {
    const Pose2 pose = vehicle.pose();
    const Surroundings surroundings = vehicle.Look();
    const BugOutput out = algorithm.Update(state, {kTimeStep, pose, surroundings, task.start, task.goal});
    trace.Write(pose, out, surroundings);
    outcome.status = out.status;
    outcome.least_clearance = std::min(outcome.least_clearance, task.world.Clearance(Position(pose)));
    if (IsVerdict(out.status.mode)) break;
    vehicle.Drive(out.twist, kTimeStep);
  }
  outcome.hits = state.hits;
  outcome.leaves = state.leaves;
  return outcome;
}

}  // namespace runnel::testing_world
