#pragma once

#include <optional>

#include "core/module/module.h"
#include "core/port/input.h"
#include "core/port/output.h"
#include "modules/adaptors/algorithm/infrared_adaptor.h"
#include "modules/types/infrared_ranges.h"
#include "modules/types/pose.h"
#include "modules/types/surroundings.h"
#include "plugins/parameters/static_parameter.h"

namespace runnel {

/// Turns the echoes of three infrared rangers into what planners are told of the obstacles: one
/// view for each new measurement. Source: the sensing abstractions of the generic Bug algorithm.
class InfraredToSurroundings final : public Module {
 public:
  using Module::Module;

  Input<InfraredRanges> ranges{
      this, "ranges", {.description = "from the robot's centre", .required = true}};
  Input<Pose2> pose{this, "pose", {.description = "where they were taken", .required = true}};
  Output<Surroundings> surroundings{this, "surroundings", {.description = "in the robot's frame"}};

  StaticParameter<double> safe_distance{
      this,
      "safe_distance",
      {.default_value = InfraredAdaptorConfiguration{}.safe_distance,
       .bounds = {0.05, 10.0},
       .unit = "m",
       .description = "how near the robot's centre may come to a boundary"}};

 private:
  Result<void> Prepare() override {
    adaptor_.emplace(InfraredAdaptorConfiguration{.safe_distance = safe_distance.Get()});
    return {};
  }

  void Update() override {
    const auto seen = ranges.Read();
    const auto at = pose.Read();
    if (seen.is_new() && at) surroundings.Publish(adaptor_->Update(*seen, *at));
  }

  std::optional<InfraredAdaptor> adaptor_;
};

}  // namespace runnel
