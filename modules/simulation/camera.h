#pragma once

#include "core/module/module.h"
#include "core/port/input.h"
#include "core/port/output.h"
#include "modules/simulation/algorithm/camera_picture.h"
#include "modules/simulation/scene.h"
#include "modules/types/image.h"
#include "modules/types/pose.h"
#include "plugins/parameters/static_parameter.h"

namespace runnel {

/// A simulated camera on the robot's centre, looking ahead: a picture for each new pose, while somebody looks at
/// `image` or it is connected.
class Camera final : public Module {
 public:
  using Module::Module;

  Input<Scene> scene{this, "scene", {.description = "what it looks at", .required = true}};
  Input<Pose2> pose{this, "pose", {.description = "where the robot really is", .required = true}};
  Output<Image> image{this, "image", {.description = "rgb8, while somebody looks"}};

  StaticParameter<std::uint32_t> width{
      this, "width", {.default_value = 160, .bounds = {8, 4096}, .description = "pixels"}};
  StaticParameter<std::uint32_t> height{
      this, "height", {.default_value = 120, .bounds = {8, 4096}, .description = "pixels"}};
  StaticParameter<double> field_of_view{this,
                                        "field_of_view",
                                        {.default_value = kPi / 2,
                                         .bounds = {0.1, 3.0},
                                         .unit = "rad",
                                         .description = "half of it on either side"}};
  StaticParameter<double> range{this,
                                "range",
                                {.default_value = 30.0,
                                 .bounds = {0.1, 1000.0},
                                 .unit = "m",
                                 .description = "what is further away is lost in the sky"}};

 private:
  Result<void> Prepare() override {
    options_ = {.width = width.Get(),
                .height = height.Get(),
                .field_of_view = field_of_view.Get(),
                .range = range.Get()};
    image.PrepareBuffers([this](Image& buffer) {
      buffer.encoding = "rgb8";
      buffer.data.reserve(std::size_t{3} * options_.width * options_.height);
    });
    return {};
  }

  void Update() override {
    const auto at = pose.Read();
    const auto seen = scene.Read();
    if (!at.is_new() || !seen || !image.is_watched()) return;
    auto loan = image.Loan();
    if (!loan) return;
    TakePicture(*seen->rays, *at, options_, *loan);
    image.Publish(std::move(loan), at.timestamp());
  }

  CameraOptions options_;
};

}  // namespace runnel
