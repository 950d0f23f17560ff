#include "plugins/foxglove_schemas/internal/message_parts.h"

#include <algorithm>
#include <cmath>

namespace runnel::internal {

void AppendTime(Time time, std::string& json) {
  const std::int64_t since_start = std::max<std::int64_t>(0, time.time_since_epoch().count());
  JsonObject object(json);
  object.Add("sec", since_start / 1'000'000'000);
  object.Add("nsec", since_start % 1'000'000'000);
}

void AppendVector(const Place& place, std::string& json) {
  JsonObject object(json);
  object.Add("x", place.x);
  object.Add("y", place.y);
  object.Add("z", place.z);
}

void AppendTurn(double heading, std::string& json) {
  JsonObject object(json);
  object.Add("x", 0.0);
  object.Add("y", 0.0);
  object.Add("z", std::sin(heading / 2));
  object.Add("w", std::cos(heading / 2));
}

void AppendPose(const PlaceAndHeading& pose, std::string& json) {
  JsonObject object(json);
  AppendVector(pose.place, object.Key("position"));
  AppendTurn(pose.heading, object.Key("orientation"));
}

void AppendColour(const Colour& colour, std::string& json) {
  JsonObject object(json);
  object.Add("r", colour.red);
  object.Add("g", colour.green);
  object.Add("b", colour.blue);
  object.Add("a", colour.alpha);
}

}  // namespace runnel::internal
