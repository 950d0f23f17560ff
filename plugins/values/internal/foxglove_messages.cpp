#include <algorithm>
#include <array>
#include <cmath>

#include "core/types/type_of.h"
#include "plugins/values/internal/message_parts.h"
#include "plugins/values/json_values.h"
#include "plugins/values/json_writer.h"
#include "plugins/values/value_bytes.h"

namespace runnel::internal {

namespace {

struct Entry {
  std::string_view name;
  std::string_view text;
};

constexpr std::array<Entry, 7> kLeaves{{
    {"number", R"({"type":"number"})"},
    {"boolean", R"({"type":"boolean"})"},
    {"string", R"({"type":"string"})"},
    {"count", R"({"type":"integer","minimum":0})"},
    {"bytes", R"({"type":"string","contentEncoding":"base64"})"},
    {"time", R"({"type":"object","title":"time","properties":{"sec":{"type":"integer","minimum":0},)"
             R"("nsec":{"type":"integer","minimum":0,"maximum":999999999}}})"},
    {"duration", R"({"type":"object","title":"duration","properties":{"sec":{"type":"integer"},)"
                 R"("nsec":{"type":"integer","minimum":0,"maximum":999999999}}})"},
}};

// The names of the values, from 0.
constexpr std::array<Entry, 3> kChoices{{
    {"LogLevel", "UNKNOWN DEBUG INFO WARNING ERROR FATAL"},
    {"SceneEntityDeletionType", "MATCHING_ID ALL"},
    {"LineType", "LINE_STRIP LINE_LOOP LINE_LIST"},
}};

// Members and their types in turn.
constexpr std::array<Entry, 23> kMessages{{
    {"Vector3", "x number y number z number"},
    {"Point3", "x number y number z number"},
    {"Quaternion", "x number y number z number w number"},
    {"Pose", "position Vector3 orientation Quaternion"},
    {"Color", "r number g number b number a number"},
    {"PoseInFrame", "timestamp time frame_id string pose Pose"},
    {"PosesInFrame", "timestamp time frame_id string poses Pose[]"},
    {"Log", "timestamp time level LogLevel message string name string file string line count"},
    {"FrameTransform",
     "timestamp time parent_frame_id string child_frame_id string translation Vector3 rotation Quaternion"},
    {"LaserScan",
     "timestamp time frame_id string pose Pose start_angle number end_angle number "
     "ranges number[] intensities number[]"},
    {"RawImage", "timestamp time frame_id string width count height count encoding string step count data bytes"},
    {"SceneUpdate", "deletions SceneEntityDeletion[] entities SceneEntity[]"},
    {"SceneEntityDeletion", "timestamp time type SceneEntityDeletionType id string"},
    {"SceneEntity",
     "timestamp time frame_id string id string lifetime duration frame_locked boolean metadata KeyValuePair[] arrows "
     "ArrowPrimitive[] cubes CubePrimitive[] spheres SpherePrimitive[] cylinders CylinderPrimitive[] lines "
     "LinePrimitive[] triangles TriangleListPrimitive[] texts TextPrimitive[] models ModelPrimitive[]"},
    {"KeyValuePair", "key string value string"},
    {"ArrowPrimitive",
     "pose Pose shaft_length number shaft_diameter number head_length number head_diameter number color Color"},
    {"CubePrimitive", "pose Pose size Vector3 color Color"},
    {"SpherePrimitive", "pose Pose size Vector3 color Color"},
    {"CylinderPrimitive", "pose Pose size Vector3 bottom_scale number top_scale number color Color"},
    {"LinePrimitive",
     "type LineType pose Pose thickness number scale_invariant boolean points Point3[] "
     "color Color colors Color[] indices count[]"},
    {"TriangleListPrimitive", "pose Pose points Point3[] color Color colors Color[] indices count[]"},
    {"TextPrimitive", "pose Pose billboard boolean font_size number scale_invariant boolean color Color text string"},
    {"ModelPrimitive",
     "pose Pose scale Vector3 color Color override_color boolean url string media_type string data bytes"},
}};

// "" if there is none.
template <std::size_t size>
std::string_view Find(const std::array<Entry, size>& entries, std::string_view name) {
  const auto found = std::ranges::find(entries, name, &Entry::name);
  return found == entries.end() ? std::string_view() : found->text;
}

std::string_view TakeWord(std::string_view& words) {
  const std::string_view word = words.substr(0, words.find(' '));
  words.remove_prefix(std::min(words.size(), word.size() + 1));
  return word;
}

void AppendSchema(std::string_view type, std::string& json) {
  if (const std::string_view leaf = Find(kLeaves, type); !leaf.empty()) {
    json += leaf;
    return;
  }
  JsonObject schema(json);
  if (type.ends_with("[]")) {
    return AppendSchema(type.substr(0, type.size() - 2), schema.Add("type", "array").Key("items"));
  }
  schema.Add("title", std::string("foxglove.").append(type));
  if (std::string_view names = Find(kChoices, type); !names.empty()) {
    JsonArray choices(schema.Key("oneOf"));
    for (int number = 0; !names.empty(); ++number) {
      JsonObject(choices.Next()).Add("title", TakeWord(names)).Add("const", number);
    }
    return;
  }
  JsonObject properties(schema.Add("type", "object").Key("properties"));
  for (std::string_view members = Find(kMessages, type); !members.empty();) {
    const std::string_view name = TakeWord(members);
    AppendSchema(TakeWord(members), properties.Key(name));
  }
}

void AddHead(JsonObject& message, Time timestamp, std::string_view frame) {
  AppendTime(timestamp, message.Key("timestamp"));
  message.Add("frame_id", frame);
}

bool HasPoints(const TypeInfo& type) { return HasPlaces(type, "points"); }

void AppendPoseInFrame(const ValueView& pose, Time timestamp, std::string& json) {
  JsonObject message(json);
  AddHead(message, timestamp, kWorldFrame);
  AppendPose(PoseOf(pose), message.Key("pose"));
}

void AppendTransform(const ValueView& pose, Time timestamp, std::string& json) {
  const PlaceAndHeading body = PoseOf(pose);
  JsonObject message(json);
  AppendTime(timestamp, message.Key("timestamp"));
  message.Add("parent_frame_id", kWorldFrame);
  message.Add("child_frame_id", kBodyFrame);
  AppendVector(body.place, message.Key("translation"));
  AppendTurn(body.heading, message.Key("rotation"));
}

// Each pose looks where the path goes on; the last one as the one before.
void AppendPath(const ValueView& path, Time timestamp, std::string& json) {
  JsonObject message(json);
  AddHead(message, timestamp, kWorldFrame);
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

void AppendRangeScan(const ValueView& scan, Time timestamp, std::string& json) {
  const double first = scan.Field("start_angle").number(), step = scan.Field("angle_step").number();
  const ValueView ranges = scan.Field("ranges");
  const std::size_t steps = ranges.size() > 0 ? ranges.size() - 1 : 0;
  JsonObject message(json);
  AddHead(message, timestamp, kBodyFrame);
  AppendPose({}, message.Key("pose"));
  message.Add("start_angle", first).Add("end_angle", first + step * static_cast<double>(steps));
  // As they are: what has met nothing is infinitely far, and not drawn.
  AppendJson(ranges.type(), ranges.value(), message.Key("ranges"));
  message.AddJson("intensities", "[]");
}

bool IsImage(const TypeInfo& type) {
  const FieldInfo* const encoding = type.FindField("encoding");
  return HasNumbers(type, {"width", "height", "row_stride"}) && encoding != nullptr &&
         encoding->type == &TypeOf<std::string>() && ElementsOf(type, "data") == &TypeOf<std::uint8_t>();
}

void AppendImage(const ValueView& image, Time timestamp, std::string& json) {
  const auto count = [&](std::string_view name) { return static_cast<std::uint32_t>(image.Field(name).number()); };
  const ValueView data = image.Field("data");
  JsonObject message(json);
  AddHead(message, timestamp, kBodyFrame);
  message.Add("width", count("width")).Add("height", count("height"));
  message.Add("encoding", *static_cast<const std::string*>(image.Field("encoding").value()));
  message.Add("step", count("row_stride"));
  AppendBase64(data.type(), data.value(), message.Key("data"));
}

}  // namespace

std::string FoxgloveSchema(std::string_view name) {
  std::string json;
  AppendSchema(name, json);
  return json;
}

const Drawing kPoseDrawing{"pose", "PoseInFrame", IsPose, AppendPoseInFrame};
const Drawing kTransformDrawing{"pose", "FrameTransform", IsPose, AppendTransform};
const Drawing kPathDrawing{"path", "PosesInFrame", HasPoints, AppendPath};
const Drawing kRangeScanDrawing{"range_scan", "LaserScan", IsRangeScan, AppendRangeScan};
const Drawing kImageDrawing{"image", "RawImage", IsImage, AppendImage};

}  // namespace runnel::internal
