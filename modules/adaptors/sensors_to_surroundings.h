#pragma once

#include <optional>
#include <string>
#include <utility>

#include "core/module/module.h"
#include "core/port/input.h"
#include "core/port/output.h"
#include "modules/adaptors/algorithm/adaptors.h"
#include "modules/types/measurements.h"
#include "modules/types/pose.h"
#include "modules/types/surroundings.h"
#include "plugins/parameters/input_timeout.h"
#include "plugins/parameters/parameter.h"
#include "plugins/parameters/prepares_anywhere.h"

namespace runnel {

/// Turns what a sensor measures into what planners are told of the obstacles: one view for each new
/// measurement, as soon as the pose is known. Source: the sensing abstractions of the generic Bug
/// algorithm.
template <typename Measurement, typename Adaptor, typename Configuration>
class SensorToSurroundings : public Module, public PreparesAnywhere {
 public:
  /// `port`: the name of the input for what is measured.
  SensorToSurroundings(const Placement& placement, std::string port, std::string description)
      : Module(placement), measurement(this, std::move(port), Measured(std::move(description))) {}

  Input<Measurement> measurement;
  Input<Pose2> pose{this, "pose", Measured("where it was measured")};
  Output<Surroundings> surroundings{this, "surroundings", {.description = "in the robot's frame"}};

  StaticParameter<double> safe_distance{this,
                                        "safe_distance",
                                        {.default_value = Configuration{}.safe_distance,
                                         .bounds = {0.05, 10.0},
                                         .unit = "m",
                                         .description = "how near the robot's centre may come to a boundary"}};
  InputTimeout measurement_timeout{this, measurement, {.log = &log()}};
  InputTimeout pose_timeout{this, pose, {.log = &log()}};

 private:
  [[nodiscard]] virtual Result<Configuration> Configure() const {
    return Configuration{.safe_distance = safe_distance.Get()};
  }

  Result<void> Prepare() override {
    const Result<Configuration> configuration = Configure();
    if (!configuration) return configuration.error();
    adaptor_.emplace(*configuration);
    return {};
  }

  void Update() override {
    const auto measured = measurement_timeout.Read(measurement, now());
    const auto at = pose_timeout.Read(pose, now());
    if (measured.is_new() && at) surroundings.Publish(adaptor_->Update(*measured, *at));
  }

  std::optional<Adaptor> adaptor_;
};

/// Of sensors that know where the body is.
template <typename Measurement, typename Adaptor, typename Configuration>
class BodySensorToSurroundings : public SensorToSurroundings<Measurement, Adaptor, Configuration> {
 public:
  /// `radius`: what the radius of the body is for.
  BodySensorToSurroundings(const Placement& placement, std::string port, std::string description, std::string radius)
      : SensorToSurroundings<Measurement, Adaptor, Configuration>(placement, std::move(port), std::move(description)),
        body_radius(this, "body_radius",
                    {.default_value = Configuration{}.body_radius,
                     .bounds = {0.01, 10.0},
                     .unit = "m",
                     .description = std::move(radius)}) {}

  StaticParameter<double> body_radius;

 private:
  [[nodiscard]] Result<Configuration> Configure() const override {
    const StaticParameter<double>& distance = this->safe_distance;
    if (distance.Get() > body_radius.Get()) {
      return Configuration{.body_radius = body_radius.Get(), .safe_distance = distance.Get()};
    }
    return Error{.message = "the safe distance, " + distance.ToText() + " m, is not above the body's radius, " +
                            body_radius.ToText() + " m",
                 .path = this->path(),
                 .hint = "a planner keeps off by a few centimetres what it has seen or touched"};
  }
};

class LaserToSurroundings final : public SensorToSurroundings<RangeScan, LaserAdaptor, LaserAdaptorConfiguration> {
 public:
  explicit LaserToSurroundings(const Placement& placement)
      : SensorToSurroundings(placement, "scan", "from the robot's centre") {}
};

class InfraredToSurroundings final
    : public BodySensorToSurroundings<InfraredRanges, InfraredAdaptor, InfraredAdaptorConfiguration> {
 public:
  explicit InfraredToSurroundings(const Placement& placement)
      : BodySensorToSurroundings(placement, "ranges", "from the robot's centre",
                                 "of the body, not more: nothing else is where it stands, and what it drives through "
                                 "must be seen") {}
};

/// One view for each message of the bumper, touched or not. Source: also the tactile sensor of the first
/// Bug algorithms.
class BumperToSurroundings final : public BodySensorToSurroundings<Contact, BumperAdaptor, BumperAdaptorConfiguration> {
 public:
  explicit BumperToSurroundings(const Placement& placement)
      : BodySensorToSurroundings(placement, "contact", "what the bumper says",
                                 "how far from the robot's centre is what it touches") {}
};

}  // namespace runnel
