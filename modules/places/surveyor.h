#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "core/module/module.h"
#include "core/port/input.h"
#include "modules/places/place.h"
#include "plugins/blackboards/blackboard_writer.h"
#include "plugins/parameters/parameter.h"

namespace runnel::places {

/// Notes where the robot comes by, wherever no other place is near: one of those who write to the book's blackboard.
class Surveyor final : public Module {
 public:
  using Module::Module;

  Input<Pose2> pose{this, "pose", {.description = "where the robot is", .required = true}};
  Parameter<double> spacing{
      this, "spacing", {.default_value = 1.0, .bounds = {0.1, 100.0}, .unit = "m", .description = "between places"}};
  BlackboardWriter<std::vector<Place>, NotedPlace> places{this, "places", {.required = true}};

 private:
  void Update() override {
    const auto here = pose.Read();
    if (!here || is_waiting_) return;
    auto transaction = places.Begin();
    if (!transaction) return;
    const auto is_near = [&](const Place& each) {
      return std::hypot(each.pose.x - here->x, each.pose.y - here->y) < spacing.Get();
    };
    if (std::ranges::any_of(transaction.value(), is_near)) return;
    // As short as a text that needs no memory of its own.
    transaction.change() = {"way " + std::to_string(transaction.value().size() + 1), *here};
    // Of another place that was noted meanwhile it learns in the next cycle, when it looks again.
    const CallStatus begun = transaction.Commit([this](const auto&) { is_waiting_ = false; });
    is_waiting_ = begun == CallStatus::kPending;
  }

  bool is_waiting_ = false;
};

}  // namespace runnel::places
