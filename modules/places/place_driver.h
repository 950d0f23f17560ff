#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>

#include "core/module/module.h"
#include "core/port/input.h"
#include "core/port/output.h"
#include "modules/types/pose.h"
#include "plugins/parameters/parameter.h"
#include "plugins/services/client.h"
#include "plugins/services/service.h"

namespace runnel::places {

/// Has a planner drive to a place. The call takes as long as the way: it is served by a thread of its own, which
/// reports how far the robot has come, and may wait for the answer of another service.
class PlaceDriver final : public Module {
 public:
  using Module::Module;

  Input<Pose2> pose{this, "pose", {.description = "where the robot is", .required = true}};
  Output<Point2> goal{this, "goal", {.description = "where it shall be"}};
  Parameter<double> tolerance{
      this, "tolerance", {.default_value = 0.3, .bounds = {0.01, 10.0}, .unit = "m"}};
  Client<Pose2(std::string)> where{this, "where", {.required = true}};
  Service<double(std::string)> go{this,
                                  "go",
                                  &PlaceDriver::Go,
                                  {.description = "drives to a place, and says how far from it the robot is then",
                                   .arguments = {"name"}}};

 private:
  // The thread of the service. It alone publishes goals and reads poses.
  Result<double> Go(Activity& activity, const std::string& name) {
    auto asked = where.Begin(name);
    const auto place = asked.Wait();
    if (!place) return Error{.message = std::string(place.error())};
    const Point2 target = Position(*place);
    goal.Publish(target);
    double whole = 0;
    while (!activity.is_abort_asked()) {
      if (const auto here = pose.Read()) {
        const double left = std::hypot(here->x - target.x, here->y - target.y);
        whole = std::max(whole, left);
        activity.Report(whole > 0 ? 1 - left / whole : 1, "driving");
        if (left <= tolerance.Get()) return left;
      }
      (void)pose.Wait(std::chrono::milliseconds(50));
    }
    if (const auto here = pose.Read()) goal.Publish(Position(*here));  // stays where it is
    return Error{.message = "stopped on the way to '" + name + "'"};
  }
  void Update() override {}
};

}  // namespace runnel::places
