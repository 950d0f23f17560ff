#pragma once

#include <string>

#include "core/base/clock.h"
#include "plugins/foxglove_schemas/internal/fields.h"
#include "plugins/json_values/json_writer.h"

/// The pieces that Foxglove's messages are made of. Each appends one JSON value.
namespace runnel::internal {

struct Colour {
  double red, green, blue, alpha = 1.0;
};

/// Times before the clock's start are told as its start: Foxglove knows no others.
void AppendTime(Time time, std::string& json);
void AppendVector(const Place& place, std::string& json);
/// The turn by `heading` (rad) about the vertical.
void AppendTurn(double heading, std::string& json);
void AppendPose(const PlaceAndHeading& pose, std::string& json);
void AppendColour(const Colour& colour, std::string& json);

}  // namespace runnel::internal
