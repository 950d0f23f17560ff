#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "core/base/nearest_name.h"
#include "core/module/module.h"
#include "core/port/input.h"
#include "modules/types/pose.h"
#include "modules/places/place.h"
#include "plugins/blackboards/blackboard.h"
#include "plugins/services/service.h"

namespace runnel::places {

/// Remembers places, on a blackboard that others read and write to, too. All of its services are served in its cycle, and
/// so share its members with it.
class PlaceBook final : public Module {
 public:
  using Module::Module;

  Input<Pose2> pose{this, "pose", {.description = "where the robot is", .required = true}};
  Blackboard<std::vector<Place>, NotedPlace> places{
      this, "places", {}, {.description = "all places, in the order in which they were noted"}};
  Service<Pose2(std::string)> remember{this,
                                       "remember",
                                       &PlaceBook::Remember,
                                       {.description = "that a place of this name is where the robot is now",
                                        .arguments = {"name"}}};
  Service<Pose2(std::string)> where{this,
                                    "where",
                                    &PlaceBook::Where,
                                    {.description = "the place is", .arguments = {"name"}}};
  Service<std::vector<std::string>()> names{
      this, "names", &PlaceBook::Names, {.description = "of all places"}};

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

}  // namespace runnel::places
