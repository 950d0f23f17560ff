#pragma once

#include <optional>
#include <stdexcept>

#include "core/module/module.h"
#include "core/port/input.h"
#include "core/port/output.h"
#include "modules/simulation/algorithm/laser_scanner.h"
#include "modules/simulation/scene.h"
#include "modules/types/pose.h"
#include "modules/types/range_scan.h"
#include "plugins/parameters/static_parameter.h"

namespace runnel {

/// A simulated laser on the robot's centre, looking ahead: a scan for each new pose. Can be made to
/// fail, for applications that are to cope with it.
class Laser final : public Module {
 public:
  using Module::Module;

  Input<Scene> scene{this, "scene", {.description = "what it looks at", .required = true}};
  Input<Pose2> pose{this, "pose", {.description = "where the robot really is", .required = true}};
  Output<RangeScan> scan{this, "scan", {.description = "in the robot's frame"}};

  StaticParameter<std::uint32_t> rays{
      this, "rays", {.default_value = 181, .bounds = {2, 100000}, .description = "of one scan"}};
  StaticParameter<double> field_of_view{this,
                                        "field_of_view",
                                        {.default_value = kPi,
                                         .bounds = {0.01, 2 * kPi},
                                         .unit = "rad",
                                         .description = "half of it on either side"}};
  StaticParameter<double> range_minimum{
      this,
      "range_minimum",
      {.default_value = 0.02, .bounds = {0.0, 100.0}, .unit = "m", .description = ""}};
  StaticParameter<double> range_maximum{
      this,
      "range_maximum",
      {.default_value = 4.0, .bounds = {0.1, 1000.0}, .unit = "m", .description = ""}};
  StaticParameter<double> noise{this,
                                "noise",
                                {.default_value = 0.0,
                                 .bounds = {0.0, 10.0},
                                 .unit = "m",
                                 .description = "standard deviation of every range"}};
  StaticParameter<std::uint64_t> seed{
      this, "seed", {.default_value = 1, .description = "of the noise"}};
  StaticParameter<double> fails_at{this,
                                   "fails_at",
                                   {.default_value = 0.0,
                                    .bounds = {0.0, 1e9},
                                    .unit = "s",
                                    .description = "from the start; 0: it does not fail"}};
  StaticParameter<double> works_again_at{this,
                                         "works_again_at",
                                         {.default_value = 0.0,
                                          .bounds = {0.0, 1e9},
                                          .unit = "s",
                                          .description = "from the start; 0: never"}};
  StaticParameter<bool> fails_loudly{
      this,
      "fails_loudly",
      {.default_value = false, .description = "by an exception; else it only falls silent"}};

 private:
  Result<void> Prepare() override {
    if (range_minimum.Get() >= range_maximum.Get()) {
      return Error{.message = "the laser sees nothing: " + range_minimum.ToText() +
                              " m, its least range, is not below " + range_maximum.ToText() +
                              " m, its greatest",
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

}  // namespace runnel
