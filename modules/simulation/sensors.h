#pragma once

#include <optional>
#include <stdexcept>
#include <string>

#include "core/module/module.h"
#include "core/port/input.h"
#include "core/port/output.h"
#include "modules/simulation/algorithm/camera_picture.h"
#include "modules/simulation/algorithm/random.h"
#include "modules/simulation/algorithm/range_sensors.h"
#include "modules/simulation/scene.h"
#include "modules/types/algorithm/angle.h"
#include "modules/types/measurements.h"
#include "modules/types/pose.h"
#include "plugins/parameters/parameter.h"
#include "plugins/parameters/prepares_anywhere.h"

namespace runnel {

namespace internal {

inline ParameterOptions<double> Deviation(const char* of, const char* unit, double most) {
  return {.bounds = {0.0, most}, .unit = unit, .description = std::string("standard deviation of ") + of};
}
inline ParameterOptions<double> SinceStart(const char* zero) {
  return {.bounds = {0.0, 1e9}, .unit = "s", .description = std::string("from the start; 0: ") + zero};
}

/// Looks at the scene from where the robot is.
class SceneSensor : public Module {
 public:
  using Module::Module;

  Input<Scene> scene{this, "scene", {.description = "what it looks at", .required = true}};
  Input<Pose2> pose{this, "pose", {.description = "where the robot really is", .required = true}};
};

}  // namespace internal

/// A simulated laser on the robot's centre, looking ahead: a scan for each new pose. Can be made to
/// fail, for applications that are to cope with it.
class Laser final : public internal::SceneSensor, public PreparesAnywhere {
 public:
  using SceneSensor::SceneSensor;

  Output<RangeScan> scan{this, "scan", {.description = "in the robot's frame"}};

  StaticParameter<std::uint32_t> rays{
      this, "rays", {.default_value = 181, .bounds = {2, 100000}, .description = "of one scan"}};
  StaticParameter<double> field_of_view{
      this,
      "field_of_view",
      {.default_value = kPi, .bounds = {0.01, 2 * kPi}, .unit = "rad", .description = "half of it on either side"}};
  StaticParameter<double> range_minimum{
      this, "range_minimum", {.default_value = 0.02, .bounds = {0.0, 100.0}, .unit = "m"}};
  StaticParameter<double> range_maximum{
      this, "range_maximum", {.default_value = 4.0, .bounds = {0.1, 1000.0}, .unit = "m"}};
  StaticParameter<double> noise{this, "noise", internal::Deviation("every range", "m", 10.0)};
  StaticParameter<std::uint64_t> seed{this, "seed", {.default_value = 1, .description = "of the noise"}};
  StaticParameter<double> fails_at{this, "fails_at", internal::SinceStart("it does not fail")};
  StaticParameter<double> works_again_at{this, "works_again_at", internal::SinceStart("never")};
  StaticParameter<bool> fails_loudly{
      this, "fails_loudly", {.default_value = false, .description = "by an exception; else it only falls silent"}};

 private:
  Result<void> Prepare() override {
    if (range_minimum.Get() >= range_maximum.Get()) {
      return Error{.message = "the laser sees nothing: " + range_minimum.ToText() +
                              " m, its least range, is not below " + range_maximum.ToText() + " m, its greatest",
                   .path = path()};
    }
    scan.PrepareBuffers([this](RangeScan& buffer) { buffer.ranges.reserve(rays.Get()); });
    scanner_.emplace(LaserScannerOptions{.rays = rays.Get(),
                                         .field_of_view = field_of_view.Get(),
                                         .range_minimum = range_minimum.Get(),
                                         .range_maximum = range_maximum.Get(),
                                         .standard_deviation = noise.Get(),
                                         .seed = seed.Get()});
    return {};
  }

  void Update() override {
    if (!started_) started_ = now();
    if (HasFailed()) {
      if (fails_loudly.Get()) throw std::runtime_error("the laser does not answer any more");
      return;
    }
    const auto at = pose.Read();
    const auto seen = scene.Read();
    if (!at.is_new() || !seen) return;
    auto loan = scan.Loan();
    scanner_->Scan(*seen->rays, *at, *loan);
    scan.Publish(std::move(loan), at.timestamp());
  }

