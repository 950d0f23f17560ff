#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/clock.h"
#include "core/base/result.h"
#include "core/element/framework_element.h"
#include "core/port/port.h"
#include "plugins/values/json_values.h"

namespace runnel {

/// The name of an element for people who see only one application: its path without the application
/// and without groups of ports: "/bug_demo/robot/planner/output/twist" is "/robot/planner/twist". Two ports
/// of a module may come to the same name, an input and an output for example. Under the structure lock.
[[nodiscard]] std::string TopicOf(const FrameworkElement& element);

/// The output whose poses tell where the robot is, for the transform: of all that publish poses, the
/// one that the most inputs read; of equals the first. nullptr if there is none. Under the structure
/// lock.
[[nodiscard]] const Port* RobotPose(std::span<const Port* const> ports);

/// One of the ways in which the values of a port are shown to Foxglove, Lichtblick, PlotJuggler, live or
/// in a file: messages in JSON with a JSON Schema.
struct FoxgloveChannel {
  std::string topic;
  std::string schema_name;  ///< the type's name, or one of Foxglove's own: "foxglove.LaserScan"
  std::string schema;       ///< JSON Schema; "" where viewers could not read it (lists of lists)
  /// Appends the message for a value of the type, with the time it was measured.
  /// Threads: as for the value. Allocates what the message needs.
  std::function<void(const void* value, Time timestamp, std::string& json)> append;
};

/// The channels for values of a type that are published under `topic`:
///
///     topic            the value as it is, for plots, tables and raw views: {"x":1,"y":2,"heading":0};
///                      what is no structure stands in "value"
///     topic/foxglove   if its meaning (TypeInfo::meaning) is one that Foxglove can draw: pose
///                      (PoseInFrame), path (PosesInFrame), range_scan (LaserScan), image (RawImage),
///                      point, hit_and_leave_points, drawing, world_map (SceneUpdate)
///
/// `limits`, of plain values: without infinities every reader takes the message. In Foxglove's own schemas they
/// stay: there they mean "no echo". Empty for a type that is not transparent.
[[nodiscard]] std::vector<FoxgloveChannel> ChannelsFor(const TypeInfo& type, std::string_view topic,
                                                       const JsonLimits& limits = {.has_infinity = false});

/// Sets `value` from a message of the channel that shows values as they are; one that is not within "value", though
/// its type is no structure, is read, too.
/// Errors: as of SetFromJson().
Result<void> SetFromMessage(const TypeInfo& type, std::string_view json, void* value);

/// Foxglove's transform from the world to the body, made of the body's poses: what puts scans where the
/// robot is. Its topic is "/tf". Nothing if the type's values are no poses.
[[nodiscard]] std::optional<FoxgloveChannel> TransformChannelFor(const TypeInfo& type);

/// What modules say, in Foxglove's schema for it, foxglove.Log, under the topic "/log". Its values are
/// LogMessages; the time that is given with one counts.
[[nodiscard]] FoxgloveChannel LogChannel();

}  // namespace runnel
