#include "plugins/foxglove_schemas/internal/schema_texts.h"

#include <initializer_list>
#include <string_view>

#include "plugins/json_values/json_writer.h"

namespace runnel::internal {

namespace {

struct Member {
  const char* name;
  std::string schema;
};
using Members = std::initializer_list<Member>;

// A leaf of a kind: "number", "boolean".
std::string Of(std::string_view kind) {
  std::string json;
  JsonObject(json).Add("type", kind);
  return json;
}

std::string Object(std::string_view title, Members members) {
  std::string json;
  JsonObject object(json);
  object.Add("title", title);
  object.Add("type", "object");
  JsonObject properties(object.Key("properties"));
  for (const Member& member : members) properties.AddJson(member.name, member.schema);
  return json;
}

std::string List(std::string_view items) {
  std::string json;
  JsonObject object(json);
  object.Add("type", "array");
  object.AddJson("items", items);
  return json;
}

std::string Choice(std::string_view title, std::initializer_list<std::string_view> names) {
  std::string json;
  JsonObject object(json);
  object.Add("title", title);
  JsonArray choices(object.Key("oneOf"));
  int number = 0;
  for (const std::string_view name : names) {
    JsonObject choice(choices.Next());
    choice.Add("title", name);
    choice.Add("const", number++);
  }
  return json;
}

std::string Count() { return R"({"type":"integer","minimum":0})"; }
std::string Bytes() { return R"({"type":"string","contentEncoding":"base64"})"; }

std::string Time() {
  return R"({"type":"object","title":"time","properties":{"sec":{"type":"integer","minimum":0},)"
         R"("nsec":{"type":"integer","minimum":0,"maximum":999999999}}})";
}
std::string Duration() {
  return R"({"type":"object","title":"duration","properties":{"sec":{"type":"integer"},)"
         R"("nsec":{"type":"integer","minimum":0,"maximum":999999999}}})";
}

std::string Xyz(std::string_view title) {
  const std::string number = Of("number");
  return Object(title, {{"x", number}, {"y", number}, {"z", number}});
}
std::string Vector3() { return Xyz("foxglove.Vector3"); }
std::string Point3() { return Xyz("foxglove.Point3"); }
std::string Quaternion() {
  const std::string number = Of("number");
  return Object("foxglove.Quaternion",
                {{"x", number}, {"y", number}, {"z", number}, {"w", number}});
}
std::string Pose() {
  return Object("foxglove.Pose", {{"position", Vector3()}, {"orientation", Quaternion()}});
}
std::string Color() {
  const std::string number = Of("number");
  return Object("foxglove.Color", {{"r", number}, {"g", number}, {"b", number}, {"a", number}});
}

std::string Deletion() {
  return Object("foxglove.SceneEntityDeletion",
                {{"timestamp", Time()},
                 {"type", Choice("foxglove.SceneEntityDeletionType", {"MATCHING_ID", "ALL"})},
                 {"id", Of("string")}});
}

std::string Arrow() {
  const std::string number = Of("number");
  return Object("foxglove.ArrowPrimitive", {{"pose", Pose()},
                                            {"shaft_length", number},
                                            {"shaft_diameter", number},
                                            {"head_length", number},
                                            {"head_diameter", number},
                                            {"color", Color()}});
}
std::string Solid(std::string_view title) {
  return Object(title, {{"pose", Pose()}, {"size", Vector3()}, {"color", Color()}});
}
std::string Cylinder() {
  return Object("foxglove.CylinderPrimitive", {{"pose", Pose()},
                                               {"size", Vector3()},
                                               {"bottom_scale", Of("number")},
                                               {"top_scale", Of("number")},
                                               {"color", Color()}});
}
std::string Line() {
  return Object("foxglove.LinePrimitive",
                {{"type", Choice("foxglove.LineType", {"LINE_STRIP", "LINE_LOOP", "LINE_LIST"})},
                 {"pose", Pose()},
                 {"thickness", Of("number")},
                 {"scale_invariant", Of("boolean")},
                 {"points", List(Point3())},
                 {"color", Color()},
                 {"colors", List(Color())},
                 {"indices", List(Count())}});
}
std::string Triangles() {
  return Object("foxglove.TriangleListPrimitive", {{"pose", Pose()},
                                                   {"points", List(Point3())},
                                                   {"color", Color()},
                                                   {"colors", List(Color())},
                                                   {"indices", List(Count())}});
}
std::string Text() {
  return Object("foxglove.TextPrimitive", {{"pose", Pose()},
                                           {"billboard", Of("boolean")},
                                           {"font_size", Of("number")},
                                           {"scale_invariant", Of("boolean")},
                                           {"color", Color()},
                                           {"text", Of("string")}});
}
std::string Model() {
  return Object("foxglove.ModelPrimitive", {{"pose", Pose()},
                                            {"scale", Vector3()},
                                            {"color", Color()},
                                            {"override_color", Of("boolean")},
                                            {"url", Of("string")},
                                            {"media_type", Of("string")},
                                            {"data", Bytes()}});
}

std::string Entity() {
  return Object("foxglove.SceneEntity",
                {{"timestamp", Time()},
                 {"frame_id", Of("string")},
                 {"id", Of("string")},
                 {"lifetime", Duration()},
                 {"frame_locked", Of("boolean")},
                 {"metadata", List(Object("foxglove.KeyValuePair",
                                          {{"key", Of("string")}, {"value", Of("string")}}))},
                 {"arrows", List(Arrow())},
                 {"cubes", List(Solid("foxglove.CubePrimitive"))},
                 {"spheres", List(Solid("foxglove.SpherePrimitive"))},
                 {"cylinders", List(Cylinder())},
                 {"lines", List(Line())},
                 {"triangles", List(Triangles())},
                 {"texts", List(Text())},
                 {"models", List(Model())}});
}

}  // namespace

std::string PoseInFrameSchema() {
  return Object("foxglove.PoseInFrame",
                {{"timestamp", Time()}, {"frame_id", Of("string")}, {"pose", Pose()}});
}

std::string PosesInFrameSchema() {
  return Object("foxglove.PosesInFrame",
                {{"timestamp", Time()}, {"frame_id", Of("string")}, {"poses", List(Pose())}});
}

std::string LaserScanSchema() {
  return Object("foxglove.LaserScan", {{"timestamp", Time()},
                                       {"frame_id", Of("string")},
                                       {"pose", Pose()},
                                       {"start_angle", Of("number")},
                                       {"end_angle", Of("number")},
                                       {"ranges", List(Of("number"))},
                                       {"intensities", List(Of("number"))}});
}

std::string RawImageSchema() {
  return Object("foxglove.RawImage", {{"timestamp", Time()},
                                      {"frame_id", Of("string")},
                                      {"width", Count()},
                                      {"height", Count()},
                                      {"encoding", Of("string")},
                                      {"step", Count()},
                                      {"data", Bytes()}});
}

std::string FrameTransformSchema() {
  return Object("foxglove.FrameTransform", {{"timestamp", Time()},
                                            {"parent_frame_id", Of("string")},
                                            {"child_frame_id", Of("string")},
                                            {"translation", Vector3()},
                                            {"rotation", Quaternion()}});
}

std::string SceneUpdateSchema() {
  return Object("foxglove.SceneUpdate",
                {{"deletions", List(Deletion())}, {"entities", List(Entity())}});
}

}  // namespace runnel::internal
