#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "core/base/nearest_name.h"
#include "core/module/module.h"
#include "core/port/input.h"
#include "modules/types/pose.h"
#include "plugins/services/service.h"

namespace runnel::places {

/// Where somebody has said that there is something: "dock".
struct Place {
  std::string name;
  Pose2 pose;
};

inline void Describe(TypeBuilder<Place>& type) {
  type.Name("Place").Field("name", &Place::name).Field("pose", &Place::pose);
}

/// Remembers places. All of its services are served in its cycle, and so share its members with it.
class PlaceBook final : public Module {
 public:
  explicit PlaceBook(const Placement& placement) : Module(placement) {
    places_.reserve(100);
    KeepState(places_);
  }

  Input<Pose2> pose{this, "pose", {.description = "where the robot is", .required = true}};
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
    auto found = std::ranges::find(places_, name, &Place::name);
    if (found == places_.end()) found = places_.insert(found, Place{name, {}});
    return found->pose = *now;
  }
  Result<Pose2> Where(const std::string& name) const {
    const auto found = std::ranges::find(places_, name, &Place::name);
    if (found != places_.end()) return found->pose;
    return Error{.message = "there is no place '" + name + "'",
                 .hint = NearestNameHint(name, Names())};
  }
  [[nodiscard]] std::vector<std::string> Names() const { return NamesOf(places_, &Place::name); }
  void Update() override {}

  std::vector<Place> places_;
};

}  // namespace runnel::places