  [[nodiscard]] bool HasFailed() const {
    if (fails_at.Get() <= 0) return false;
    const double running = ToSeconds(now() - *started_);
    const bool works_again = works_again_at.Get() > 0 && running >= works_again_at.Get();
    return running >= fails_at.Get() && !works_again;
  }

  std::optional<LaserScanner> scanner_;
  std::optional<Time> started_;
};

/// Three simulated infrared rangers on the robot's centre, looking ahead, to the left and to the
/// right: a measurement for each new pose.
class Infrared final : public internal::SceneSensor {
 public:
  using SceneSensor::SceneSensor;

  Output<InfraredRanges> ranges{this, "ranges", {.description = "from the robot's centre"}};

  StaticParameter<double> field_of_view{this,
                                        "field_of_view",
                                        {.default_value = DegreesToRadians(26),
                                         .bounds = {0.01, kPi / 2},
                                         .unit = "rad",
                                         .description = "the whole angle of each cone"}};
  StaticParameter<double> range_maximum{
      this, "range_maximum", {.default_value = 2.0, .bounds = {0.1, 100.0}, .unit = "m"}};
  StaticParameter<double> noise{this, "noise", internal::Deviation("every range", "m", 10.0)};
  StaticParameter<std::uint64_t> seed{this, "seed", {.default_value = 1, .description = "of the noise"}};

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

/// A simulated camera on the robot's centre, looking ahead: a picture for each new pose, while somebody looks at
/// `image` or it is connected.
class Camera final : public internal::SceneSensor {
 public:
  using SceneSensor::SceneSensor;

  Output<Image> image{this, "image", {.description = "rgb8, while somebody looks"}};

  StaticParameter<std::uint32_t> width{
      this, "width", {.default_value = 160, .bounds = {8, 4096}, .description = "pixels"}};
  StaticParameter<std::uint32_t> height{
      this, "height", {.default_value = 120, .bounds = {8, 4096}, .description = "pixels"}};
  StaticParameter<double> field_of_view{
      this,
      "field_of_view",
      {.default_value = kPi / 2, .bounds = {0.1, 3.0}, .unit = "rad", .description = "half of it on either side"}};
  StaticParameter<double> range{
      this,
      "range",
      {.default_value = 30.0, .bounds = {0.1, 1000.0}, .unit = "m", .description = "what is beyond is sky"}};

 private:
  Result<void> Prepare() override {
    options_ = {
        .width = width.Get(), .height = height.Get(), .field_of_view = field_of_view.Get(), .range = range.Get()};
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

/// A bumper all round the body: says that it is touched, and goes on saying so for a while, as a
/// switch with a spring does. Runs in the thread of the world, or it may miss a short touch.
class Bumper final : public Module {
 public:
  using Module::Module;

  Input<Contact> truth{this, "truth", {.description = "what the body touches", .required = true}};
  Output<Contact> contact{this, "contact", {.description = "what the bumper says"}};

  Parameter<double> hold{this,
                         "hold",
                         {.default_value = 0.2,
                          .bounds = {0.0, 60.0},
                          .unit = "s",
                          .description = "how long it stays pressed after a touch"}};

 private:
  void Update() override {
    const auto real = truth.Read();
    if (!real.is_new()) return;
    if (real->is_touching) {
      last_ = *real;
      released_ = now() + FromSeconds(hold.Get());
    }
    const bool is_held = released_ && now() < *released_;
    contact.Publish(real->is_touching || is_held ? last_ : Contact{});
  }

  Contact last_;
  std::optional<Time> released_;
};

/// What tells the robot where it is, as a localisation that does not drift would: the truth with
/// independent noise at every measurement; without deviations, the truth to the bit.
class Localisation final : public Module {
 public:
  using Module::Module;

  Input<Pose2> truth{this, "truth", {.description = "where the robot really is", .required = true}};
  Output<Pose2> pose{this, "pose", {.description = "where it believes to be, world's frame"}};

  StaticParameter<double> position_noise{this, "position_noise", internal::Deviation("x and y", "m", 10.0)};
  StaticParameter<double> heading_noise{this, "heading_noise", internal::Deviation("the heading", "rad", 3.0)};
  StaticParameter<std::uint64_t> seed{this, "seed", {.default_value = 1, .description = "of the noise"}};

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
