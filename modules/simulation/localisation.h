#pragma once

#include <optional>

#include "core/module/module.h"
#include "core/port/input.h"
#include "core/port/output.h"
#include "modules/simulation/algorithm/noisy_pose.h"
#include "modules/types/pose.h"
#include "plugins/parameters/static_parameter.h"

namespace runnel {

/// What tells the robot where it is: the truth, perfect unless noise is asked for.
class Localisation final : public Module {
 public:
  using Module::Module;

  Input<Pose2> truth{this, "truth", {.description = "where the robot really is", .required = true}};
  Output<Pose2> pose{this, "pose", {.description = "where it believes to be, world's frame"}};

  StaticParameter<double> position_noise{this,
                                         "position_noise",
                                         {.default_value = 0.0,
                                          .bounds = {0.0, 10.0},
                                          .unit = "m",
                                          .description = "standard deviation of x and y"}};
  StaticParameter<double> heading_noise{this,
                                        "heading_noise",
                                        {.default_value = 0.0,
                                         .bounds = {0.0, 3.0},
                                         .unit = "rad",
                                         .description = "standard deviation of the heading"}};
  StaticParameter<std::uint64_t> seed{
      this, "seed", {.default_value = 1, .description = "of the noise"}};

 private:
  Result<void> Prepare() override {
    noise_.emplace(NoisyPoseOptions{.position_deviation = position_noise.Get(),
                                    .heading_deviation = heading_noise.Get(),
                                    .seed = seed.Get()});
    return {};
  }

  void Update() override {
    if (const auto real = truth.Read(); real.is_new()) pose.Publish(noise_->Measure(*real));
  }

  std::optional<NoisyPose> noise_;
};

}  // namespace runnel
