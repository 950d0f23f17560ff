#include <cmath>

#include "plugins/values/internal/drawing.h"
#include "plugins/values/internal/message_parts.h"

namespace runnel::internal {

namespace {

bool HasPoints(const TypeInfo& type) { return HasPlaces(type, "points"); }

void AppendPoseInFrame(const ValueView& pose, const DrawnAt& at, std::string& json) {
  JsonObject message(json);
  AppendTime(at.timestamp, message.Key("timestamp"));
  message.Add("frame_id", at.options.world_frame);
  AppendPose(PoseOf(pose), message.Key("pose"));
}

void AppendTransform(const ValueView& pose, const DrawnAt& at, std::string& json) {
  const PlaceAndHeading body = PoseOf(pose);
  JsonObject message(json);
  AppendTime(at.timestamp, message.Key("timestamp"));
  message.Add("parent_frame_id", at.options.world_frame);
  message.Add("child_frame_id", at.options.body_frame);
  AppendVector(body.place, message.Key("translation"));
  AppendTurn(body.heading, message.Key("rotation"));
}

// Each pose looks where the path goes on; the last one as the one before.
void AppendPath(const ValueView& path, const DrawnAt& at, std::string& json) {
  JsonObject message(json);
  AppendTime(at.timestamp, message.Key("timestamp"));
  message.Add("frame_id", at.options.world_frame);
  JsonArray poses(message.Key("poses"));
  const ValueView points = path.Field("points");
  double heading = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Place place = PlaceOf(points[i]);
    if (i + 1 < points.size()) {
      const Place next = PlaceOf(points[i + 1]);
      heading = std::atan2(next.y - place.y, next.x - place.x);
    }
    AppendPose({place, heading}, poses.Next());
  }
}

}  // namespace

const Drawing kPoseDrawing{"pose", "PoseInFrame", IsPose, AppendPoseInFrame};
const Drawing kTransformDrawing{"pose", "FrameTransform", IsPose, AppendTransform};
const Drawing kPathDrawing{"path", "PosesInFrame", HasPoints, AppendPath};

}  // namespace runnel::internal
