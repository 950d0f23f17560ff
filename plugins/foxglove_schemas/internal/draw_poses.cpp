#include <cmath>

#include "plugins/foxglove_schemas/internal/drawing.h"
#include "plugins/foxglove_schemas/internal/fields.h"
#include "plugins/foxglove_schemas/internal/message_parts.h"
#include "plugins/foxglove_schemas/internal/schema_texts.h"

namespace runnel::internal {

std::optional<Drawing> DrawPose(const TypeInfo& type, const FoxgloveOptions& options) {
  const auto pose = PoseReader::For(type);
  if (!pose) return std::nullopt;
  return Drawing{"foxglove.PoseInFrame", PoseInFrameSchema(),
                 [pose = *pose, frame = options.world_frame](const void* value, Time timestamp,
                                                             std::string& json) {
                   JsonObject message(json);
                   AppendTime(timestamp, message.Key("timestamp"));
                   message.Add("frame_id", frame);
                   AppendPose(pose.Get(value), message.Key("pose"));
                 }};
}

std::optional<Drawing> DrawTransform(const TypeInfo& type, const FoxgloveOptions& options) {
  const auto pose = PoseReader::For(type);
  if (!pose || type.semantic_tag() != "pose") return std::nullopt;
  return Drawing{"foxglove.FrameTransform", FrameTransformSchema(),
                 [pose = *pose, options](const void* value, Time timestamp, std::string& json) {
                   const PlaceAndHeading at = pose.Get(value);
                   JsonObject message(json);
                   AppendTime(timestamp, message.Key("timestamp"));
                   message.Add("parent_frame_id", options.world_frame);
                   message.Add("child_frame_id", options.body_frame);
                   AppendVector(at.place, message.Key("translation"));
                   AppendTurn(at.heading, message.Key("rotation"));
                 }};
}

// Each pose looks where the path goes on; the last one as the one before.
std::optional<Drawing> DrawPath(const TypeInfo& type, const FoxgloveOptions& options) {
  const auto points = PlacesField::Find(type, "points");
  if (!points) return std::nullopt;
  return Drawing{"foxglove.PosesInFrame", PosesInFrameSchema(),
                 [points = *points, frame = options.world_frame](const void* value, Time timestamp,
                                                                 std::string& json) {
                   JsonObject message(json);
                   AppendTime(timestamp, message.Key("timestamp"));
                   message.Add("frame_id", frame);
                   JsonArray poses(message.Key("poses"));
                   const std::size_t count = points.Size(value);
                   double heading = 0;
                   for (std::size_t i = 0; i < count; ++i) {
                     const Place place = points.At(value, i);
                     if (i + 1 < count) {
                       const Place next = points.At(value, i + 1);
                       heading = std::atan2(next.y - place.y, next.x - place.x);
                     }
                     AppendPose({place, heading}, poses.Next());
                   }
                 }};
}

}  // namespace runnel::internal
