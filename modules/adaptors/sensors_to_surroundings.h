#pragma once

#include <optional>
#include <string>
#include <utility>

#include "core/module/module.h"
#include "core/port/input.h"
#include "core/port/output.h"
#include "modules/adaptors/algorithm/adaptors.h"
#include "modules/types/contact.h"
#include "modules/types/infrared_ranges.h"
#include "modules/types/pose.h"
#include "modules/types/range_scan.h"
#include "modules/types/surroundings.h"
#include "plugins/parameters/input_timeout.h"
#include "plugins/parameters/prepares_anywhere.h"
#include "plugins/parameters/static_parameter.h"

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

 protected:
  /// Of sensors that know where the body is.
  [[nodiscard]] Result<void> CheckIsOutside(const StaticParameter<double>& body_radius) const {
    if (safe_distance.Get() > body_radius.Get()) return {};
    return Error{.message = "the safe distance, " + safe_distance.ToText() + " m, is not above the body's radius, " +
                            body_radius.ToText() + " m",
                 .path = path(),
                 .hint = "a planner keeps off by a few centimetres what it has seen or touched"};
  }

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

class LaserToSurroundings final : public SensorToSurroundings<RangeScan, LaserAdaptor, LaserAdaptorConfiguration> {
 public:
  explicit LaserToSurroundings(const Placement& placement)
      : SensorToSurroundings(placement, "scan", "from the robot's centre") {}
};

class InfraredToSurroundings final
    : public SensorToSurroundings<InfraredRanges, InfraredAdaptor, InfraredAdaptorConfiguration> {
 public:
  explicit InfraredToSurroundings(const Placement& placement)
      : SensorToSurroundings(placement, "ranges", "from the robot's centre") {}

  StaticParameter<double> body_radius{
      this,
      "body_radius",
      {.default_value = InfraredAdaptorConfiguration{}.body_radius,
       .bounds = {0.01, 10.0},
       .unit = "m",
       .description = "of the body, not more: nothing else is where it stands, and what it "
                      "drives through must be seen"}};

 private:
  [[nodiscard]] Result<InfraredAdaptorConfiguration> Configure() const override {
    if (auto good = CheckIsOutside(body_radius); !good) return good.error();
    return InfraredAdaptorConfiguration{.body_radius = body_radius.Get(), .safe_distance = safe_distance.Get()};
  }
};

/// One view for each message of the bumper, touched or not. Source: also the tactile sensor of the first
/// Bug algorithms.
class BumperToSurroundings final : public SensorToSurroundings<Contact, BumperAdaptor, BumperAdaptorConfiguration> {
 public:
  explicit BumperToSurroundings(const Placement& placement)
      : SensorToSurroundings(placement, "contact", "what the bumper says") {}

  StaticParameter<double> body_radius{this,
                                      "body_radius",
                                      {.default_value = BumperAdaptorConfiguration{}.body_radius,
                                       .bounds = {0.01, 10.0},
                                       .unit = "m",
                                       .description = "how far from the robot's centre is what it touches"}};

 private:
  [[nodiscard]] Result<BumperAdaptorConfiguration> Configure() const override {
    if (auto good = CheckIsOutside(body_radius); !good) return good.error();
    return BumperAdaptorConfiguration{.body_radius = body_radius.Get(), .safe_distance = safe_distance.Get()};
  }
};

}  // namespace runnel
