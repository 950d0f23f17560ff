#include "plugins/values/internal/message_parts.h"

#include <algorithm>
#include <cmath>

namespace runnel::internal {

bool IsPlace(const TypeInfo& type) { return HasNumbers(type, {"x", "y"}); }
bool IsPose(const TypeInfo& type) { return HasNumbers(type, {"x", "y", "heading"}); }

bool HasPlaces(const TypeInfo& type, std::string_view list) {
  const TypeInfo* const element = ElementsOf(type, list);
  return element != nullptr && IsPlace(*element);
}

Place PlaceOf(const ValueView& value) {
  const bool has_height = HasNumbers(value.type(), {"z"});
  return {value.Field("x").number(), value.Field("y").number(), has_height ? value.Field("z").number() : 0.0};
}

PlaceAndHeading PoseOf(const ValueView& value) { return {PlaceOf(value), value.Field("heading").number()}; }

void AppendTime(Time time, std::string& json) {
  const std::int64_t since_start = std::max<std::int64_t>(0, time.time_since_epoch().count());
  JsonObject(json).Add("sec", since_start / 1'000'000'000).Add("nsec", since_start % 1'000'000'000);
}

void AppendVector(const Place& place, std::string& json) {
  JsonObject(json).Add("x", place.x).Add("y", place.y).Add("z", place.z);
}

void AppendTurn(double heading, std::string& json) {
  const double half = heading / 2;
  JsonObject(json).Add("x", 0.0).Add("y", 0.0).Add("z", std::sin(half)).Add("w", std::cos(half));
}

void AppendPose(const PlaceAndHeading& pose, std::string& json) {
  JsonObject object(json);
  AppendVector(pose.place, object.Key("position"));
  AppendTurn(pose.heading, object.Key("orientation"));
}

void AppendColour(const Colour& colour, std::string& json) {
  JsonObject object(json);
  object.Add("r", colour.red).Add("g", colour.green).Add("b", colour.blue).Add("a", colour.alpha);
}

}  // namespace runnel::internal
