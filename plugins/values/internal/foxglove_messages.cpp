#include <algorithm>
#include <array>

#include "plugins/values/internal/message_parts.h"
#include "plugins/values/json_writer.h"

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
    {"time",
     R"({"type":"object","title":"time","properties":{"sec":{"type":"integer","minimum":0},)"
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
    {"Log",
     "timestamp time level LogLevel message string name string file string line count"},
    {"FrameTransform",
     "timestamp time parent_frame_id string child_frame_id string translation Vector3 "
     "rotation Quaternion"},
    {"LaserScan",
     "timestamp time frame_id string pose Pose start_angle number end_angle number "
     "ranges number[] intensities number[]"},
    {"RawImage",
     "timestamp time frame_id string width count height count encoding string step count "
     "data bytes"},
    {"SceneUpdate", "deletions SceneEntityDeletion[] entities SceneEntity[]"},
    {"SceneEntityDeletion", "timestamp time type SceneEntityDeletionType id string"},
    {"SceneEntity",
     "timestamp time frame_id string id string lifetime duration frame_locked boolean "
     "metadata KeyValuePair[] arrows ArrowPrimitive[] cubes CubePrimitive[] "
     "spheres SpherePrimitive[] cylinders CylinderPrimitive[] lines LinePrimitive[] "
     "triangles TriangleListPrimitive[] texts TextPrimitive[] models ModelPrimitive[]"},
    {"KeyValuePair", "key string value string"},
    {"ArrowPrimitive",
     "pose Pose shaft_length number shaft_diameter number head_length number "
     "head_diameter number color Color"},
    {"CubePrimitive", "pose Pose size Vector3 color Color"},
    {"SpherePrimitive", "pose Pose size Vector3 color Color"},
    {"CylinderPrimitive",
     "pose Pose size Vector3 bottom_scale number top_scale number color Color"},
    {"LinePrimitive",
     "type LineType pose Pose thickness number scale_invariant boolean points Point3[] "
     "color Color colors Color[] indices count[]"},
    {"TriangleListPrimitive",
     "pose Pose points Point3[] color Color colors Color[] indices count[]"},
    {"TextPrimitive",
     "pose Pose billboard boolean font_size number scale_invariant boolean color Color "
     "text string"},
    {"ModelPrimitive",
     "pose Pose scale Vector3 color Color override_color boolean url string "
     "media_type string data bytes"},
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

}  // namespace

std::string FoxgloveSchema(std::string_view name) {
  std::string json;
  AppendSchema(name, json);
  return json;
}

}  // namespace runnel::internal
