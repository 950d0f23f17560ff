#include <cmath>

#include "core/types/type_of.h"
#include "plugins/values/base64.h"
#include "plugins/values/internal/message_parts.h"
#include "plugins/values/json_values.h"

namespace runnel::internal {

namespace {

void AddHead(JsonObject& message, const DrawnAt& at, std::string_view frame) {
  AppendTime(at.timestamp, message.Key("timestamp"));
  message.Add("frame_id", frame);
}

bool HasPoints(const TypeInfo& type) { return HasPlaces(type, "points"); }

void AppendPoseInFrame(const ValueView& pose, const DrawnAt& at, std::string& json) {
  JsonObject message(json);
  AddHead(message, at, at.options.world_frame);
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
  AddHead(message, at, at.options.world_frame);
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

bool IsRangeScan(const TypeInfo& type) {
  const TypeInfo* const range = ElementsOf(type, "ranges");
  return HasNumbers(type, {"start_angle", "angle_step"}) && range != nullptr && IsNumber(*range);
}

void AppendRangeScan(const ValueView& scan, const DrawnAt& at, std::string& json) {
  const double first = scan.Field("start_angle").number(), step = scan.Field("angle_step").number();
  const ValueView ranges = scan.Field("ranges");
  const std::size_t steps = ranges.size() > 0 ? ranges.size() - 1 : 0;
  JsonObject message(json);
  AddHead(message, at, at.options.body_frame);
  AppendPose({}, message.Key("pose"));
  message.Add("start_angle", first).Add("end_angle", first + step * static_cast<double>(steps));
  // As they are: what has met nothing is infinitely far, and not drawn.
  AppendJson(ranges.type(), ranges.value(), message.Key("ranges"));
  message.AddJson("intensities", "[]");
}

bool IsImage(const TypeInfo& type) {
  const FieldInfo* const encoding = type.FindField("encoding");
  return HasNumbers(type, {"width", "height", "row_stride"}) && encoding != nullptr &&
         encoding->type == &TypeOf<std::string>() &&
         ElementsOf(type, "data") == &TypeOf<std::uint8_t>();
}

void AppendImage(const ValueView& image, const DrawnAt& at, std::string& json) {
  const auto count = [&](std::string_view name) {
    return static_cast<std::uint32_t>(image.Field(name).number());
  };
  const ValueView data = image.Field("data");
  JsonObject message(json);
  AddHead(message, at, at.options.body_frame);
  message.Add("width", count("width")).Add("height", count("height"));
  message.Add("encoding", *static_cast<const std::string*>(image.Field("encoding").value()));
  message.Add("step", count("row_stride"));
  AppendBase64(data.type(), data.value(), message.Key("data"));
}

}  // namespace

const Drawing kPoseDrawing{"pose", "PoseInFrame", IsPose, AppendPoseInFrame};
const Drawing kTransformDrawing{"pose", "FrameTransform", IsPose, AppendTransform};
const Drawing kPathDrawing{"path", "PosesInFrame", HasPoints, AppendPath};
const Drawing kRangeScanDrawing{"range_scan", "LaserScan", IsRangeScan, AppendRangeScan};
const Drawing kImageDrawing{"image", "RawImage", IsImage, AppendImage};

}  // namespace runnel::internal
