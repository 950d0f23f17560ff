#pragma once

#include <optional>

#include "core/module/module.h"
#include "core/port/input.h"
#include "core/port/output.h"
#include "modules/adaptors/algorithm/bumper_adaptor.h"
#include "modules/types/contact.h"
#include "modules/types/pose.h"
#include "modules/types/surroundings.h"
#include "plugins/parameters/static_parameter.h"

namespace runnel {

/// Turns what a bumper feels into what planners are told of the obstacles: one view for each new
/// message of the bumper, touched or not. Source: the sensing abstractions of the generic Bug
/// algorithm, and the tactile sensor of the first Bug algorithms.
class BumperToSurroundings final : public Module {
 public:
  using Module::Module;

  Input<Contact> contact{
      this, "contact", {.description = "what the bumper says", .required = true}};
  Input<Pose2> pose{this, "pose", {.description = "where it was felt", .required = true}};
  Output<Surroundings> surroundings{this, "surroundings", {.description = "in the robot's frame"}};

  StaticParameter<double> body_radius{
      this,
      "body_radius",
      {.default_value = BumperAdaptorConfiguration{}.body_radius,
       .bounds = {0.01, 10.0},
       .unit = "m",
       .description = "how far from the robot's centre is what it touches"}};
  StaticParameter<double> safe_distance{
      this,
      "safe_distance",
      {.default_value = BumperAdaptorConfiguration{}.safe_distance,
       .bounds = {0.05, 10.0},
       .unit = "m",
       .description = "how near the robot's centre may come to what it touched before"}};

 private:
  Result<void> Prepare() override {
    if (safe_distance.Get() <= body_radius.Get()) {
      return Error{.message = "the safe distance, " + safe_distance.ToText() +
                              " m, is not above the body's radius, " + body_radius.ToText() + " m",
                   .path = path(),
                   .hint = "a planner keeps off by a few centimetres what it has touched"};
    }
    adaptor_.emplace(BumperAdaptorConfiguration{.body_radius = body_radius.Get(),
                                                .safe_distance = safe_distance.Get()});
    return {};
  }

  void Update() override {
    const auto felt = contact.Read();
    const auto at = pose.Read();
    if (felt.is_new() && at) surroundings.Publish(adaptor_->Update(*felt, *at));
  }

  std::optional<BumperAdaptor> adaptor_;
};

}  // namespace runnel
