#include "plugins/foxglove_schemas/foxglove_channel.h"

#include <algorithm>
#include <array>

#include "core/types/type_info.h"
#include "plugins/foxglove_schemas/internal/drawing.h"
#include "plugins/json_values/json_values.h"
#include "plugins/json_values/json_writer.h"

namespace runnel {

namespace {

using internal::Drawing;
using Draw = std::optional<Drawing> (*)(const TypeInfo& type, const FoxgloveOptions& options);

struct DrawnTag {
  std::string_view tag;
  Draw draw;
};
constexpr std::array<DrawnTag, 7> kDrawn{{
    {"pose", internal::DrawPose},
    {"path", internal::DrawPath},
    {"range_scan", internal::DrawRangeScan},
    {"image", internal::DrawImage},
    {"point", internal::DrawPoint},
    {"hit_and_leave_points", internal::DrawHitAndLeavePoints},
    {"world_map", internal::DrawWorldMap},
}};

bool IsList(const TypeInfo& type) {
  return type.kind() == TypeKind::kSequence || type.kind() == TypeKind::kMatrix;
}

// Foxglove refuses a channel whose schema has lists of lists, and reads it well without a schema.
bool HasListsOfLists(const TypeInfo& type, std::vector<const TypeInfo*>& open) {
  if (type.kind() == TypeKind::kMatrix) return true;
  if (std::ranges::find(open, &type) != open.end()) return false;
  open.push_back(&type);
  bool has = false;
  if (type.kind() == TypeKind::kSequence) {
    const TypeInfo& element = *type.elements().type;
    has = IsList(element) || HasListsOfLists(element, open);
  }
  for (const FieldInfo& field : type.fields()) has = has || HasListsOfLists(*field.type, open);
  open.pop_back();
  return has;
}

// Messages are objects; what is none is put into one.
std::string WrappedSchema(const TypeInfo& type) {
  std::string schema;
  JsonObject object(schema);
  object.Add("type", "object");
  object.Add("title", type.name());
  {
    JsonObject properties(object.Key("properties"));
    properties.AddJson("value", JsonSchemaOf(type));
  }
  object.AddJson("required", R"(["value"])");
  return schema;
}

FoxgloveChannel PlainChannel(const TypeInfo& type, std::string_view topic,
                             const FoxgloveOptions& options) {
  const bool is_object = type.kind() == TypeKind::kStructure;
  std::vector<const TypeInfo*> open;
  FoxgloveChannel channel{std::string(topic), type.name(), "", {}};
  if (!HasListsOfLists(type, open)) {
    channel.schema = is_object ? JsonSchemaOf(type) : WrappedSchema(type);
  }
  channel.append = [&type, is_object, limits = JsonLimits{.has_infinity = options.has_infinity}](
                       const void* value, Time, std::string& json) {
    if (!is_object) json += "{\"value\":";
    AppendJson(type, value, json, limits);
    if (!is_object) json += '}';
  };
  return channel;
}

FoxgloveChannel ChannelOf(Drawing drawing, std::string topic) {
  return {std::move(topic), std::move(drawing.schema_name), std::move(drawing.schema),
          std::move(drawing.append)};
}

}  // namespace

std::vector<FoxgloveChannel> ChannelsFor(const TypeInfo& type, std::string_view topic,
                                         const FoxgloveOptions& options) {
  std::vector<FoxgloveChannel> channels;
  if (!type.is_transparent()) return channels;
  channels.push_back(PlainChannel(type, topic, options));
  const auto drawn = std::ranges::find(kDrawn, type.semantic_tag(), &DrawnTag::tag);
  if (drawn == kDrawn.end()) return channels;
  if (auto drawing = drawn->draw(type, options)) {
    channels.push_back(ChannelOf(std::move(*drawing), std::string(topic) + "/foxglove"));
  }
  return channels;
}

std::optional<FoxgloveChannel> TransformChannelFor(const TypeInfo& type,
                                                   const FoxgloveOptions& options) {
  auto drawing = internal::DrawTransform(type, options);
  if (!drawing) return std::nullopt;
  return ChannelOf(std::move(*drawing), "/tf");
}

}  // namespace runnel
