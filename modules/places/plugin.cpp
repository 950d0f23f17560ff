#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <vector>

#include "core/base/nearest_name.h"
#include "core/base/result.h"
#include "core/module/module.h"
#include "core/plugin/plugin_entry.h"
#include "core/port/input.h"
#include "core/port/output.h"
#include "core/types/type_of.h"
#include "modules/types/pose.h"
#include "plugins/blackboards/blackboard.h"
#include "plugins/blackboards/blackboard_writer.h"
#include "plugins/parameters/parameter.h"
#include "plugins/services/client.h"
#include "plugins/services/service.h"

namespace runnel::places {

/// Where somebody has said that there is something: "dock".
struct Place {
  std::string name;
  Pose2 pose;
};

inline void Describe(TypeBuilder<Place>& type) { type.Name("Place").Fields<&Place::name, &Place::pose>(); }

/// A place that is noted, or noted anew: what changes a list of places.
struct NotedPlace {
  std::string name;
  Pose2 pose;
};

inline void Describe(TypeBuilder<NotedPlace>& type) {
  type.Name("NotedPlace").Fields<&NotedPlace::name, &NotedPlace::pose>();
}

/// Errors: a place without a name.
inline Result<void> Apply(std::vector<Place>& places, const NotedPlace& noted) {
  if (noted.name.empty()) return Error{.message = "a place needs a name"};
  auto found = std::ranges::find(places, noted.name, &Place::name);
  if (found == places.end()) found = places.insert(found, Place{noted.name, {}});
  found->pose = noted.pose;
  return {};
}

/// Remembers places, on a blackboard that others read and write to, too. All of its services are served in its cycle, and
/// so share its members with it.
class PlaceBook final : public Module {
 public:
  using Module::Module;

  Input<Pose2> pose{this, "pose", {.description = "where the robot is", .required = true}};
  Blackboard<std::vector<Place>, NotedPlace> places{
      this, "places", {}, {.description = "all places, in the order in which they were noted"}};
  Service<Pose2(std::string)> remember{
      this,
      "remember",
      &PlaceBook::Remember,
      {.description = "that a place of this name is where the robot is now", .arguments = {"name"}}};
  Service<Pose2(std::string)> where{
      this, "where", &PlaceBook::Where, {.description = "the place is", .arguments = {"name"}}};
  Service<std::vector<std::string>()> names{this, "names", &PlaceBook::Names, {.description = "of all places"}};

 private:
  Result<Pose2> Remember(const std::string& name) {
    const auto now = pose.Read();
    if (!now) return Error{.message = "it is not known yet where the robot is"};
    if (const auto noted = places.CommitChange({name, *now}); !noted) return noted.error();
    return *now;
  }
  Result<Pose2> Where(const std::string& name) const {
    Result<Pose2> found = Pose2{};
    places.Look([&](const std::vector<Place>& all) {
      const auto place = std::ranges::find(all, name, &Place::name);
      if (place != all.end()) {
        found = place->pose;
      } else {
        found = Error{.message = "there is no place '" + name + "'",
                      .hint = NearestNameHint(name, NamesOf(all, &Place::name))};
      }
    });
    return found;
  }
  [[nodiscard]] std::vector<std::string> Names() const {
    std::vector<std::string> all_names;
    places.Look([&](const std::vector<Place>& all) { all_names = NamesOf(all, &Place::name); });
    return all_names;
  }
  void Update() override {}
};

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

/// Has a planner drive to a place. The call takes as long as the way: it is served by a thread of its own, which
/// reports how far the robot has come, and may wait for the answer of another service.
class PlaceDriver final : public Module {
 public:
  using Module::Module;

  Input<Pose2> pose{this, "pose", {.description = "where the robot is", .required = true}};
  Output<Point2> goal{this, "goal", {.description = "where it shall be"}};
  Parameter<double> tolerance{this, "tolerance", {.default_value = 0.3, .bounds = {0.01, 10.0}, .unit = "m"}};
  Client<Pose2(std::string)> where{this, "where", {.required = true}};
  Service<double(std::string)> go{
      this,
      "go",
      &PlaceDriver::Go,
      {.description = "drives to a place, and says how far from it the robot is then", .arguments = {"name"}}};

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
    return Error{.message = "aborted on the way to '" + name + "'"};
  }
  void Update() override {}
};

}  // namespace runnel::places

RUNNEL_PLUGIN(places, registry) {
  using namespace runnel::places;
  registry.Add<PlaceBook>("places/book", "remembers where the robot was, by names: remember, where, names");
  registry.Add<Surveyor>("places/surveyor", "notes places where the robot comes by, on the book's blackboard");
  registry.Add<PlaceDriver>("places/driver", "has the robot drive to a place when it is asked to: go");
}
