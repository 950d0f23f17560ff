#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/types/type_of.h"
#include "modules/types/pose.h"

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

}  // namespace runnel::places
