#pragma once

#include <optional>

#include "core/module/module.h"
#include "core/port/input.h"
#include "core/port/output.h"
#include "modules/simulation/algorithm/infrared_sensor.h"
#include "modules/simulation/scene.h"
#include "modules/types/infrared_ranges.h"
#include "modules/types/pose.h"
#include "plugins/parameters/static_parameter.h"

namespace runnel {

/// Three simulated infrared rangers on the robot's centre, looking ahead, to the left and to the
/// right: a measurement for each new pose.
class Infrared final : public Module {
 public:
  using Module::Module;

  Input<Scene> scene{this, "scene", {.description = "what it looks at", .required = true}};
  Input<Pose2> pose{this, "pose", {.description = "where the robot really is", .required = true}};
  Output<InfraredRanges> ranges{this, "ranges", {.description = "from the robot's centre"}};

  StaticParameter<double> field_of_view{this,
                                        "field_of_view",
                                        {.default_value = DegreesToRadians(26),
                                         .bounds = {0.01, kPi / 2},
                                         .unit = "rad",
                                         .description = "the whole angle of each cone"}};
  StaticParameter<double> range_maximum{
      this,
      "range_maximum",
      {.default_value = 2.0, .bounds = {0.1, 100.0}, .unit = "m", .description = ""}};
  StaticParameter<double> noise{this,
                                "noise",
                                {.default_value = 0.0,
                                 .bounds = {0.0, 10.0},
                                 .unit = "m",
                                 .description = "standard deviation of every range"}};
  StaticParameter<std::uint64_t> seed{
      this, "seed", {.default_value = 1, .description = "of the noise"}};

 private:
  Result<void> Prepare() override {
    sensor_.emplace(InfraredSensorOptions{.field_of_view = field_of_view.Get(),
                                          .range_maximum = range_maximum.Get(),
                                          .standard_deviation = noise.Get(),
                                          .seed = seed.Get()});
    return {};
  }

  void Update() override {
    const auto at = pose.Read();
    const auto seen = scene.Read();
    if (at.is_new() && seen) ranges.Publish(sensor_->Measure(*seen->rays, *at), at.timestamp());
  }

  std::optional<InfraredSensor> sensor_;
};

}  // namespace runnel
