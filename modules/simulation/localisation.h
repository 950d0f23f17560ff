#pragma once

#include <optional>

#include "core/module/module.h"
#include "core/port/input.h"
#include "core/port/output.h"
#include "modules/simulation/algorithm/noise.h"
#include "modules/types/algorithm/angle.h"
#include "modules/types/pose.h"
#include "plugins/parameters/static_parameter.h"

namespace runnel {

/// What tells the robot where it is, as a localisation that does not drift would: the truth with
/// independent noise at every measurement; without deviations, the truth to the bit.
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
    noise_.emplace(seed.Get());
    return {};
  }

  void Update() override {
    const auto real = truth.Read();
    if (!real.is_new()) return;
    Pose2 measured = *real;
    measured.x += (*noise_)(position_noise.Get());
    measured.y += (*noise_)(position_noise.Get());
    const double turned = (*noise_)(heading_noise.Get());
    if (turned != 0.0) measured.heading = WrapAngle(measured.heading + turned);
    pose.Publish(measured, real.timestamp());
  }

  std::optional<GaussianNoise> noise_;
};

}  // namespace runnel
