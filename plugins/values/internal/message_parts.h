#pragma once

#include <string>
#include <string_view>

#include "core/base/clock.h"
#include "plugins/values/internal/value_view.h"
#include "plugins/values/json_writer.h"

/// The pieces that Foxglove's messages are made of. Each appends one JSON value.
namespace runnel::internal {

struct Colour {
  double red, green, blue, alpha = 1.0;
};
struct Place {
  double x = 0;
  double y = 0;
  double z = 0;
};
struct PlaceAndHeading {
  Place place;
  double heading = 0;  // rad
};

/// Anything with x and y, and perhaps z.
[[nodiscard]] bool IsPlace(const TypeInfo& type);
/// A place with a heading.
[[nodiscard]] bool IsPose(const TypeInfo& type);
/// Whether a structure has a list of places of this name.
[[nodiscard]] bool HasPlaces(const TypeInfo& type, std::string_view list);
[[nodiscard]] Place PlaceOf(const ValueView& value);
[[nodiscard]] PlaceAndHeading PoseOf(const ValueView& value);

/// Times before the clock's start are told as its start: Foxglove knows no others.
void AppendTime(Time time, std::string& json);
void AppendVector(const Place& place, std::string& json);
/// The turn by `heading` (rad) about the vertical.
void AppendTurn(double heading, std::string& json);
void AppendPose(const PlaceAndHeading& pose, std::string& json);
void AppendColour(const Colour& colour, std::string& json);

}  // namespace runnel::internal
